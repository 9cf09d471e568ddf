// Where lines are within a solid, as intervals that surely hold the ends of that part.
#pragma once

#include <array>
#include <limits>

#include "core/ray/filter_line.hpp"

namespace crt::core {

/// The part of a line within a solid: the line enters it at some t of one interval and leaves it at
/// some t of another. Between the two it surely is inside, before and after them surely outside.
/// The intervals hold what any exact test makes of these ends, with its bound on the error.
///
/// The ends are infinite where a line surely misses the solid (it enters at infinity and leaves at
/// minus infinity) and where nothing bounds them. Where nothing is known they are NaN, and all
/// comparisons with them are false.
template <class Real>
struct Enclosure {
  using Mask = MaskOf<Real>;

  Real enter_from;
  Real enter_to;
  Real leave_from;
  Real leave_to;

  /// Returns the first t not before this one at which a line may be inside.
  Real inside_from(const Real& t) const {
    return select(t > leave_to, broadcast<Real>(std::numeric_limits<double>::infinity()),
                  max(t, enter_from));
  }
  /// Returns the first t not before this one at which a line may be outside.
  Real outside_from(const Real& t) const {
    return select(t > enter_to && t < leave_from, leave_from, t);
  }

  /// Returns whether a line surely is inside from one t to another.
  Mask is_inside(const Real& from, const Real& to) const {
    return enter_to < from && leave_from > to;
  }
  /// Returns whether a line surely is outside from one t to another.
  Mask is_outside(const Real& from, const Real& to) const {
    return enter_from > to || leave_to < from;
  }
  /// Returns whether a line surely is inside somewhere.
  Mask is_met() const { return enter_to <= leave_from; }

  /// Makes lines never be inside.
  void set_outside(const Mask& of_lines) {
    const Real never = broadcast<Real>(std::numeric_limits<double>::infinity());
    *this = {.enter_from = select(of_lines, never, enter_from),
             .enter_to = select(of_lines, never, enter_to),
             .leave_from = select(of_lines, -never, leave_from),
             .leave_to = select(of_lines, -never, leave_to)};
  }
  /// Makes lines that go into the solid where they start be inside from the first.
  void set_inside_first(const Mask& of_lines) {
    const Real always = broadcast<Real>(-std::numeric_limits<double>::infinity());
    enter_from = select(of_lines, always, enter_from);
    enter_to = select(of_lines, always, enter_to);
  }
  /// Makes nothing be known of lines.
  void set_unknown(const Mask& of_lines) {
    const Real nothing_known = broadcast<Real>(std::numeric_limits<double>::quiet_NaN());
    *this = {.enter_from = select(of_lines, nothing_known, enter_from),
             .enter_to = select(of_lines, nothing_known, enter_to),
             .leave_from = select(of_lines, nothing_known, leave_from),
             .leave_to = select(of_lines, nothing_known, leave_to)};
  }
};

inline void set_lane(Enclosure<double>& part, std::size_t /*lane*/,
                     const Enclosure<double>& of_lane) {
  part = of_lane;
}
inline void set_lane(Enclosure<Lanes>& part, std::size_t lane, const Enclosure<double>& of_lane) {
  part.enter_from[lane] = of_lane.enter_from;
  part.enter_to[lane] = of_lane.enter_to;
  part.leave_from[lane] = of_lane.leave_from;
  part.leave_to[lane] = of_lane.leave_to;
}

/// Where a line crosses a surface, which it does just once: at some t of an interval, as above.
template <class Real>
struct EnclosedCrossing {
  Real from;
  Real to;

  /// Returns whether it surely counts.
  MaskOf<Real> counts(const FilterLine<Real>& line) const {
    return from > line.certain_from && to < line.certain_to;
  }
};

/// What is certain of the crossings of a solid's surface along a line.
template <class Mask>
struct Decision {
  Mask rejected;  ///< no crossing counts
  Mask accepted;  ///< one surely does
};

/// Returns a limit below infinity, which is where solids that lines never enter or leave are put.
template <class Real>
[[gnu::always_inline]] inline Real finite(const Real& limit) {
  return min(limit, broadcast<Real>(std::numeric_limits<double>::max()));
}

/// Returns whether lines surely are outside between their begin and a limit. It is all that is
/// certain of what is somewhere within the solid.
template <class Real>
[[gnu::always_inline]] inline MaskOf<Real> is_outside(const Enclosure<Real>& part,
                                                      const FilterLine<Real>& line,
                                                      const Real& limit) {
  return part.is_outside(line.begin, finite(limit));
}

/// Decides whether crossings count between a line's begin and a limit. `may_accept` is false where
/// nobody asks whether one surely does.
template <class Real>
[[gnu::always_inline]] inline auto decide(const Enclosure<Real>& part, const FilterLine<Real>& line,
                                          const Real& limit, bool may_accept) {
  using Mask = MaskOf<Real>;
  Decision<Mask> decision{
      .rejected = is_outside(part, line, limit) || part.is_inside(line.begin, finite(limit)),
      .accepted = {}};
  if (!may_accept || all(decision.rejected)) return decision;
  const EnclosedCrossing<Real> entry{part.enter_from, part.enter_to};
  const EnclosedCrossing<Real> exit{part.leave_from, part.leave_to};
  decision.accepted = part.is_met() && (entry.counts(line) || exit.counts(line));
  return decision;
}

/// A relative error of 512 roundings. It is far more than what the sums of a primitive's enclose()
/// are off by and the bounds on the errors of exact crossings together.
inline constexpr double enclosing_slack = 0x1p-44;

/// A start that rounding has put off a surface is off it by less than so many of its errors.
inline constexpr double starts_off = 32;

/// What is nowhere near is so far away, by distance.
inline constexpr double far_away = 0x1p900;

/// Returns the offset from a line's origin to a place.
template <class Real>
std::array<Real, 3> offset_to(const FilterLine<Real>& line, const Vec3& place) {
  return {place.x - line.origin[0], place.y - line.origin[1], place.z - line.origin[2]};
}

}  // namespace crt::core
