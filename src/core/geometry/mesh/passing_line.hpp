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
  /// Returns the line without rounding.
  const ExactLine& exact();

 private:
  PassingLine(const ObjectRay& near, const ExactRay* ray, double origin_error,
              double direction_error);

  /// Returns the side of one edge, which is never 0.
  int exact_side(const Vec3& from, const Vec3& to);

  const ObjectRay& near_;
  const ExactRay* ray_;
  Vec3 direction_;  ///< the largest component is in [1, 2)
  double origin_error_;
  double direction_error_;  ///< of direction_
  std::optional<ExactLine> exact_;
};

}  // namespace crt::core
