// A passing line is asked between which edges of triangles it passes.
//
// It passes an edge from a to b on the side that is the sign of
//    S = d . ((a - o) x (b - o)),
// and crosses a triangle if it passes all three edges on the same side, which then is the sign of
// d . n for the triangle's normal n. The sign is that of the exact number: by doubles with a bound
// on their error, or else by exact arithmetic.
//
// Where S is 0 the line is moved by an infinitely small amount, always in the same way: its origin
// by (e, e^2, e^3) and its direction by (f, f e^(1/3), f e^(2/3)), where f is far smaller than any
// power of e (Edelsbrunner, Muecke, Simulation of simplicity, 1990). With the edge's vector
// v = b - a, S then changes by the products of these six with the components of d x v and of
// (a - o) x (b - o), and of pairs of them with components of v. The first of these that is not 0
// has the sign. So a line always meets a closed mesh as one that touches no edge does: it crosses
// an even number of triangles, one or none of those that share the edge or corner it meets, and
// none of those that it lies in.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "core/geometry/exact_ray.hpp"
#include "core/math/vector_lanes.hpp"

namespace crt::core {

/// TriangleLanes are the corners a, b, c of triangles side by side.
using TriangleLanes = std::array<VectorLanes, 3>;

class PassingLine {
 public:
  /// Takes the line that a ray's doubles say.
  explicit PassingLine(const ObjectRay& ray) : PassingLine(ray, nullptr, 0, 0) {}
  /// Takes the line that a ray of the exact tier is without rounding. It must outlive this.
  explicit PassingLine(const ExactRay& ray)
      : PassingLine(ray.near, &ray, ray.origin_error, ray.direction_error) {}

  /// A Crossed has a bit for each triangle that the line crosses.
  struct Crossed {
    std::uint32_t along = 0;    ///< those crossed along their normals
    std::uint32_t against = 0;  ///< and against them
  };
  /// Returns which of the triangles it crosses that have a bit in `some`.
  Crossed crosses(const TriangleLanes& triangles, std::uint32_t some);

  const ObjectRay& near() const { return near_; }
  /// Returns a bound on the distance of near() from the line at its begin.
  double origin_error() const { return origin_error_; }

 private:
  PassingLine(const ObjectRay& near, const ExactRay* ray, double origin_error,
              double direction_error);

  /// Sides are those on which the line passes the edges of triangles, with a bit for each triangle.
  struct Sides {
    std::uint32_t left = 0;                  ///< passes an edge on the left
    std::uint32_t right = 0;                 ///< passes an edge on the right
    std::array<std::uint32_t, 3> decided{};  ///< by edge, where that is known
  };
  /// Decides what is open of those triangles that the line may cross.
  void decide(const TriangleLanes& triangles, std::uint32_t some, Sides& sides);

  const ExactLine& exact();
  /// Returns the side of one edge, which is never 0.
  int exact_side(const Vec3& from, const Vec3& to);

  const ObjectRay& near_;
  const ExactRay* ray_;
  Vec3 direction_;  ///< the largest component is in [1, 2)
  double origin_error_;
  double direction_error_;  ///< of direction_
  std::optional<ExactLine> exact_;
};

/// These round as multiply_add() does.
inline Lanes fused_dot(const VectorLanes& a, const VectorLanes& b) {
  return multiply_add(a.z, b.z, multiply_add(a.y, b.y, a.x * b.x));
}
inline VectorLanes fused_cross(const VectorLanes& a, const VectorLanes& b) {
  return {multiply_add(a.y, b.z, -a.z * b.y), multiply_add(a.z, b.x, -a.x * b.z),
          multiply_add(a.x, b.y, -a.y * b.x)};
}

// Errors. Six products of components make up S, each below 2 m^2 for the largest component m of
// the offsets. Each is off by 8 roundings at most, those of the offsets and sums among them. An
// error of the origin changes two factors, one of the direction a third.
[[gnu::always_inline]] inline PassingLine::Crossed PassingLine::crosses(
    const TriangleLanes& triangles, std::uint32_t some) {
  const VectorLanes origin = lanes_of(near_.origin);
  const VectorLanes direction = lanes_of(direction_);
  const VectorLanes to_a = triangles[0] - origin;
  const VectorLanes to_b = triangles[1] - origin;
  const VectorLanes to_c = triangles[2] - origin;
  const VectorLanes across_a = fused_cross(direction, to_a);
  const VectorLanes across_b = fused_cross(direction, to_b);
  const std::array<Lanes, 3> volumes = {fused_dot(across_a, to_b), fused_dot(across_b, to_c),
                                        -fused_dot(across_a, to_c)};
  const Lanes size =
      max(max(largest_component(to_a), largest_component(to_b)), largest_component(to_c));
  constexpr double roundings = 6 * 2 * 8 + 1;
  const double by_direction = roundings * unit_roundoff + 6 * direction_error_;
  constexpr double least_size = 0x1p-450;  // so that nothing underflows
  const Lanes open = select(size > least_size, size * (size * by_direction + 24 * origin_error_),
                            lanes_of(std::numeric_limits<double>::infinity()));
  Sides sides;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t to_left = mask_of(volumes[i] > open);
    const std::uint32_t to_right = mask_of(volumes[i] < -open);
    sides.decided[i] = to_left | to_right;
    sides.left |= to_left;
    sides.right |= to_right;
  }
  const std::uint32_t decided = sides.decided[0] & sides.decided[1] & sides.decided[2];
  if ((some & ~(sides.left & sides.right) & ~decided) != 0) decide(triangles, some, sides);
  return {.along = some & sides.left & ~sides.right, .against = some & sides.right & ~sides.left};
}

}  // namespace crt::core
