// Polygons are cut into triangles here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "crt/entity.hpp"
#include "crt/vec.hpp"

namespace crt::core {

/// A PolygonCutter cuts polygons into triangles with the polygon's corners. They go around as the
/// polygon does. A convex polygon becomes a fan from its first corner. Of others, ears are cut off:
/// triangles with two sides of the polygon and no other corner inside or on them (G. Meisters,
/// Polygons have ears, 1975). What crosses itself, or has no area, ends as a fan.
///
/// A corner on the straight line between its neighbours is nobody's ear. So no triangle is without
/// an area, where that can be, and polygons that meet along a side with such a corner stay closed.
class PolygonCutter {
 public:
  /// Returns the triangles of a polygon of at least three corners, as indices of `corners`. They
  /// hold until the next call.
  std::span<const TriangleIndices> cut(std::span<const Vec3> corners);

  /// Returns how many corners were looked at so far to find ears. It may grow with the third power
  /// of a polygon's corners. Callers keep it within bounds.
  std::uint64_t steps() const { return steps_; }
  /// A cut ends with a mere fan of what is left once steps() exceeds this.
  static constexpr std::uint64_t most_steps = 1'000'000'000;

 private:
  struct Flat {
    double x = 0;
    double y = 0;
  };

  void flatten(std::span<const Vec3> corners);
  double turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  bool is_convex() const;
  bool is_ear(std::uint32_t corner);
  void cut_ears();
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) { triangles_.push_back({a, b, c}); }

  std::vector<Flat> flat_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> previous_;
  std::vector<TriangleIndices> triangles_;
  std::uint64_t steps_ = 0;
};

}  // namespace crt::core
