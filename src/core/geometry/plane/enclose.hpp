// Where lines cross a plane, surely.
#pragma once

#include <array>
#include <limits>

#include "core/ray/enclosure.hpp"

namespace crt::core {

/// A plane as doubles have it to the last bit.
struct EnclosedPlane {
  Vec3 position{0, 0, 0};
  Vec3 normal{0, 0, 0};  ///< its largest component is about 1
};

/// Encloses where lines cross a plane. Nothing is known of lines that are so flat that the error of
/// n . d is not small.
///
/// With n the normal and w the offset to a point of the plane, t is n . w / n . d. Both sums are
/// off by less than 4 u of the sums of their terms' sizes.
template <class Real>
[[gnu::always_inline]] inline EnclosedCrossing<Real> enclose(const EnclosedPlane& plane,
                                                             const FilterLine<Real>& line) {
  const std::array<Real, 3> offset = offset_to(line, plane.position);
  const auto along_normal = [&n = plane.normal](const std::array<Real, 3>& v) {
    return n.x * v[0] + n.y * v[1] + n.z * v[2];
  };
  const auto sum_of_sizes = [](const std::array<Real, 3>& v) {
    return abs(v[0]) + abs(v[1]) + abs(v[2]);
  };
  constexpr double normal_size = 6;  // of three components below 2
  constexpr double flattest = 0x1p-30;
  const Real rate = along_normal(line.direction);
  const Real t = along_normal(offset) / rate;
  const Real speed = sum_of_sizes(line.direction);
  const Real error =
      (normal_size * enclosing_slack) * (sum_of_sizes(offset) + abs(t) * speed) / abs(rate);
  const Real nothing_known = broadcast<Real>(std::numeric_limits<double>::quiet_NaN());
  const MaskOf<Real> known = abs(rate) > flattest * speed;
  return {select(known, t - error, nothing_known), select(known, t + error, nothing_known)};
}

}  // namespace crt::core
