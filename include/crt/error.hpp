#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace crt {

/// What kind of thing went wrong; the C ABI's status codes are the same list.
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

/// A name for the code, such as "invalid argument".
const char* to_string(ErrorCode code) noexcept;

/// Every failure of the library is thrown as this.
class Error : public std::runtime_error {
 public:
  /// `argument` names the field or parameter that is wrong ("radius"), empty where there is none.
  Error(ErrorCode code, const std::string& message, std::string argument = {})
      : std::runtime_error(message), code_(code), argument_(std::move(argument)) {}

  /// What kind of failure it is.
  ErrorCode code() const noexcept { return code_; }

  /// The field that is wrong, by its C++ name; empty where the error is not about one.
  const std::string& argument() const noexcept { return argument_; }

 private:
  ErrorCode code_;
  std::string argument_;
};

}  // namespace crt
