// A field along a line is evaluated in interval arithmetic, together with its derivative
// (field_part.hpp).
#pragma once

#include <array>

#include "core/geometry/implicit/field_program.hpp"
#include "core/math/interval.hpp"

namespace crt::core {

class FieldLine {
 public:
  /// Makes the line of all points place + x direction.
  FieldLine(const FieldProgram& program, const std::array<Interval, 3>& place,
            const std::array<Interval, 3>& direction)
      : program_(program), place_(place), direction_(direction) {}

  struct Values {
    Interval middle;  ///< at middle_of() the part
    Interval all;     ///< anywhere in the part
    Interval slope;   ///< between any two points of the part
    /// Says whether the field may have no value somewhere. The intervals are without such points.
    bool may_be_undefined = false;
    bool is_undefined = false;  ///< it has none in the whole part, and the intervals mean nothing

    bool is_monotone() const { return !may_be_undefined && (slope.lo > 0 || slope.hi < 0); }
    bool is_inside() const { return !may_be_undefined && all.hi <= 0; }
    bool is_outside() const { return is_undefined || all.lo > 0; }
  };

  /// Evaluates the field for all x from one number to another, or for one number.
  Values evaluate(double from, double to) const;

  static double middle_of(double from, double to) { return from + 0.5 * (to - from); }

 private:
  const FieldProgram& program_;
  std::array<Interval, 3> place_;
  std::array<Interval, 3> direction_;
};

}  // namespace crt::core
