// A capsule has all points within `radius` of the straight line between `from` and `to`. It is the
// union of the spheres about these two points and of the cylinder between them.
//
// Each of the three is asked for its span on the line, by the equations of sphere.hpp and
// frustum.hpp. The capsule is convex, so its own span is that from the first entry to the last
// exit. Source: Roth, Ray casting for modeling solids, Computer Graphics and Image Processing 18,
// 1982.
//
// Faces: 0 is the side, 1 the half sphere at `from`, 2 the half sphere at `to`. They meet in two
// circles, the seams, where they have one tangent plane. A crossing on a seam is one of the side if
// the line passes on between the seams, and of the half sphere otherwise.
//
// Roundings. If the line passes the cylinder's cap, its crossing is on the half sphere behind that
// cap. Next to a seam rounding may say that the sphere is met only after the cap, or not at all.
// Then the line crosses the cap within rounding of its rim, which is on both surfaces, and the
// crossing is there. So none is lost, and none counts twice.
//
// The first entry is also the safe one. Too early, it is off the surface by no more than a
// rounding. Too late, it might be far too late, where the line passes along the side just inside.
//
// u is the angle about the axis from -> to, from +z (as frame_about() has it). v is the length of
// the way along the surface, from the tip beyond `from` to the tip beyond `to`. Both are in [0, 1].
// Tests: tests/geometry/capsule_test.cpp, tests/geometry/exact_capsule_test.cpp
#pragma once

#include <array>

#include "core/geometry/angles.hpp"
#include "core/geometry/capsule/span.hpp"
#include "core/geometry/cylinder/cylinder.hpp"
#include "core/geometry/shape.hpp"
#include "core/geometry/sphere/sphere.hpp"

namespace crt::core {

class CapsuleShape final : public Shape {
 public:
  explicit CapsuleShape(const Capsule& capsule);

  bool is_solid() const override { return true; }
  Bounds bounds() const override;
  std::optional<CoreSegment> core_segment() const override;
  bool crossings(const ObjectRay& ray, CrossingList& out) const override;
  Vec3 anchor(std::uint32_t face) const override { return part(face).anchor(0); }
  SurfacePoint point_on(const Vec3& offset, const Vec3& direction, std::uint32_t face,
                        bool with_uv) const override;
  void points_on(const VectorLanes& offsets, const VectorLanes& directions, std::uint32_t some,
                 std::uint32_t face, bool with_uv, SurfacePointLanes& points) const override;
  std::uint32_t face_count() const override { return 3; }
  Surface surface(std::uint32_t face) const override { return part(face).surface(0); }
  std::unique_ptr<const FaceFunctions> face_functions() const override;
  std::size_t bytes() const override { return sizeof *this; }

  static constexpr std::uint32_t side_face = 0;

 private:
  /// Returns the part whose surface a face is a piece of.
  const Shape& part(std::uint32_t face) const {
    if (face == side_face) return cylinder_;
    return spheres_[face - 1];
  }
  CapsuleSpan span_of(std::uint32_t part, const ObjectRay& ray, CrossingList& out) const;
  void bound_at_seam(const ObjectRay& ray, const Crossing& of_cylinder, Crossing& end) const;
  double seam_error(const ObjectRay& ray, const Crossing& crossing) const;
  /// Sets u and v from those of the part.
  template <class Real>
  void set_uv(std::uint32_t face, SurfacePointOf<Real>& point) const;

  CylinderShape cylinder_;
  std::array<SphereShape, 2> spheres_;  ///< about from and to
  std::array<Vec3, 2> centers_;
  double radius_;
  AxisFrame frame_;   ///< about from -> to
  double unit_;       ///< a power of two near the radius
  double height_;     ///< from `from` to `to`, in units
  double tip_share_;  ///< of v, on each half sphere
};

inline bool is_solid(const Capsule&) {
  return true;
}
std::unique_ptr<const Shape> make_shape(const Capsule& capsule);
std::unique_ptr<const ExactShape> make_exact_shape(const Capsule& capsule);

}  // namespace crt::core
