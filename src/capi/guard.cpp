#include "capi/guard.hpp"

#include <array>
#include <cstring>
#include <exception>
#include <new>

namespace crt::capi {

namespace {

/// Holds what a thread can ask about its last failure. It has no destructor, so that a thread which
/// has called the library does not keep it from being unloaded.
struct LastFailure {
  std::array<char, 2048> message;
  int cancel_value;
};

LastFailure& last_failure() noexcept {
  static thread_local LastFailure failure{};
  return failure;
}

/// Keeps as much of a message as fits, and no half character of UTF-8 at its end.
void keep_message(const char* text) noexcept {
  std::array<char, 2048>& message = last_failure().message;
  std::size_t length = std::strlen(text);
  if (length >= message.size()) {
    length = message.size() - 1;
    constexpr unsigned char_mask = 0xc0;
    constexpr unsigned continuation = 0x80;
    while (length > 0 && (static_cast<unsigned char>(text[length]) & char_mask) == continuation)
      --length;
  }
  std::memmove(message.data(), text, length);
  message[length] = 0;
}

crt_status status_of(ErrorCode code, const char* message) noexcept {
  keep_message(message);
  if (code != ErrorCode::cancelled) set_cancel_value(0);
  return to_status(code);
}

}  // namespace

crt_status to_status(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::invalid_argument:
      return CRT_ERROR_INVALID_ARGUMENT;
    case ErrorCode::script:
      return CRT_ERROR_SCRIPT;
    case ErrorCode::io:
      return CRT_ERROR_IO;
    case ErrorCode::unsupported:
      return CRT_ERROR_UNSUPPORTED;
    case ErrorCode::limit:
      return CRT_ERROR_LIMIT;
    case ErrorCode::cancelled:
      return CRT_ERROR_CANCELLED;
    case ErrorCode::out_of_memory:
      return CRT_ERROR_OUT_OF_MEMORY;
    case ErrorCode::internal:
      break;
  }
  return CRT_ERROR_INTERNAL;
}

void set_cancel_value(int value) noexcept {
  last_failure().cancel_value = value;
}

crt_status status_of_exception() noexcept {
  try {
    throw;
  } catch (const Error& error) {
    return status_of(error.code(), error.what());
  } catch (const CancelledByCallback& cancelled) {
    set_cancel_value(cancelled.value);
    return status_of(ErrorCode::cancelled, "cancelled by a callback");
  } catch (const std::bad_alloc&) {
    return status_of(ErrorCode::out_of_memory, "out of memory");
  } catch (const std::exception& error) {
    return status_of(ErrorCode::internal, error.what());
  } catch (...) {
    return status_of(ErrorCode::internal, "an exception of an unknown kind");
  }
}

void reject(const std::string& argument, const std::string& complaint) {
  throw Error(ErrorCode::invalid_argument, argument + " " + complaint, argument);
}

}  // namespace crt::capi

using namespace crt::capi;

uint32_t crt_version(void) {
  return CRT_LIBRARY_VERSION_MAJOR << 16 | CRT_LIBRARY_VERSION_MINOR << 8 |
         CRT_LIBRARY_VERSION_PATCH;
}

const char* crt_error_message(void) {
  return last_failure().message.data();
}

int32_t crt_cancel_value(void) {
  return last_failure().cancel_value;
}

const char* crt_status_string(crt_status status) {
  switch (status) {
    case CRT_OK:
      return "ok";
    case CRT_ERROR_INVALID_ARGUMENT:
    case CRT_ERROR_SCRIPT:
    case CRT_ERROR_IO:
    case CRT_ERROR_UNSUPPORTED:
    case CRT_ERROR_LIMIT:
    case CRT_ERROR_CANCELLED:
    case CRT_ERROR_OUT_OF_MEMORY:
    case CRT_ERROR_INTERNAL:
      // The codes of the C++ interface are the same list, without the one for success.
      return crt::to_string(static_cast<crt::ErrorCode>(status - 1));
  }
  return "unknown";
}
