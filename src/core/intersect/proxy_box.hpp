// The cheap test of boxes, by slabs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/math/lanes.hpp"
#include "core/ray/filter_line.hpp"

namespace crt::core {

/// A box that is an object of its own, without a transform. Faces are numbered as in
/// geometry/box.hpp.
struct ProxyBox {
  static constexpr std::size_t face_count = 6;

  Vec3 lower{0, 0, 0};
  Vec3 upper{0, 0, 0};
  std::uint32_t leaf = 0;
  bool is_resolved = false;  ///< whether the proxy alone tells its crossings: in the standard tier
  std::array<bool, face_count> flipped{};  ///< as FaceSurface has it
  std::array<std::uint32_t, face_count> surfaces{};
};

/// Where a line meets the six planes of a box, in units of t, by quotients that are off by three
/// roundings.
template <class Real>
struct BoxMeetings {
  using Mask = decltype(Real{} < Real{});

  std::array<Real, 3> enter;  ///< by axis
  std::array<Real, 3> leave;
  /// Not so flat to any face that quotients fail, or just along it and plainly not on it: what lies
  /// between two planes comes there at minus infinity and leaves at infinity. Else nothing is
  /// certain.
  Mask known;

  /// The box has what ProxyBox calls lower and upper.
  template <class Box>
  static BoxMeetings of(const Box& box, const FilterLine<Real>& line);

  /// Those lines start on the surface of a face by identity, inwards or outwards: it is exactly at
  /// t = 0. Put in before that by next to nothing, which is plainly not after the start.
  void start_on(std::size_t face, const Mask& lines, const FilterLine<Real>& line);

  Real last_enter() const { return max(max(enter[0], enter[1]), enter[2]); }
  Real first_leave() const { return min(min(leave[0], leave[1]), leave[2]); }

  /// Of one of these: more than its own roundings and those of the exact test together, down to
  /// where way or t have no normal number any more.
  static Real error_of(const Real& t) { return filter_detail::slack * abs(t) + next_to_nothing; }

 private:
  /// If a known line meets a plane at a larger t the way there is more than 2^-950.
  static constexpr double next_to_nothing = 0x1p-450;
  static constexpr double before_start = -0x1p-400;
  static constexpr double steepest = 0x1p500;
};

template <class Real>
template <class Box>
BoxMeetings<Real> BoxMeetings<Real>::of(const Box& box, const FilterLine<Real>& line) {
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
    const Mask between =
        line.direction[axis] == 0.0 && origin > box.lower[i] && origin < box.upper[i];
    result.known = result.known && (between || abs(inverse[axis]) < steepest);
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

/// A box against the part of a line up to `limit`: with the last of the three planes that it enters
/// by, and the first of the three that it leaves by.
template <class Real>
auto test_box(const BoxMeetings<Real>& meetings, const FilterLine<Real>& line, const Real& limit) {
  const Real enter = meetings.last_enter();
  const Real leave = meetings.first_leave();
  const Real enter_error = meetings.error_of(enter);
  const Real leave_error = meetings.error_of(leave);
  const Real enter_from = enter - enter_error;
  const Real enter_to = enter + enter_error;
  const Real leave_from = leave - leave_error;
  const Real leave_to = leave + leave_error;
  using Mask = typename BoxMeetings<Real>::Mask;
  const Mask rejected = enter_from > leave_to || leave_to < line.begin || enter_from > limit;
  const Mask enters = enter_from > line.certain_from && enter_to < line.certain_to;
  const Mask leaves = leave_from > line.certain_from && leave_to < line.certain_to;
  return Decision<Mask>{.rejected = meetings.known && rejected,
                        .accepted = meetings.known && enter_to < leave_from && (enters || leaves)};
}

}  // namespace crt::core
