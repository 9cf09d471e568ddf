// Where lines enter a shape and leave it, side by side, where that is plain.
#pragma once

#include <cstdint>

#include "core/geometry/placed_solid.hpp"
#include "core/math/lanes.hpp"
#include "core/ray/filter_line.hpp"
#include "core/ray/object_ray.hpp"

namespace crt::core {

/// A SpanEnd is a crossing of one line, or of as many as a Real has lanes.
template <class Real>
struct SpanEnd {
  MaskOf<Real> known{};  ///< if not, crossings() is to be asked, and the rest means nothing
  Real t{};
  Real error{};  ///< as in Crossing
  Real face{};   ///< its number
};

/// A ShapeSpan is the first part of lines that is inside a shape.
template <class Real>
struct ShapeSpan {
  MaskOf<Real> misses{};  ///< the line is nowhere inside
  SpanEnd<Real> enter{};
  SpanEnd<Real> leave{};
  std::uint8_t leave_root = 0;  ///< Crossing::root there; where the line enters it is 0
};

/// WantedEnds says which lines' ends are to be found. Others may be found as well.
template <class Real>
struct WantedEnds {
  MaskOf<Real> enter;
  MaskOf<Real> leave;
  /// Says that of both ends only the first is wanted that surely counts. A shape may then say of a
  /// line that it entered at minus infinity, and that it misses what is surely before its begin.
  bool only_first = false;
};

}  // namespace crt::core
