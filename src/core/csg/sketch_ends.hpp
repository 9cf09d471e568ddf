// The ends of a small CSG object's leaves along a ray, with what rounding and exact tests may make of them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/csg/evaluate.hpp"
#include "core/csg/sketch.hpp"

namespace crt::core {

/// What of a ray does not change from leaf to leaf.
class CsgSketch::Line {
 public:
  Line(const WorldRay& ray, double end)
      : begin(ray.t_min),
        certain_from(farthest_start(ray)),
        limit(std::min(end, std::numeric_limits<double>::max())),
        off_surface(ray.start.t_error) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      origin[axis] = ray.origin[static_cast<int>(axis)];
      direction[axis] = ray.direction[static_cast<int>(axis)];
      inverse[axis] = 1 / direction[axis];
    }
    squared_speed = dot(direction, direction);
    inverse_squared_speed = 1 / squared_speed;
    inverse_speed = std::sqrt(inverse_squared_speed);
  }

  /// Whether all of it can be squared and divided by.
  bool is_fair() const {
    constexpr double steepest = 0x1p500;
    bool fair = squared_speed > 1 / steepest && squared_speed < steepest;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      fair = fair && (direction[axis] == 0 || std::abs(inverse[axis]) < steepest);
    }
    return fair;
  }

  std::array<double, 3> origin;
  std::array<double, 3> direction;
  std::array<double, 3> inverse;
  double squared_speed;
  double inverse_squared_speed;
  double inverse_speed;
  double begin;
  double certain_from;  ///< what is at the start, and what ahead of it, is told by more than t up to there
  double limit;         ///< finite, unlike what never comes
  double off_surface;   ///< how far rounding may have put the start from the surface that it is on
};

/// Where a line enters and leaves each leaf that it is not surely outside of: at some t from `from` to `to`.
/// Where nothing is known these are not numbers, and all comparing with them says no.
class CsgSketch::Ends {
 public:
  explicit Ends(const Line& line) : line_(line) {}

  /// With w the way to the center, the closest approach is at c = w . d / d^2, at a squared distance of q^2,
  /// and half the chord is h with h^2 = (r^2 - q^2) / d^2.
  ///
  /// Roundings change h^2 by less than 32 u (w^2 + r^2) / d^2. Let E be 16 times that, and a little more if
  /// the start was rounded: then the ends are between c +- (H - 2 E / H) and c +- H for H^2 = h^2 + E, and so
  /// are they with the error bounds of an exact test (standard_error(), grazing_error(): e = 16 u r^2 / (d^2
  /// h) at most and never more than sqrt(2 h e)), as (h + e)^2 <= h^2 + E/4 and (h - e) H >= h^2 - E/4. If
  /// the chord is as short as that, H - 2 E / H is negative, and the inside of the sphere is nowhere certain.
  void set(const Spheres& spheres, std::size_t group) {
    const std::array<Lanes, 3> way = way_to(spheres);
    const Lanes squared_radius = spheres.radius * spheres.radius;
    const Lanes closest = dot_with_direction(way) * line_.inverse_squared_speed;
    const std::array<Lanes, 3> across = {way[0] - closest * line_.direction[0],
                                         way[1] - closest * line_.direction[1],
                                         way[2] - closest * line_.direction[2]};
    const Lanes room_error = room_error_of(dot(way, way), squared_radius, spheres.radius);
    const Lanes room = squared_radius - dot(across, across) + room_error;
    const LaneMask missed = room < 0.0;
    if (all(missed)) {
      outside_ |= places_of(group);
      return;
    }
    const Lanes outer = sqrt(room * line_.inverse_squared_speed);
    const Lanes inner = outer - 2.0 * line_.inverse_squared_speed * room_error / outer;
    const Lanes error = slack * (size_of(closest) + spheres.radius * line_.inverse_speed);
    enter_from_[group] = closest - outer - error;
    enter_to_[group] = closest - inner + error;
    leave_from_[group] = closest + inner - error;
    leave_to_[group] = closest + outer + error;
    finish(group, missed);
  }

