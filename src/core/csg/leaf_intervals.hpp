// Where lines enter and leave one leaf of a CSG object, with what rounding and exact tests may make
// of that.
#pragma once

#include <array>
#include <limits>

#include "core/csg/interval_filter.hpp"

namespace crt::core {

/// The part of a line within a leaf: the line enters it at some t of one interval and leaves it at
/// some t of another. Between the two it surely is inside, before and after them surely outside.
/// Where nothing is known the ends are NaN, and all comparisons with them are false.
template <class Real>
struct LeafInterval {
  using Mask = MaskOf<Real>;

  Real enter_from;
  Real enter_to;
  Real leave_from;
  Real leave_to;

  /// Returns the first t not before this one at which a line may be inside of the leaf.
  Real inside_from(const Real& t) const {
    return select(t > leave_to, broadcast<Real>(std::numeric_limits<double>::infinity()),
                  max(t, enter_from));
  }
  /// Returns the first t not before this one at which a line may be outside of the leaf.
  Real outside_from(const Real& t) const {
    return select(t > enter_to && t < leave_from, leave_from, t);
  }

  /// Returns whether a line surely is inside of the leaf from one t to another.
  Mask is_inside(const Real& from, const Real& to) const {
    return enter_to < from && leave_from > to;
  }
  /// Returns whether a line surely is outside of the leaf from one t to another.
  Mask is_outside(const Real& from, const Real& to) const {
    return enter_from > to || leave_to < from;
  }

  /// Makes lines that leave the leaf where they start never be inside.
  void set_outside(const Mask& of_lines) {
    const Real never = broadcast<Real>(std::numeric_limits<double>::infinity());
    *this = {.enter_from = select(of_lines, never, enter_from),
             .enter_to = select(of_lines, never, enter_to),
             .leave_from = select(of_lines, -never, leave_from),
             .leave_to = select(of_lines, -never, leave_to)};
  }
  /// Makes lines that go into the leaf where they start be inside from the first.
  void set_inside_first(const Mask& of_lines) {
    const Real always = broadcast<Real>(-std::numeric_limits<double>::infinity());
    enter_from = select(of_lines, always, enter_from);
    enter_to = select(of_lines, always, enter_to);
  }
};

/// Lines whose intervals within leaves are asked for.
template <class Real>
class EnclosedLines {
 public:
  using Mask = MaskOf<Real>;
  using Sphere = IntervalFilter::Sphere;
  using Box = IntervalFilter::Box;

  EnclosedLines(const FilterLine<Real>& lines, const Real& limits, const Mask& asked)
      : lines_(lines),
        asked_(asked),
        limits_(min(limits, broadcast<Real>(std::numeric_limits<double>::max()))) {
    constexpr double steepest = 0x1p500;
    asked_ = asked_ && lines.squared_length > 1 / steepest && lines.squared_length < steepest;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      asked_ = asked_ && (lines.direction[axis] == 0.0 || abs(lines.inverse[axis]) < steepest);
    }
  }

  const FilterLine<Real>& lines() const { return lines_; }
  const Real& limits() const { return limits_; }  ///< finite, unlike what never comes
  /// Those of the lines whose directions can be squared and divided by. The intervals of the others
  /// mean nothing.
  const Mask& asked() const { return asked_; }

  /// Encloses the part of the lines in a sphere. Returns false if all lines surely are outside as
  /// long as it matters; the interval then means nothing.
  ///
  /// With w the offset to the center, the closest approach is at c = w . d / d^2, at a squared
  /// distance of q^2, and half the chord is h with h^2 = (r^2 - q^2) / d^2.
  ///
  /// Roundings change h^2 by less than 32 u (w^2 + r^2) / d^2. Let E be 16 times that, and a little
  /// more if the start was rounded: then the ends are between c +- (H - 2 E / H) and c +- H for H^2
  /// = h^2 + E, and so are they with the error bounds of an exact test (standard_error(),
  /// grazing_error(): e = 16 u r^2 / (d^2 h) at most and never more than sqrt(2 h e)), as (h + e)^2
  /// <= h^2 + E/4 and (h - e) H >= h^2 - E/4. If the chord is as short as that, H - 2 E / H is
  /// negative, and the inside of the sphere is nowhere certain.
  bool enclose(const Sphere& sphere, LeafInterval<Real>& interval) const {
    const std::array<Real, 3> offset = offset_to(sphere);
    const double squared_radius = sphere.radius * sphere.radius;
    const Real closest = dot(offset, lines_.direction) * lines_.inverse_squared_length;
    const std::array<Real, 3> across = {offset[0] - closest * lines_.direction[0],
                                        offset[1] - closest * lines_.direction[1],
                                        offset[2] - closest * lines_.direction[2]};
    const Real margin_error = margin_error_of(dot(offset, offset), squared_radius, sphere.radius);
    const Real margin = squared_radius - dot(across, across) + margin_error;
    const Mask rejected = margin < 0.0;
    if (!any(asked_ && !rejected)) return false;
    const Real outer = sqrt(margin * lines_.inverse_squared_length);
    const Real inner = outer - 2.0 * lines_.inverse_squared_length * margin_error / outer;
    const Real error = slack * (abs(closest) + sphere.radius * lines_.inverse_length);
    interval.enter_from = closest - outer - error;
    interval.enter_to = closest - inner + error;
    interval.leave_from = closest + inner - error;
    interval.leave_to = closest + outer + error;
    return restrict(rejected, interval);
  }

