// Vectors of any magnitude are split into a direction and a length.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "crt/vec.hpp"

namespace crt::core {

/// A DirectionAndLength is a vector in polar form: where it points to, and how far.
struct DirectionAndLength {
  Vec3 direction{0, 0, 0};  ///< unit length; 0 for a vector that is 0 or not finite
  double length = 0;
};

/// Between these bounds the square of a length neither overflows nor loses bits.
inline constexpr double safe_square_min = 0x1p-900;
inline constexpr double safe_square_max = 0x1p+900;

/// Splits a vector. Where the square of its length is not safe, the vector is first scaled by a
/// power of two, which changes nothing else.
inline DirectionAndLength direction_and_length(const Vec3& v) {
  const double square = glm::dot(v, v);
  if (square > safe_square_min && square < safe_square_max) {
    const double length = std::sqrt(square);
    return {v / length, length};
  }
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0) || !std::isfinite(largest)) return {Vec3(0), largest};
  const int exponent = std::ilogb(largest);
  const Vec3 scaled(std::scalbn(v.x, -exponent), std::scalbn(v.y, -exponent),
                    std::scalbn(v.z, -exponent));
  const double length = std::sqrt(glm::dot(scaled, scaled));
  return {scaled / length, std::scalbn(length, exponent)};
}

}  // namespace crt::core
