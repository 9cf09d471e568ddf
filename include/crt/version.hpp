#pragma once

namespace crt {

/// "1.0.0": major, minor, patch.
const char* version() noexcept;

}  // namespace crt
