// A build may leave out features. The functions that need them say which option brings them.
#pragma once

#include <string>
#include <string_view>

namespace crt::text {

/// Returns the message of an error. The option is named without CRT_WITH_.
inline std::string left_out(std::string_view feature, std::string_view option) {
  return "this build of CRT has no " + std::string(feature) + ": CMake's option CRT_WITH_" +
         std::string(option) + " brings them";
}

}  // namespace crt::text
