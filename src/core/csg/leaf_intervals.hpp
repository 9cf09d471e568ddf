// The ends of a small CSG object's leaves along rays, with what rounding and exact tests may make
// of them.
#pragma once

#include <array>
#include <limits>

#include "core/csg/interval_filter.hpp"

namespace crt::core {

/// Where lines enter and leave each leaf that they are not surely outside of: at some t from `from`
/// to `to`. Where nothing is known these are not numbers, and all comparing with them says no.
template <class Real>
class IntervalFilter::Ends {
 public:
  using Mask = MaskOf<Real>;

  struct OfLeaf {
    Real enter_from;
    Real enter_to;
    Real leave_from;
    Real leave_to;

    /// The first t not before this one at which a line may be inside of the leaf, and outside of
    /// it.
    Real inside_from(const Real& t) const {
      return t > leave_to ? broadcast<Real>(infinity) : max(t, enter_from);
    }
    Real outside_from(const Real& t) const {
      return both(t > enter_to, t < leave_from) ? leave_from : t;
    }

    /// Whether it surely is inside of the leaf from one t to another, or outside.
    Mask is_inside(const Real& from, const Real& to) const {
      return both(enter_to<from, leave_from> to);
    }
    Mask is_outside(const Real& from, const Real& to) const {
      return either(enter_from > to, leave_to < from);
    }
  };

  Ends(const FilterLine<Real>& lines, const Real& limits, const Mask& asked)
      : lines_(lines),
        asked_(asked),
        limits_(min(limits, broadcast<Real>(std::numeric_limits<double>::max()))) {
    constexpr double steepest = 0x1p500;
    asked_ =
        both(asked_, both(lines.squared_length > 1 / steepest, lines.squared_length < steepest));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      asked_ =
          both(asked_, either(lines.direction[axis] == 0.0, abs(lines.inverse[axis]) < steepest));
    }
  }

  const FilterLine<Real>& lines() const { return lines_; }
  const Real& limits() const { return limits_; }  ///< finite, unlike what never comes
  /// Those whose directions can be squared and divided by; the others are told nothing.
  const Mask& asked() const { return asked_; }

  /// With w the offset to the center, the closest approach is at c = w . d / d^2, at a squared
  /// distance of q^2, and half the chord is h with h^2 = (r^2 - q^2) / d^2.
  ///
  /// Roundings change h^2 by less than 32 u (w^2 + r^2) / d^2. Let E be 16 times that, and a little
  /// more if the start was rounded: then the ends are between c +- (H - 2 E / H) and c +- H for H^2
  /// = h^2 + E, and so are they with the error bounds of an exact test (standard_error(),
  /// grazing_error(): e = 16 u r^2 / (d^2 h) at most and never more than sqrt(2 h e)), as (h + e)^2
  /// <= h^2 + E/4 and (h - e) H >= h^2 - E/4. If the chord is as short as that, H - 2 E / H is
  /// negative, and the inside of the sphere is nowhere certain.
  void set(std::size_t place, const Sphere& sphere) {
    const std::array<Real, 3> offset = offset_to(sphere);
    const double squared_radius = sphere.radius * sphere.radius;
    const Real closest = dot(offset, lines_.direction) * lines_.inverse_squared_length;
    const std::array<Real, 3> across = {offset[0] - closest * lines_.direction[0],
                                        offset[1] - closest * lines_.direction[1],
                                        offset[2] - closest * lines_.direction[2]};
    const Real margin_error = margin_error_of(dot(offset, offset), squared_radius, sphere.radius);
    const Real margin = squared_radius - dot(across, across) + margin_error;
    const Mask missed = margin < 0.0;
    if (!any(without(asked_, missed))) {
      outside_ |= bit_of(place);
      return;
    }
    const Real outer = square_root(margin * lines_.inverse_squared_length);
    const Real inner = outer - 2.0 * lines_.inverse_squared_length * margin_error / outer;
    const Real error = slack * (abs(closest) + sphere.radius * lines_.inverse_length);
    set(place, missed,
        {.enter_from = closest - outer - error,
         .enter_to = closest - inner + error,
         .leave_from = closest + inner - error,
         .leave_to = closest + outer + error});
  }

