// Where lines are within a torus, surely.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "core/math/vector.hpp"
#include "core/ray/enclosure.hpp"

namespace crt::core {

/// A torus that is thicker than the one it encloses by more than all roundings, those of its own
/// place among them: by 2^-30 of its size.
struct EnclosedTorus {
  Vec3 center{0, 0, 0};
  Vec3 axis{0, 0, 0};  ///< unit length
  double ring = 0;     ///< the radius of the circle in the middle of the tube
  double tube = 0;     ///< the tube's radius, with what is added to it

  /// Returns it where a placement puts it, thicker by more than all roundings, or nothing if that
  /// cannot be done.
  template <class Placement>
  std::optional<EnclosedTorus> placed(const Placement& placement) const {
    const double scale = placement.even_scale();
    const Vec3 place = placement.point_to_world(center);
    const Vec3 along = placement.point_to_world(center + axis) - place;
    // Where the place is far larger than the axis the difference has too few digits left.
    constexpr double max_sizes = 0x1p12;
    const double in_world = scale * size();
    if (!(largest_component(place) < max_sizes * in_world) || !(largest_component(along) > 0) ||
        !(largest_component(place) < max_sizes * largest_component(along))) {
      return {};
    }
    constexpr double roundings = 0x1p-30;
    const EnclosedTorus result{.center = place,
                               .axis = unit_vector(along),
                               .ring = scale * ring,
                               .tube = scale * tube + roundings * in_world};
    if (!has_fair_size(result.tube) || !has_fair_size(result.ring)) return {};
    return result;
  }

  double size() const { return ring + tube; }

  template <class Real>
  Real along_axis(const std::array<Real, 3>& v) const {
    return axis.x * v[0] + axis.y * v[1] + axis.z * v[2];
  }
};

/// A line relative to a torus's center, with x = 0 where it is closest to that.
template <class Real>
struct TorusPass {
  Real squared_length;
  Real squared_across;  ///< its distance from the center at x = 0
  Real height;          ///< along the axis at x = 0
  Real climb;           ///< and what x adds to it
  Real from;            ///< the line is in the torus nowhere before this x
  Real to;              ///< and nowhere after this one

