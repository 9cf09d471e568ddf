#pragma once

namespace crt {

/// Returns the version, such as "1.0.0": major, minor, patch.
const char* version() noexcept;

}  // namespace crt
