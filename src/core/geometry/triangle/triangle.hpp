// A triangle is the surface between three corners. Its normal is (b - a) x (c - a), component by
// component as usual. Seen from where it points to, a, b, c run clockwise, as the space is
// left-handed.
//
// A line hits it if it passes the three edges on the same side. The side is the sign of a triple
// product, which is found again in double-double where doubles leave it undecided. A line through
// an edge hits, so triangles that share an edge leave no gap.
// Source: Pluecker, as in Shevtsov, Soupikov, Kapustin, Ray-triangle intersection algorithm for
// modern CPU architectures, 2007.
//
// Face 0 is all of it. (u, v) are the weights of b and c.
// Tests: tests/geometry/triangle_test.cpp
#pragma once

#include <array>

#include "core/geometry/plane_face.hpp"
#include "core/geometry/shape.hpp"
#include "core/math/precise_transform.hpp"

namespace crt::core {

class TriangleShape final : public ShapeOfPoints<TriangleShape> {
 public:
  explicit TriangleShape(const Triangle& triangle);

  bool is_solid() const override { return false; }
  Bounds bounds() const override;
  bool crossings(const ObjectRay& ray, CrossingList& out) const override;
  Vec3 anchor(std::uint32_t) const override { return corners_[0]; }
  template <class Real>
  void write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>& direction, std::uint32_t face,
                   bool with_uv, SurfacePointOf<Real>& point) const;
  std::uint32_t face_count() const override { return 1; }
  Surface surface(std::uint32_t) const override { return face_.surface(); }
  SurfacePieces pieces() const override;
  std::size_t bytes() const override { return sizeof *this; }

  /// Finds where a line meets the plane of the triangle.
  PlaneFace::Meeting meet(const ObjectRay& ray) const;

 private:
  bool passes_edges(const ObjectRay& ray) const;

  std::array<Vec3, 3> corners_;
  PreciseVec3 precise_normal_;  ///< the face's, with further digits
  PlaneFace face_;
};

/// Returns (b - a) x (c - a) to about 100 bits of its largest component, up to a power of two. It
/// is 0 only for corners on one line.
PreciseVec3 precise_normal_of(const Triangle& triangle);

/// Writes the weights of b and c at a point of the triangle's plane, which is relative to a. They
/// are at least 0, and their sum is at most 1.
template <class Real>
void write_weights(const Triangle& triangle, const Vec3Of<Real>& relative, Real& u, Real& v);

/// Returns whether the corners are not on one line.
bool has_area(const Triangle& triangle);

/// Returns whether a triangle lies in the plane of another, without rounding.
bool is_in_plane(const Triangle& triangle, const Triangle& of_plane);

void validate(const Triangle& triangle);
inline bool is_solid(const Triangle&) {
  return false;
}
std::unique_ptr<const Shape> make_shape(const Triangle& triangle);
std::unique_ptr<const ExactShape> make_exact_shape(const Triangle& triangle);

}  // namespace crt::core
