// Sphere: all points p with |p - center| <= radius.
//
// Solved relative to the closest approach, with the discriminant r^2 - l^2 (l the distance of line
// and centre) factored (r + l)(r - l): Haines, Guenther, Akenine-Moeller, Precision improvements for
// ray/sphere intersection, Ray Tracing Gems ch. 7, 2019.
//
// Face 0 is all of it. u is the longitude about y, 0 at +z and growing towards +x; v the latitude, 0 at the
// lowest point and 1 at the highest; both in [0, 1].
// Tests: tests/geometry/sphere_test.cpp
#pragma once

#include "core/geometry/shape.hpp"

namespace crt::core {

class SphereShape final : public Shape {
 public:
  explicit SphereShape(const Sphere& sphere);

  bool is_solid() const override { return true; }
  Bounds bounds() const override;
  bool crossings(const ObjectRay& ray, CrossingList& out) const override;
  SurfacePoint surface_point(const ObjectRay& ray, const Crossing& crossing, bool with_uv) const override;
  bool surface_points(const RayLanes& rays, const Lanes& t, std::uint32_t face,
                      SurfacePointLanes& points) const override;
  std::uint32_t face_count() const override { return 1; }
  Surface surface(std::uint32_t face) const override;
  std::size_t bytes() const override { return sizeof *this; }

 private:
  bool crossings_from_surface(const ObjectRay& ray, CrossingList& out) const;

  Vec3 center_;
  double radius_;
  double unit_;           ///< a power of two near the radius
  double scaled_radius_;  ///< in units, within [1, 2)
};

void validate(const Sphere& sphere);
inline bool is_solid(const Sphere&) {
  return true;
}
std::unique_ptr<const Shape> make_shape(const Sphere& sphere);

}  // namespace crt::core
