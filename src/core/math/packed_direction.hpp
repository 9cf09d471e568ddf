// A direction is kept in 32 bits.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

#include "crt/vec.hpp"

namespace crt::core {

/// A PackedDirection is a unit vector to within 2^-14, by its place on an octahedron. What has no
/// direction gets some.
///
/// Source: Cigolle and others, A survey of efficient representations for independent unit vectors,
/// JCGT 3(2), 2014.
class PackedDirection {
 public:
  PackedDirection() = default;
  explicit PackedDirection(const Vec3& direction) {
    const double size = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
    if (!(size > 0)) return;
    double x = direction.x / size;
    double y = direction.y / size;
    if (direction.z < 0) {
      const double folded = (1 - std::abs(y)) * sign(x);
      y = (1 - std::abs(x)) * sign(y);
      x = folded;
    }
    bits_ = steps(x) << 16 | steps(y);
  }

  /// Returns it at unit length.
  Vec3 direction() const {
    double x = (bits_ >> 16) / half - 1;
    double y = (bits_ & 0xffffu) / half - 1;
    const double z = 1 - std::abs(x) - std::abs(y);
    if (z < 0) {
      const double folded = (1 - std::abs(y)) * sign(x);
      y = (1 - std::abs(x)) * sign(y);
      x = folded;
    }
    return glm::normalize(Vec3(x, y, z));
  }

 private:
  static constexpr double half = 32767;
  static double sign(double x) { return x < 0 ? -1 : 1; }
  static std::uint32_t steps(double x) {
    return static_cast<std::uint32_t>(std::floor((x + 1) * half + 0.5));
  }

  std::uint32_t bits_ = 0;
};

}  // namespace crt::core