  /// By slabs; three roundings go into each t. A line along a face's plane is told nothing.
  void set(std::size_t place, const Box& box) {
    Real enter = broadcast<Real>(-infinity);
    Real leave = broadcast<Real>(infinity);
    Mask known = enter < leave;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<int>(axis);
      const Real first = (box.lower[i] - lines_.origin[axis]) * lines_.inverse[axis];
      const Real second = (box.upper[i] - lines_.origin[axis]) * lines_.inverse[axis];
      known = both(known, either(first <= second, first > second));
      enter = max(enter, min(first, second));
      leave = min(leave, max(first, second));
    }
    constexpr double less = 1 - slack;
    constexpr double more = 1 + slack;
    const Real nothing_known = broadcast<Real>(std::numeric_limits<double>::quiet_NaN());
    const Real enter_from = min(enter * less, enter * more);
    const Real leave_to = max(leave * less, leave * more);
    set(place, both(known, enter_from > leave_to),
        {.enter_from = known ? enter_from : nothing_known,
         .enter_to = known ? max(enter * less, enter * more) : nothing_known,
         .leave_from = known ? min(leave * less, leave * more) : nothing_known,
         .leave_to = known ? leave_to : nothing_known});
  }

  /// A leaf that a ray starts on and leaves for good.
  void set_left(std::size_t place, std::size_t lane) {
    if ((outside_ & bit_of(place)) == 0) set_outside(ends_[place], lane_bit(lane));
  }
  /// A leaf that a ray starts on and goes into; false if it is not plain that it is inside soon.
  bool set_entered(std::size_t place, std::size_t lane) {
    if ((outside_ & bit_of(place)) != 0) return false;
    OfLeaf& ends = ends_[place];
    const Mask soon =
        both(ends.enter_to <= lines_.certain_from, ends.leave_from > lines_.certain_from);
    const Mask ray = lane_bit(lane);
    if (!any(both(ray, soon))) return false;
    ends.enter_from = ray ? broadcast<Real>(-infinity) : ends.enter_from;
    ends.enter_to = ray ? broadcast<Real>(-infinity) : ends.enter_to;
    return true;
  }

  /// Whether the distance of a start from a sphere's surface is what rounding makes of 0.
  bool starts_on(const Sphere& sphere, std::size_t lane) const {
    const std::array<Real, 3> offset = offset_to(sphere);
    const Real squared_offset = dot(offset, offset);
    const double squared_radius = sphere.radius * sphere.radius;
    const Real off = abs(squared_offset - squared_radius);
    const Real most =
        share_of_start * margin_error_of(squared_offset, squared_radius, sphere.radius);
    return any(both(lane_bit(lane), off < most));
  }

  /// Whether a ray comes at an upper face of a box across an axis from its outside, or else at a
  /// lower one.
  bool goes_into_box(std::size_t axis, bool upper, std::size_t lane) const {
    const Real& speed = lines_.direction[axis];
    return any(both(lane_bit(lane), upper ? speed < 0.0 : speed > 0.0));
  }
  bool starts_at_0(std::size_t lane) const {
    return any(both(lane_bit(lane), lines_.begin == 0.0));
  }

  /// The leaves that all lines surely are outside of as long as it matters. Of others only there
  /// are ends.
  Places outside() const { return outside_; }
  const OfLeaf& operator[](std::size_t place) const { return ends_[place]; }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  /// Relative, 512 roundings: far more than what the sums here are off by and the bounds on the
  /// errors of exact crossings together.
  static constexpr double slack = 0x1p-44;
  /// A start that was meant to be on a sphere is off it by less than so much of what is allowed for
  /// in all.
  static constexpr double share_of_start = 0x1p-4;

  static Mask lane_bit(std::size_t lane) { return lanes_of_mask<Real>(bit_of(lane)); }

  std::array<Real, 3> offset_to(const Sphere& sphere) const {
    return {sphere.center.x - lines_.origin[0], sphere.center.y - lines_.origin[1],
            sphere.center.z - lines_.origin[2]};
  }
  /// E d^2, see above.
  Real margin_error_of(const Real& squared_offset, double squared_radius, double radius) const {
    constexpr double surfaces_off = 32;
    return slack * (squared_offset + squared_radius) + (surfaces_off * radius) * lines_.start_error;
  }

  /// Those lines never are inside.
  static void set_outside(OfLeaf& ends, const Mask& lines) {
    const Real never = broadcast<Real>(infinity);
    ends = {.enter_from = lines ? never : ends.enter_from,
            .enter_to = lines ? never : ends.enter_to,
            .leave_from = lines ? -never : ends.leave_from,
            .leave_to = lines ? -never : ends.leave_to};
  }

  /// What may be at the start may be before it as well.
  void set(std::size_t place, const Mask& missed, OfLeaf ends) {
    const auto widened = [&](const Real& from) {
      return from <= lines_.certain_from ? min(from, lines_.begin) : from;
    };
    ends.enter_from = widened(ends.enter_from);
    ends.leave_from = widened(ends.leave_from);
    const Mask outside = either(missed, ends.is_outside(lines_.begin, limits_));
    if (any(without(asked_, outside))) {
      set_outside(ends, outside);
      ends_[place] = ends;
    } else {
      outside_ |= bit_of(place);
    }
  }

  const FilterLine<Real>& lines_;
  Mask asked_;
  Real limits_;
  std::array<OfLeaf, most_places> ends_;
  Places outside_ = 0;
};

}  // namespace crt::core
