#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace crt {

/// Says what kind of thing went wrong. The C ABI's status codes are the same list.
enum class ErrorCode {
  invalid_argument,  ///< a value out of its range, of the wrong kind, or not finite
  script,            ///< a CRT script is wrong
  io,                ///< a file could not be found, read or written
  unsupported,       ///< this build or machine cannot do it
  limit,             ///< a limit that the caller set was passed
  cancelled,         ///< the caller's progress callback asked to stop
  out_of_memory,
  internal,  ///< a bug in CRT
};

/// Returns a name for the code, such as "invalid argument".
const char* to_string(ErrorCode code) noexcept;

/// Error is what every failure of the library is thrown as.
class Error : public std::runtime_error {
 public:
  /// `argument` names the field or parameter that is wrong ("radius"). It is empty where there is
  /// none.
  Error(ErrorCode code, const std::string& message, std::string argument = {})
      : std::runtime_error(message), code_(code), argument_(std::move(argument)) {}

  /// Returns what kind of failure it is.
  ErrorCode code() const noexcept { return code_; }

  /// Returns the C++ name of the field that is wrong. It is empty where the error is not about one.
  const std::string& argument() const noexcept { return argument_; }

 private:
  ErrorCode code_;
  std::string argument_;
};

}  // namespace crt
