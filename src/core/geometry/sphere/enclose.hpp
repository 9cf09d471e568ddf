// Where lines are within a sphere, surely.
//
// Let w be the offset from a line's origin to the center. The line is closest to the center at
// c = w . d / d^2, at a distance of q, and half its chord is h with h^2 d^2 = r^2 - q^2.
//
// Let that be known up to M, and write E = M / d^2 and H^2 = h^2 + E. If all that happens to h^2,
// through roundings here and through those of an exact test, is less than E / 4, the ends lie
// between c +- (H - 2 E / H) and c +- H. If the chord is so short that H - 2 E / H is negative, the
// inside of the sphere is nowhere certain.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/math/vector.hpp"
#include "core/ray/enclosure.hpp"

namespace crt::core {

/// Where lines are closest to a center.
template <class Real>
struct ClosestApproach {
  Real t;       ///< c
  Real margin;  ///< H^2 d^2: below 0 where a line surely misses the sphere
};

/// `margin_error` is M. Vectors are by component.
template <class Real, class Number, class Error>
ClosestApproach<Real> closest_approach(const std::array<Real, 3>& offset,
                                       const std::array<Real, 3>& direction,
                                       const Real& inverse_squared_length, const Number& radius,
                                       const Error& margin_error) {
  const Real closest = fused_dot(offset, direction) * inverse_squared_length;
  const std::array<Real, 3> across = {multiply_add(-closest, direction[0], offset[0]),
                                      multiply_add(-closest, direction[1], offset[1]),
                                      multiply_add(-closest, direction[2], offset[2])};
  const Real margin = radius * radius - fused_dot(across, across);
  return {closest, margin + margin_error};
}

/// Returns where the ends of chords are, of which all that may be wrong beside M is `t_error`.
template <class Real, class Error>
Enclosure<Real> enclosed_chord(const ClosestApproach<Real>& approach,
                               const Real& inverse_squared_length, const Error& margin_error,
                               const Real& t_error) {
  const Real outer = sqrt(max(approach.margin, Real{}) * inverse_squared_length);
  const Real less = 2.0 * margin_error * inverse_squared_length * inverse_or_more(outer);
  const Real inner = outer - less;
  return {.enter_from = approach.t - outer - t_error,
          .enter_to = approach.t - inner + t_error,
          .leave_from = approach.t + inner - t_error,
          .leave_to = approach.t + outer + t_error};
}

/// A sphere as doubles have it.
struct EnclosedSphere {
  Vec3 center{0, 0, 0};
  double radius = 0;
  double off = 0;  ///< its center and its radius together may be off by so much

  /// Returns it where a placement puts it, or nothing if it is of no fair size there or is
  /// distorted.
  template <class Placement>
  std::optional<EnclosedSphere> placed(const Placement& placement) const {
    EnclosedSphere result = *this;
    if (const std::optional<Vec3> place = placement.exactly_to_world(center)) {
      result.center = *place;
    } else {
      const double scale = placement.even_scale();
      if (!(scale > 0)) return {};
      result.center = placement.point_to_world(center);
      result.radius *= scale;
      // A map that scales evenly does so but for 2^-40 of each length.
      result.off = 0x1p-36 * result.radius + 0x1p-50 * largest_component(result.center);
    }
    if (!has_fair_size(result.radius)) return {};
    return result;
  }

  /// Returns M for lines at such offsets. Roundings change h^2 d^2 by less than 32 u (w^2 + r^2),
  /// with u = 2^-53. The bound on the error of an exact test's t, e, is 16 u r^2 / (d^2 h) at most
  /// and never more than sqrt(2 h e) (standard_error(), grazing_error()): so (h + e)^2 and (h - e)
  /// H are off from h^2 and H^2 by less than a quarter of this. The second term is for a start that
  /// rounding has put off a surface. A sphere that is off changes h^2 d^2 by less than (4 r + 2
  /// off) off where a line comes within r + off of its center.
  template <class Real>
  Real margin_error(const FilterLine<Real>& line, const Real& squared_offset) const {
    return enclosing_slack * (squared_offset + radius * radius) +
           (starts_off * radius) * line.start_error + 4 * (4 * radius + 2 * off) * off;
  }
};

/// Encloses the part of lines in a sphere. Returns false if none of the lines that are asked for
/// comes near the sphere; the enclosure then means nothing.
template <class Real>
bool enclose(const EnclosedSphere& sphere, const FilterLine<Real>& line, const MaskOf<Real>& asked,
             Enclosure<Real>& part) {
  const std::array<Real, 3> offset = offset_to(line, sphere.center);
  const Real margin_error = sphere.margin_error(line, dot(offset, offset));
  const ClosestApproach<Real> approach = closest_approach(
      offset, line.direction, line.inverse_squared_length, sphere.radius, margin_error);
  const MaskOf<Real> misses = approach.margin < 0.0;
  if (!any(asked && !misses)) return false;
  const Real t_error = enclosing_slack * (abs(approach.t) + sphere.radius * line.inverse_length) +
                       sphere.off * line.inverse_length;
  part = enclosed_chord(approach, line.inverse_squared_length, margin_error, t_error);
  if (any(misses)) part.set_outside(misses);
  return true;
}

/// Returns whether lines that start on a sphere inwards come into it there: the distance of their
/// origins from it is what rounding makes of 0.
template <class Real>
MaskOf<Real> starts_inwards(const EnclosedSphere& sphere, std::uint32_t /*face*/,
                            const FilterLine<Real>& line) {
  constexpr double share_of_start = 0x1p-4;
  const std::array<Real, 3> offset = offset_to(line, sphere.center);
  const Real squared_offset = dot(offset, offset);
  return abs(squared_offset - sphere.radius * sphere.radius) <
         share_of_start * sphere.margin_error(line, squared_offset);
}

}  // namespace crt::core
