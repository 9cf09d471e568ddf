// The border that no exception crosses: every function of the C interface runs inside guarded().
#pragma once

#include <cstdint>
#include <string>

#include "crt/crt.h"
#include "crt/error.hpp"

namespace crt::capi {

/// Thrown out of a callback of a script that returned `value` to cancel it.
struct CancelledByCallback {
  int value;
};

/// Turns the exception that is being handled into a status, and keeps its message for
/// crt_error_message().
crt_status status_of_exception() noexcept;

/// The ABI's number for a kind of error.
crt_status to_status(ErrorCode code) noexcept;

/// Keeps what crt_cancel_value() tells this thread.
void set_cancel_value(int value) noexcept;

/// Runs the body of a function of the interface; what it throws becomes the status.
template <class Body>
crt_status guarded(const Body& body) noexcept {
  try {
    body();
    return CRT_OK;
  } catch (...) {
    return status_of_exception();
  }
}

/// Throws the error of an argument.
[[noreturn]] void reject(const std::string& argument, const std::string& complaint);

/// Refuses NULL.
inline void require(const void* pointer, const char* argument) {
  if (pointer == nullptr) reject(argument, "must not be NULL");
}

}  // namespace crt::capi
