// A half plane is the surface of all points p with normal . (p - position) = 0 and direction' . (p
// - position) >= 0, where direction' is the component of the direction across the normal.
//
// Face 0 is all of it. u is the distance from the edge along direction', and v is the distance from
// the position along normal x direction'. Both are in scene units.
// Tests: tests/geometry/half_plane_test.cpp
#pragma once

#include "core/geometry/plane_face.hpp"
#include "core/geometry/shape.hpp"

namespace crt::core {

class HalfPlaneShape final : public ShapeOfPoints<HalfPlaneShape> {
 public:
  explicit HalfPlaneShape(const HalfPlane& half_plane);

  bool is_solid() const override { return false; }
  Bounds bounds() const override;
  bool crossings(const ObjectRay& ray, CrossingList& out) const override;
  Vec3 anchor(std::uint32_t) const override { return face_.position(); }
  template <class Real>
  void write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>& direction, std::uint32_t face,
                   bool with_uv, SurfacePointOf<Real>& point) const;
  std::uint32_t face_count() const override { return 1; }
  Surface surface(std::uint32_t) const override { return face_.surface(); }
  std::size_t bytes() const override { return sizeof *this; }

 private:
  PlaneFace face_;
  Vec3 inward_;  ///< unit vector in the plane, across the edge
};

void validate(const HalfPlane& half_plane);
inline bool is_solid(const HalfPlane&) {
  return false;
}
std::unique_ptr<const Shape> make_shape(const HalfPlane& half_plane);
std::unique_ptr<const ExactShape> make_exact_shape(const HalfPlane& half_plane);

}  // namespace crt::core