  /// By slabs; three roundings go into each t. A line along a face's plane is told nothing.
  void set(const Boxes& boxes, std::size_t group) {
    Lanes enter = lanes_of(-infinity);
    Lanes leave = lanes_of(infinity);
    LaneMask known = enter < leave;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Lanes first = (boxes.lower[axis] - line_.origin[axis]) * line_.inverse[axis];
      const Lanes second = (boxes.upper[axis] - line_.origin[axis]) * line_.inverse[axis];
      known &= (first <= second) | (first > second);
      enter = max(enter, min(first, second));
      leave = min(leave, max(first, second));
    }
    constexpr double less = 1 - slack;
    constexpr double more = 1 + slack;
    const Lanes enter_from = min(enter * less, enter * more);
    const Lanes leave_to = max(leave * less, leave * more);
    enter_from_[group] = known ? enter_from : lanes_of(unknown);
    enter_to_[group] = known ? max(enter * less, enter * more) : lanes_of(unknown);
    leave_from_[group] = known ? min(leave * less, leave * more) : lanes_of(unknown);
    leave_to_[group] = known ? leave_to : lanes_of(unknown);
    finish(group, known & (enter_from > leave_to));
  }

  /// A leaf that the ray starts on and leaves for good.
  void set_left(std::size_t place) { outside_ |= bit_of(place); }
  /// A leaf that the ray starts on and goes into; false if it is not plain that it is inside soon.
  bool set_entered(std::size_t place) {
    if ((outside_ & bit_of(place)) != 0) return false;
    if (!(enter_to(place) <= line_.certain_from && leave_from(place) > line_.certain_from)) return false;
    for (PerGroup* enter : {&enter_from_, &enter_to_}) set(*enter, place, -infinity);
    return true;
  }

  /// Whether the distance of the start from a sphere's surface is what rounding makes of 0.
  bool starts_on(const Spheres& spheres, std::size_t lane) const {
    const std::array<Lanes, 3> way = way_to(spheres);
    const Lanes squared_way = dot(way, way);
    const Lanes squared_radius = spheres.radius * spheres.radius;
    const Lanes off = size_of(squared_way - squared_radius);
    return off[lane] < share_of_start * room_error_of(squared_way, squared_radius, spheres.radius)[lane];
  }

  /// The leaves that the line surely is outside of as long as it matters. Of others only there are ends.
  Places outside() const { return outside_; }
  double enter_from(std::size_t place) const { return at(enter_from_, place); }
  double enter_to(std::size_t place) const { return at(enter_to_, place); }
  double leave_from(std::size_t place) const { return at(leave_from_, place); }
  double leave_to(std::size_t place) const { return at(leave_to_, place); }

  /// The first t not before this one at which the line may be inside of a leaf, and outside of it.
  double inside_from(std::size_t place, double t) const {
    return t > leave_to(place) ? infinity : std::max(t, enter_from(place));
  }
  double outside_from(std::size_t place, double t) const {
    return t > enter_to(place) && t < leave_from(place) ? leave_from(place) : t;
  }

  /// The leaves of a group that the line surely is inside of from one t to another, and outside of.
  Places inside(std::size_t group, double from, double to) const {
    return bits((enter_to_[group] < from) & (leave_from_[group] > to), group);
  }
  Places outside(std::size_t group, double from, double to) const {
    return bits((enter_from_[group] > to) | (leave_to_[group] < from), group);
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  /// Relative, 512 roundings: far more than what the sums here are off by and the bounds on the errors of
  /// exact crossings together.
  static constexpr double slack = 0x1p-44;
  /// A start that was meant to be on a sphere is off it by less than so much of what is allowed for in all.
  static constexpr double share_of_start = 0x1p-4;

  using PerGroup = std::array<Lanes, most_places / lane_count>;

  static void set(PerGroup& ends, std::size_t place, double t) {
    ends[place / lane_count][place % lane_count] = t;
  }
  static double at(const PerGroup& ends, std::size_t place) {
    return ends[place / lane_count][place % lane_count];
  }
  static Places bits(const LaneMask& mask, std::size_t group) {
    return mask_of(mask) << (group * lane_count);
  }

  std::array<Lanes, 3> way_to(const Spheres& spheres) const {
    return {spheres.center[0] - line_.origin[0], spheres.center[1] - line_.origin[1],
            spheres.center[2] - line_.origin[2]};
  }
  Lanes dot_with_direction(const std::array<Lanes, 3>& v) const {
    return v[0] * line_.direction[0] + v[1] * line_.direction[1] + v[2] * line_.direction[2];
  }
  /// E d^2, see above.
  Lanes room_error_of(const Lanes& squared_way, const Lanes& squared_radius, const Lanes& radius) const {
    constexpr double surfaces_off = 32;
    return slack * (squared_way + squared_radius) + (surfaces_off * line_.off_surface) * radius;
  }

  /// What may be at the start may be before it as well.
  void finish(std::size_t group, const LaneMask& missed) {
    const auto widen = [&](Lanes& from) {
      from = from <= line_.certain_from ? min(from, lanes_of(line_.begin)) : from;
    };
    widen(enter_from_[group]);
    widen(leave_from_[group]);
    outside_ |= bits(missed, group) | outside(group, line_.begin, line_.limit);
  }

  const Line& line_;
  PerGroup enter_from_;
  PerGroup enter_to_;
  PerGroup leave_from_;
  PerGroup leave_to_;
  Places outside_ = 0;
};

}  // namespace crt::core
