// A line is divided into runs that are in a solid, outside of it, or not known, as boxes of it
// show.
#pragma once

#include <cstdint>
#include <vector>

#include "core/measure/measure_clock.hpp"
#include "core/measure/solid_cells.hpp"

namespace crt::core {

/// A SolidLine is a line whose points have exact distances from its origin.
class SolidLine {
 public:
  /// The direction is finite and not 0.
  SolidLine(const Vec3& origin, const Vec3& direction);

  /// Returns a box around all points from one distance to another.
  Bounds box(double from, double to) const;
  /// Returns the point at a distance, rounded.
  Vec3 at(double distance) const;
  const std::array<Interval, 3>& unit() const { return unit_; }
  /// Returns how near each other ends of runs may come, up to a distance from the origin.
  double resolution(double distance) const;

 private:
  Vec3 origin_;
  std::array<Interval, 3> unit_;  ///< of length 1
};

/// A LineRun goes from one distance to another.
struct LineRun {
  enum class Kind : std::uint8_t { empty, full, open };

  double from = 0;
  double to = 0;
  Kind kind = Kind::open;
};

/// Returns all runs between two distances, in order, each of another kind than the next. What is
/// open is divided until it is as short as is wanted, which is no less than rounding lets it be, or
/// until there are very many parts, as where a line is in a face. The clock counts looks.
std::vector<LineRun> runs_of_line(const CellSolid& solid, const SolidLine& line, double from,
                                  double to, MeasureClock& clock, double shortest = 0);

}  // namespace crt::core
