// A disc is the surface of all points p with normal . (p - center) = 0 and |p - center| <= radius.
//
// Face 0 is all of it. u is the angle about the normal from +z (as frame_about() has it), and v is
// the distance from the centre. Both are in [0, 1].
// Tests: tests/geometry/disc_test.cpp
#pragma once

#include "core/geometry/angles.hpp"
#include "core/geometry/plane_face.hpp"
#include "core/geometry/shape.hpp"

namespace crt::core {

class DiscShape final : public ShapeOfPoints<DiscShape> {
 public:
  explicit DiscShape(const Disc& disc);

  bool is_solid() const override { return false; }
  Bounds bounds() const override;
  bool crossings(const ObjectRay& ray, CrossingList& out) const override;
  Vec3 anchor(std::uint32_t) const override { return face_.position(); }
  template <class Real>
  void write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>& direction, std::uint32_t face,
                   bool with_uv, SurfacePointOf<Real>& point) const;
  std::uint32_t face_count() const override { return 1; }
  Surface surface(std::uint32_t) const override { return face_.surface(); }
  SurfacePieces pieces() const override;
  std::size_t bytes() const override { return sizeof *this; }

 private:
  PlaneFace face_;
  AxisFrame frame_;
  double radius_;
};

/// Returns how far a disc across `axis` reaches along each coordinate.
Vec3 disc_extents(const Vec3& axis, double radius);

inline bool is_solid(const Disc&) {
  return false;
}
std::unique_ptr<const Shape> make_shape(const Disc& disc);
std::unique_ptr<const ExactShape> make_exact_shape(const Disc& disc);

}  // namespace crt::core
