// Where lines are within a box, surely.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/geometry/placed_solid.hpp"

namespace crt::core {

/// A box whose faces are parallel to the coordinate planes, as doubles have it to the last bit.
/// Faces are numbered as in geometry/box/box.hpp.
struct EnclosedBox {
  Vec3 lower{0, 0, 0};
  Vec3 upper{0, 0, 0};

  /// Returns it where a placement puts it, or nothing if no doubles are exactly there.
  template <class Placement>
  std::optional<EnclosedBox> placed(const Placement& placement) const {
    const std::optional<Vec3> at_lower = placement.exactly_to_world(lower);
    const std::optional<Vec3> at_upper = placement.exactly_to_world(upper);
    if (!at_lower || !at_upper) return {};
    return EnclosedBox{*at_lower, *at_upper};
  }

  static constexpr std::uint32_t flat_faces = 6;
  static constexpr std::size_t axis_of(std::uint32_t face) { return face / 2; }
  static constexpr bool is_upper(std::uint32_t face) { return face % 2 == 1; }
};

/// Where a line meets the six planes of a box, in units of t, by quotients that are off by three
/// roundings.
template <class Real>
struct BoxMeetings {
  using Mask = MaskOf<Real>;

  std::array<Real, 3> enter;  ///< by axis
  std::array<Real, 3> leave;
  /// Where this is false nothing is certain. The line is not so flat to any face that quotients
  /// fail; or it goes just along a face and is plainly not on it: what lies between two planes
  /// comes there at minus infinity and leaves at infinity, and what lies beside them comes never.
  Mask known;

  static BoxMeetings of(const EnclosedBox& box, const FilterLine<Real>& line);
  /// Does so for lines of which some start on the surfaces of faces, unless `starts` is null.
  static BoxMeetings of(const EnclosedBox& box, const FilterLine<Real>& line,
                        const FaceStarts<Real>* starts) {
    BoxMeetings result = of(box, line);
    for (std::size_t face = 0; starts != nullptr && face < EnclosedBox::flat_faces; ++face) {
      if (any(starts->on[face])) result.start_on(face, starts->on[face], line);
    }
    return result;
  }

  /// Makes lines start on the surface of a face by identity, inwards or outwards. The face is
  /// exactly at t = 0; it is put before that by next to nothing, which is plainly not after the
  /// start.
  void start_on(std::size_t face, const Mask& lines, const FilterLine<Real>& line);

  Real last_enter() const { return max(max(enter[0], enter[1]), enter[2]); }
  Real first_leave() const { return min(min(leave[0], leave[1]), leave[2]); }

  /// Returns a bound on the error of one of these, for its own roundings and those of an exact test
  /// together, down to where neither the distance nor t has a normal number any more.
  static Real error_of(const Real& t) { return enclosing_slack * abs(t) + next_to_nothing; }

  /// Returns the part of the lines in the box: from the last of the three planes that they enter by
  /// to the first of the three that they leave by.
  Enclosure<Real> enclosure() const {
    const Real last_entered = last_enter();
    const Real first_left = first_leave();
    const Real enter_error = error_of(last_entered);
    const Real leave_error = error_of(first_left);
    Enclosure<Real> part{.enter_from = last_entered - enter_error,
                         .enter_to = last_entered + enter_error,
                         .leave_from = first_left - leave_error,
                         .leave_to = first_left + leave_error};
    if (!all(known)) part.set_unknown(!known);
    return part;
  }

 private:
  /// If a known line meets a plane at a larger t, the distance to it is more than 2^-950.
  static constexpr double next_to_nothing = 0x1p-450;
  static constexpr double before_start = -0x1p-400;
  static constexpr double steepest = 0x1p500;
  static constexpr double never = 0x1p1000;
};

template <class Real>
BoxMeetings<Real> BoxMeetings<Real>::of(const EnclosedBox& box, const FilterLine<Real>& line) {
  BoxMeetings result;
  const auto& inverse = line.inverse;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<int>(axis);
    const Real lower = (box.lower[i] - line.origin[axis]) * inverse[axis];
    const Real upper = (box.upper[i] - line.origin[axis]) * inverse[axis];
    const Mask upwards = inverse[axis] > 0.0;
    result.enter[axis] = select(upwards, lower, upper);
    result.leave[axis] = select(upwards, upper, lower);
  }
  result.known = max(max(abs(inverse[0]), abs(inverse[1])), abs(inverse[2])) < steepest;
  if (all(result.known)) return result;
  result.known = lanes_of_mask<Real>(~std::uint32_t{0});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<int>(axis);
    const Real& origin = line.origin[axis];
    const Mask along = line.direction[axis] == 0.0;
    const Mask between = along && origin > box.lower[i] && origin < box.upper[i];
    const double size = enclosing_slack * (std::abs(box.lower[i]) + std::abs(box.upper[i]));
    const Real margin = size + starts_off * line.start_error;
    const Mask beside = along && (origin < box.lower[i] - margin || origin > box.upper[i] + margin);
    result.enter[axis] = select(beside, broadcast<Real>(never), result.enter[axis]);
    result.leave[axis] = select(beside, broadcast<Real>(-never), result.leave[axis]);
    result.known = result.known && (between || beside || abs(inverse[axis]) < steepest);
  }
  return result;
}

template <class Real>
void BoxMeetings<Real>::start_on(std::size_t face, const Mask& lines,
                                 const FilterLine<Real>& line) {
  const std::size_t axis = face / 2;
  const bool is_upper = face % 2 != 0;
  const Mask upwards = line.inverse[axis] > 0.0;
  const Mask enters = lines && (is_upper ? line.inverse[axis] < 0.0 : upwards);
  const Mask leaves = lines && (is_upper ? upwards : line.inverse[axis] < 0.0);
  known = known && !(lines && line.direction[axis] == 0.0);
  enter[axis] = select(enters, broadcast<Real>(before_start), enter[axis]);
  leave[axis] = select(leaves, broadcast<Real>(before_start), leave[axis]);
}

/// Encloses the part of lines in a box. Returns false if none of the lines that are asked for comes
/// near it; the enclosure then means nothing.
template <class Real>
bool enclose(const EnclosedBox& box, const FilterLine<Real>& line, const MaskOf<Real>& asked,
             const FaceStarts<Real>* starts, Enclosure<Real>& part) {
  part = BoxMeetings<Real>::of(box, line, starts).enclosure();
  const MaskOf<Real> misses = part.enter_from > part.leave_to;
  if (!any(asked && !misses)) return false;
  if (any(misses)) part.set_outside(misses);
  return true;
}

/// Returns whether lines come from outside to a face of a box.
template <class Real>
MaskOf<Real> starts_inwards(const EnclosedBox& /*box*/, std::uint32_t face,
                            const FilterLine<Real>& line) {
  const Real& speed = line.direction[EnclosedBox::axis_of(face)];
  return EnclosedBox::is_upper(face) ? speed < 0.0 : speed > 0.0;
}

}  // namespace crt::core
