#include "crt/error.hpp"

namespace crt {

const char* to_string(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::invalid_argument:
      return "invalid argument";
    case ErrorCode::script:
      return "script";
    case ErrorCode::io:
      return "input or output";
    case ErrorCode::unsupported:
      return "unsupported";
    case ErrorCode::limit:
      return "limit";
    case ErrorCode::cancelled:
      return "cancelled";
    case ErrorCode::out_of_memory:
      return "out of memory";
    case ErrorCode::internal:
      return "internal";
  }
  return "unknown";
}

}  // namespace crt