  Real height_at(const Real& x) const { return height + x * climb; }
  /// Returns the squared distance from the axis.
  Real squared_distance_at(const Real& x) const {
    const Real at = height_at(x);
    return squared_across + x * x * squared_length - at * at;
  }
};

/// What is certain of a line by how deep it is in a torus in the middle of its pass.
template <class Mask>
struct TorusDepth {
  Mask misses;
  Mask is_inside;  ///< in the middle, and as far around it as the gap of enclose() twice
};

/// Looks at G in the middle of the pass (see geometry/torus/torus.hpp).
///
/// G'' / 2 = d^2 - R D / rho^3 is least where rho is, so there is a parabola below G all along the
/// pass: with G's value and slope in the middle, and that curvature. And |grad G| is twice the
/// distance from the ring: next to a point within the tube of radius r, as far as 2^-19 s / d for
/// the torus's size s, G changes by less than 2^-18 s (r + 2^-19 s).
template <class Real>
auto torus_depth(const EnclosedTorus& torus, const TorusPass<Real>& pass, const Real& middle) {
  const double size = torus.size();
  const Real height = pass.height_at(middle);
  const Real rho = sqrt(max(pass.squared_distance_at(middle), Real{}));
  const Real outward = rho - torus.ring;
  const Real level = outward * outward + height * height - torus.tube * torus.tube;
  const Real lateral = middle * pass.squared_length - height * pass.climb;
  const Real slope = abs(outward * lateral / rho + height * pass.climb);

  const Real squared_lateral_speed = pass.squared_length - pass.climb * pass.climb;
  const Real next_to_axis = pass.height * pass.climb / squared_lateral_speed;
  const Real after_from = select(next_to_axis > pass.from, next_to_axis, pass.from);
  const Real squared_least =
      pass.squared_distance_at(select(after_from < pass.to, after_from, pass.to));
  const Real least = sqrt(squared_least);
  // Roundings are less than a sixteenth of that.
  const double error = 0x1p-30 * size * size;
  const Real turning =
      abs((pass.squared_across - pass.height * pass.height) * squared_lateral_speed -
          pass.height * pass.height * pass.climb * pass.climb) +
      error * pass.squared_length;
  const Real bend = pass.squared_length - torus.ring * turning / (squared_least * least);
  const Real half_length = (pass.to - pass.from) * 0.5;
  const Real to_lowest = select(slope < bend * half_length, slope / bend, half_length);
  const Real lowest = level - (2.0 * slope - bend * to_lowest) * to_lowest;
  // The torus itself is thinner: its G is less than twice that error larger.
  const double deep = 4 * error + 0x1p-18 * size * (torus.tube + 0x1p-19 * size);
  using Mask = MaskOf<Real>;
  return TorusDepth<Mask>{.misses = lowest > error, .is_inside = level < -deep};
}

/// Encloses the part of lines in a torus, from where they first enter it to where they last leave
/// it. Returns false if none of the lines that are asked for comes near it; the enclosure then
/// means nothing.
///
/// A line misses the torus if it passes by the sphere and the slab around it, or through the hole
/// in its middle, or else if it stays outside all along its pass through these. From farther away
/// than 2^16 sizes the roundings are not covered by what the torus is thicker, and nothing is
/// known.
template <class Real>
bool enclose(const EnclosedTorus& torus, const FilterLine<Real>& line, const MaskOf<Real>& asked,
             Enclosure<Real>& part) {
  using Mask = MaskOf<Real>;
  constexpr double farthest = 0x1p16;
  const double size = torus.size();
  const std::array<Real, 3> offset = offset_to(line, torus.center);
  const Real closest = dot(offset, line.direction) * line.inverse_squared_length;
  const std::array<Real, 3> across = {closest * line.direction[0] - offset[0],
                                      closest * line.direction[1] - offset[1],
                                      closest * line.direction[2] - offset[2]};
  TorusPass<Real> pass{.squared_length = line.squared_length,
                       .squared_across = dot(across, across),
                       .height = torus.along_axis(across),
                       .climb = torus.along_axis(line.direction),
                       .from = {},
                       .to = {}};
  const Real margin = size * size - pass.squared_across;
  const Real half = sqrt(max(margin, Real{}) * line.inverse_squared_length);
  // The part of the line in the slab, as far as it is in the sphere. Where the line is parallel to
  // the slab the quotients are huge or no numbers, and comparing leaves the sphere's.
  const Real first = (-torus.tube - pass.height) / pass.climb;
  const Real second = (torus.tube - pass.height) / pass.climb;
  const Real low = select(first < second, first, second);
  const Real high = select(first < second, second, first);
  pass.from = select(low > -half, low, -half);
  pass.to = select(high < half, high, half);
  // Next to the axis the squared distance from it is little more than its rounding, and may be
  // negative.
  const double hole = std::max(torus.ring - torus.tube, 0.0);
  const double squared_hole = hole * hole - 0x1p-30 * size * size;
  const Mask through_hole = pass.squared_distance_at(pass.from) < squared_hole &&
                            pass.squared_distance_at(pass.to) < squared_hole;
  const Mask known = dot(offset, offset) < farthest * farthest * size * size;
  Mask misses = known && (margin < 0.0 || pass.from > pass.to || through_hole);
  if (!any(asked && !misses)) return false;

  const Real middle = (pass.from + pass.to) * 0.5;
  const TorusDepth<Mask> depth = torus_depth(torus, pass, middle);
  misses = misses || (known && depth.misses);
  if (!any(asked && !misses)) return false;
  // It is more than the bound on the error of a root that is grazed. No bound on a root's error is
  // larger than the whole pass.
  const Real gap = 0x1p-20 * size * line.inverse_length;
  const Real longest = select(depth.is_inside, pass.to - pass.from, Real{}) + gap;
  const Real never = broadcast<Real>(std::numeric_limits<double>::infinity());
  part = {.enter_from = closest + pass.from - longest,
          .enter_to = select(depth.is_inside, closest + middle - gap, never),
          .leave_from = select(depth.is_inside, closest + middle + gap, -never),
          .leave_to = closest + pass.to + longest};
  if (any(misses)) part.set_outside(misses);
  if (!all(known)) part.set_unknown(!known);
  return true;
}

/// Returns whether a ray that starts on a torus and goes outwards leaves it for good: it starts
/// farther from the axis than the ring is, where the torus is its own convex hull, and plainly goes
/// away from there.
template <class Real>
MaskOf<Real> leaves_for_good(const EnclosedTorus& torus, const FilterLine<Real>& line) {
  const std::array<Real, 3> offset = offset_to(line, torus.center);
  // Both are negative, as is the offset to the center.
  const Real height = torus.along_axis(offset);
  const Real rho = sqrt(dot(offset, offset) - height * height);
  const Real climb = torus.along_axis(line.direction);
  const Real lateral = height * climb - dot(offset, line.direction);
  // This is far more than what rounding can have done to the start.
  constexpr double plainly = 0x1p-20;
  const double least = plainly * torus.size();
  const Real outward = rho - torus.ring;
  const Real away = outward * lateral / rho - height * climb;
  return outward > least && away * line.inverse_length > least && line.begin >= 0.0;
}

}  // namespace crt::core
