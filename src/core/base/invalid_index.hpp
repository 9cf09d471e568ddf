#pragma once

#include <cstdint>

namespace crt::core {

/// The invalid_index stands where an index of something is expected and there is none.
inline constexpr std::uint32_t invalid_index = 0xffffffffu;

}  // namespace crt::core
