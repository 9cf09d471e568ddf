// A plane is the half-space of all points p with normal . (p - position) <= 0.
//
// Face 0 is all of it. u is the distance from the position along x projected onto the plane (z if
// the normal is mostly along x). v is the distance across u, on the side of growing y (z if the
// normal is mostly along y). Both are in scene units.
// Tests: tests/geometry/plane_test.cpp
#pragma once

#include "core/geometry/plane/enclose.hpp"
#include "core/geometry/plane_face.hpp"
#include "core/geometry/shape.hpp"

namespace crt::core {

class PlaneShape final : public ShapeOfSpans<PlaneShape> {
 public:
  explicit PlaneShape(const Plane& plane);

  bool is_solid() const override { return true; }
  std::unique_ptr<const PlacedSolid> placed(const Placement& placement) const override {
    return place(EnclosedPlane{face_.position(), face_.normal()}, placement);
  }
  Bounds bounds() const override;
  bool crossings(const ObjectRay& ray, CrossingList& out) const override;
  template <class Real, class Ray>
  void write_span(const Ray& ray, const WantedEnds<Real>& wanted, ShapeSpan<Real>& span) const;
  Vec3 anchor(std::uint32_t) const override { return face_.position(); }
  template <class Real>
  void write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>& direction, std::uint32_t face,
                   bool with_uv, SurfacePointOf<Real>& point) const;
  std::uint32_t face_count() const override { return 1; }
  Surface surface(std::uint32_t) const override { return face_.surface(); }
  std::unique_ptr<const FaceFunctions> face_functions() const override;
  std::size_t bytes() const override { return sizeof *this; }

 private:
  PlaneFace face_;
  PlaneAxes axes_;
};

inline bool is_solid(const Plane&) {
  return true;
}
std::unique_ptr<const Shape> make_shape(const Plane& plane);
std::unique_ptr<const ExactShape> make_exact_shape(const Plane& plane);

}  // namespace crt::core
