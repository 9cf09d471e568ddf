// The parts of lines within the leaves of a CSG object are enclosed here, as far as they matter.
#pragma once

#include <cstdint>

#include "core/geometry/placed_solid.hpp"
#include "core/ray/enclosure.hpp"

namespace crt::core {

/// EnclosedLines are lines whose intervals within leaves are to be found.
template <class Real>
class EnclosedLines {
 public:
  using Mask = MaskOf<Real>;

  EnclosedLines(const FilterLine<Real>& lines, const Real& limits, const Mask& asked)
      : lines_(lines), asked_(asked), limits_(finite(limits)) {
    constexpr double steepest = 0x1p500;
    // Even what the squares of fair sizes are by t^2 is a normal number then.
    constexpr double largest_square = 0x1p100;
    asked_ = asked_ && lines.squared_length > 1 / largest_square &&
             lines.squared_length < largest_square;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      asked_ = asked_ && (lines.direction[axis] == 0.0 || abs(lines.inverse[axis]) < steepest);
    }
  }

  const FilterLine<Real>& lines() const { return lines_; }
  const Real& limits() const { return limits_; }  ///< finite, unlike what never comes
  /// Returns those of the lines whose directions can be squared and divided by. The intervals of
  /// the others mean nothing.
  const Mask& asked() const { return asked_; }

  /// Encloses the part of the lines in a leaf. Returns false if all lines surely are outside as
  /// long as it matters. The enclosure then means nothing.
  [[gnu::always_inline]] bool enclose(const PlacedSolid& solid, Enclosure<Real>& part) const {
    return solid.enclose(lines_, asked_, nullptr, part)&& restrict(part);
  }

  /// Returns whether a ray that starts on a face of a solid, and to its inner side, surely comes
  /// into it there.
  bool starts_inwards(const PlacedSolid& solid, std::uint32_t face, std::size_t lane) const {
    return any(lane_bit(lane) && solid.starts_inwards(face, lines_));
  }
  bool starts_at_0(std::size_t lane) const { return any(lane_bit(lane) && lines_.begin == 0.0); }
  /// Returns whether a ray that starts into a leaf is inside of it as soon as crossings count.
  bool is_inside_soon(const Enclosure<Real>& interval, std::size_t lane) const {
    const Mask soon =
        interval.enter_to <= lines_.certain_from && interval.leave_from > lines_.certain_from;
    return any(lane_bit(lane) && soon);
  }
  /// Returns whether a ray that starts out of a leaf has left it as soon as crossings count.
  bool is_outside_soon(const Enclosure<Real>& interval, std::size_t lane) const {
    return any(lane_bit(lane) && interval.leave_to <= lines_.certain_from);
  }

  static Mask lane_bit(std::size_t lane) { return lanes_of_mask<Real>(std::uint32_t{1} << lane); }

 private:
  [[gnu::always_inline]] Real widened(const Real& from) const {
    return select(from <= lines_.certain_from, min(from, lines_.begin), from);
  }
  /// Restricts an enclosure to what matters. What may be at the start may be before it as well.
  /// Returns false if nothing matters.
  [[gnu::always_inline]] bool restrict(Enclosure<Real>& part) const {
    part.enter_from = widened(part.enter_from);
    part.leave_from = widened(part.leave_from);
    const Mask outside = part.is_outside(lines_.begin, limits_);
    if (!any(asked_ && !outside)) return false;
    if (any(outside)) part.set_outside(outside);
    return true;
  }

  const FilterLine<Real>& lines_;
  Mask asked_;
  Real limits_;
};

}  // namespace crt::core
