// Where lines cross a plane, surely.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "core/geometry/bounds.hpp"
#include "core/ray/enclosure.hpp"

namespace crt::core {

/// A plane as doubles have it.
struct EnclosedPlane {
  Vec3 position{0, 0, 0};
  Vec3 normal{0, 0, 0};  ///< its largest component is about 1
  double off = 0;        ///< its position may be off by so much

  /// Returns it where a placement puts it, or nothing if that may distort it.
  template <class Placement>
  std::optional<EnclosedPlane> placed(const Placement& placement) const {
    if (const std::optional<Vec3> place = placement.exactly_to_world(position))
      return EnclosedPlane{*place, normal};
    if (!(placement.even_scale() > 0)) return {};
    const Vec3 place = placement.point_to_world(position);
    return EnclosedPlane{.position = place,
                         .normal = scaled_to_one(placement.covector_to_world(normal)),
                         .off = 0x1p-46 * largest_component(place)};
  }

  /// Returns whether the plane surely passes by a box.
  bool passes_by(const Bounds& box) const {
    const Vec3 middle = 0.5 * box.lower + 0.5 * box.upper;
    const Vec3 steepness = glm::abs(normal);
    constexpr double roundings = 0x1p-40;
    const double reach = glm::dot(steepness, box.upper - middle) +
                         roundings * glm::dot(steepness, glm::abs(middle) + glm::abs(position)) +
                         glm::dot(steepness, Vec3(off));
    return std::abs(glm::dot(normal, middle - position)) > reach;
  }

  /// Returns how fast a line goes up, at a length of the normal of about 1.
  template <class Real>
  Real rate(const FilterLine<Real>& line) const {
    const auto& d = line.direction;
    return normal.x * d[0] + normal.y * d[1] + normal.z * d[2];
  }
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
  const Real error = normal_size *
                     (enclosing_slack * (sum_of_sizes(offset) + abs(t) * speed) + plane.off) /
                     abs(rate);
  const Real nothing_known = broadcast<Real>(std::numeric_limits<double>::quiet_NaN());
  const MaskOf<Real> known = abs(rate) > flattest * speed;
  return {select(known, t - error, nothing_known), select(known, t + error, nothing_known)};
}

/// Encloses the part of lines below a plane, which is the half-space against its normal.
template <class Real>
bool enclose(const EnclosedPlane& plane, const FilterLine<Real>& line,
             const MaskOf<Real>& /*asked*/, Enclosure<Real>& part) {
  const EnclosedCrossing<Real> crossing = enclose(plane, line);
  const MaskOf<Real> rises = plane.rate(line) > 0.0;
  const Real always = broadcast<Real>(std::numeric_limits<double>::infinity());
  part = {.enter_from = select(rises, -always, crossing.from),
          .enter_to = select(rises, -always, crossing.to),
          .leave_from = select(rises, crossing.from, always),
          .leave_to = select(rises, crossing.to, always)};
  const MaskOf<Real> unknown = !(crossing.from <= crossing.to);
  if (any(unknown)) part.set_unknown(unknown);
  return true;
}

/// Returns whether lines that start on a plane downwards go below it: those that are not flat.
template <class Real>
MaskOf<Real> starts_inwards(const EnclosedPlane& plane, std::uint32_t /*face*/,
                            const FilterLine<Real>& line) {
  const EnclosedCrossing<Real> crossing = enclose(plane, line);
  return crossing.from <= crossing.to && plane.rate(line) < 0.0;
}

}  // namespace crt::core