  /// Encloses the part of the lines in a box by slabs. Three roundings go into each t. Nothing is
  /// known of a line along a face's plane.
  bool enclose(const Box& box, LeafInterval<Real>& interval) const {
    Real enter = broadcast<Real>(-infinity);
    Real leave = broadcast<Real>(infinity);
    Mask known = enter < leave;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<int>(axis);
      const Real first = (box.lower[i] - lines_.origin[axis]) * lines_.inverse[axis];
      const Real second = (box.upper[i] - lines_.origin[axis]) * lines_.inverse[axis];
      known = known && (first <= second || first > second);
      enter = max(enter, min(first, second));
      leave = min(leave, max(first, second));
    }
    constexpr double less = 1 - slack;
    constexpr double more = 1 + slack;
    const Real nothing_known = broadcast<Real>(std::numeric_limits<double>::quiet_NaN());
    const Real enter_from = min(enter * less, enter * more);
    const Real leave_to = max(leave * less, leave * more);
    interval.enter_from = select(known, enter_from, nothing_known);
    interval.enter_to = select(known, max(enter * less, enter * more), nothing_known);
    interval.leave_from = select(known, min(leave * less, leave * more), nothing_known);
    interval.leave_to = select(known, leave_to, nothing_known);
    return restrict(known && enter_from > leave_to, interval);
  }

  /// Returns whether the distance of a start from a sphere's surface is what rounding makes of 0.
  bool starts_on(const Sphere& sphere, std::size_t lane) const {
    const std::array<Real, 3> offset = offset_to(sphere);
    const Real squared_offset = dot(offset, offset);
    const double squared_radius = sphere.radius * sphere.radius;
    const Real off = abs(squared_offset - squared_radius);
    const Real most =
        share_of_start * margin_error_of(squared_offset, squared_radius, sphere.radius);
    return any(lane_bit(lane) && off < most);
  }

  /// Returns whether a ray comes at an upper face of a box across an axis from its outside, or else
  /// at a lower one.
  bool goes_into_box(std::size_t axis, bool upper, std::size_t lane) const {
    const Real& speed = lines_.direction[axis];
    return any(lane_bit(lane) && (upper ? speed < 0.0 : speed > 0.0));
  }
  bool starts_at_0(std::size_t lane) const { return any(lane_bit(lane) && lines_.begin == 0.0); }
  /// Returns whether a ray that starts into a leaf is inside of it as soon as crossings count.
  bool is_inside_soon(const LeafInterval<Real>& interval, std::size_t lane) const {
    const Mask soon =
        interval.enter_to <= lines_.certain_from && interval.leave_from > lines_.certain_from;
    return any(lane_bit(lane) && soon);
  }

  static Mask lane_bit(std::size_t lane) { return lanes_of_mask<Real>(std::uint32_t{1} << lane); }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  /// Relative, 512 roundings: far more than what the sums here are off by and the bounds on the
  /// errors of exact crossings together.
  static constexpr double slack = 0x1p-44;
  /// A start that was meant to be on a sphere is off it by less than this share of E d^2.
  static constexpr double share_of_start = 0x1p-4;

  std::array<Real, 3> offset_to(const Sphere& sphere) const {
    return {sphere.center.x - lines_.origin[0], sphere.center.y - lines_.origin[1],
            sphere.center.z - lines_.origin[2]};
  }
  /// Returns E d^2 of enclose().
  Real margin_error_of(const Real& squared_offset, double squared_radius, double radius) const {
    constexpr double surfaces_off = 32;
    return slack * (squared_offset + squared_radius) + (surfaces_off * radius) * lines_.start_error;
  }

  /// Leaves what matters of an interval. What may be at the start may be before it as well.
  bool restrict(const Mask& rejected, LeafInterval<Real>& interval) const {
    const auto widened = [&](const Real& from) {
      return select(from <= lines_.certain_from, min(from, lines_.begin), from);
    };
    interval.enter_from = widened(interval.enter_from);
    interval.leave_from = widened(interval.leave_from);
    const Mask outside = rejected || interval.is_outside(lines_.begin, limits_);
    if (!any(asked_ && !outside)) return false;
    if (any(outside)) interval.set_outside(outside);
    return true;
  }

  const FilterLine<Real>& lines_;
  Mask asked_;
  Real limits_;
};

}  // namespace crt::core
