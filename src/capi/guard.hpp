// No exception leaves the C interface: each of its functions runs inside guarded().
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "crt/crt.h"
#include "crt/error.hpp"

namespace crt::capi {

/// Is thrown when a callback of a script or of a custom shape returned `value` to cancel.
struct CancelledByCallback {
  int value;
};

/// Turns the exception that is being handled into a status, and keeps its message for
/// crt_error_message().
crt_status status_of_exception() noexcept;

/// Returns the ABI's number for a kind of error.
crt_status to_status(ErrorCode code) noexcept;

/// Keeps what crt_cancel_value() returns to this thread.
void set_cancel_value(int value) noexcept;

/// Runs the body of a function of the interface, and turns what it throws into the status.
template <class Body>
crt_status guarded(const Body& body) noexcept {
  try {
    body();
    return CRT_OK;
  } catch (...) {
    return status_of_exception();
  }
}

/// Runs a body that a callback may cancel, whose number it keeps in `cancel_value`. Others, such as
/// custom shapes, throw theirs.
template <class Body>
crt_status guarded(const std::atomic<int>& cancel_value, const Body& body) noexcept {
  return guarded([&] {
    try {
      body();
    } catch (const Error& error) {
      if (error.code() == ErrorCode::cancelled) set_cancel_value(cancel_value);
      throw;
    }
  });
}

/// Throws the error of a wrong argument.
[[noreturn]] void reject(const std::string& argument, const std::string& complaint);

/// Refuses NULL.
inline void require(const void* pointer, const char* argument) {
  if (pointer == nullptr) reject(argument, "must not be NULL");
}

}  // namespace crt::capi
