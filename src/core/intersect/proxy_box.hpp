// Boxes that are objects of their own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/geometry/box/enclose.hpp"

namespace crt::core {

/// A box that is an object of its own, without a transform.
struct ProxyBox : EnclosedBox {
  static constexpr std::size_t face_count = 6;

  std::uint32_t leaf = 0;
  bool is_resolved = false;  ///< whether the proxy alone gives its crossings: in the standard tier
  std::array<bool, face_count> flipped{};  ///< as FaceSurface has it
  std::array<std::uint32_t, face_count> surfaces{};
};

}  // namespace crt::core
