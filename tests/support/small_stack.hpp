// Tests of threads with little stack run them here.
#pragma once

#include <doctest/doctest.h>

#include <pthread.h>

#include <cstddef>

namespace crt::test {

/// Runs a function on a thread with so many bytes of stack. A thread that needs more ends the
/// process.
template <class Function>
void on_small_stack(std::size_t bytes, Function function) {
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
  bytes *= 8;  // what a sanitizer adds to every frame is not ours
#endif
  pthread_attr_t attributes;
  REQUIRE(pthread_attr_init(&attributes) == 0);
  REQUIRE(pthread_attr_setstacksize(&attributes, bytes) == 0);
  pthread_t thread{};
  const auto start = [](void* argument) -> void* {
    (*static_cast<Function*>(argument))();
    return nullptr;
  };
  REQUIRE(pthread_create(&thread, &attributes, start, &function) == 0);
  REQUIRE(pthread_join(thread, nullptr) == 0);
  pthread_attr_destroy(&attributes);
}

}  // namespace crt::test
