// An extrusion has all points whose x and y are in a profile and whose z is between two heights.
//
// Which walls a line crosses is decided exactly in both tiers (profile/plane_line.hpp), so that the
// crossings are always even in number. Where it crosses them is as for a box and a cylinder: a
// straight wall is a plane, and an arc is the side of a cylinder between the two heights. The walls
// cut the line into parts in the profile, of which the ends leave what is between them. Source: the
// idea of mesh/passing_line.hpp, one dimension less.
//
// Faces: 0 is the lower end, 1 the upper. Wall i of the profile (Profile::Wall) has the faces
// 2 + 2 i and 3 + 2 i (crossed_walls.hpp), as the even-odd rule may have the inside to either side
// of it.
// Tests: tests/geometry/extrusion_test.cpp
#pragma once

#include <memory>
#include <vector>

#include "core/geometry/cylinder/cylinder.hpp"
#include "core/geometry/extrusion/crossed_walls.hpp"
#include "core/geometry/plane_face.hpp"

namespace crt::core {

class ExtrusionShape final : public ShapeOfPoints<ExtrusionShape> {
 public:
  explicit ExtrusionShape(const Extrusion& extrusion);

  bool is_solid() const override { return true; }
  bool is_convex() const override { return false; }
  Bounds bounds() const override { return bounds_; }
  bool crossings(const ObjectRay& ray, CrossingList& out) const override;
  Vec3 anchor(std::uint32_t face) const override;
  template <class Real>
  void write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>& direction, std::uint32_t face,
                   bool with_uv, SurfacePointOf<Real>& point) const;
  std::uint32_t face_count() const override {
    return end_count + 2 * static_cast<std::uint32_t>(profile_->wall_count());
  }
  Surface surface(std::uint32_t face) const override;
  std::unique_ptr<const FaceFunctions> face_functions() const override;
  /// Returns only its own bytes and those of the profile, which others may share.
  std::size_t bytes() const override;

  const PlaneFace& end(std::uint32_t number) const { return ends_[number]; }
  /// Returns the plane of a piece that is the first in it.
  const PlaneFace& plane(std::uint32_t piece) const { return planes_[piece]; }
  /// Returns the cylinder of an arc that is the first on its circle.
  const CylinderShape& cylinder(std::uint32_t arc) const { return *cylinders_[arc]; }

 private:
  Bounds box_of(std::uint32_t number) const;
  template <class Real>
  void write_end_point(const Vec3Of<Real>& offset, std::uint32_t end, bool with_uv,
                       SurfacePointOf<Real>& point) const;
  template <class Real>
  void write_flat_point(const Vec3Of<Real>& offset, std::uint32_t number, bool with_uv,
                        SurfacePointOf<Real>& point) const;
  template <class Real>
  void write_round_point(const Vec3Of<Real>& offset, const Vec3Of<Real>& direction,
                         std::uint32_t number, bool with_uv, SurfacePointOf<Real>& point) const;

  std::shared_ptr<const Profile> profile_;
  Bounds bounds_;
  std::array<PlaneFace, 2> ends_;
  std::vector<PlaneFace> planes_;                          ///< by piece
  std::vector<std::unique_ptr<CylinderShape>> cylinders_;  ///< by arc, for first arcs
  double shortest_;
};

void validate(const Extrusion& extrusion);
inline bool is_solid(const Extrusion&) {
  return true;
}
std::unique_ptr<const Shape> make_shape(const Extrusion& extrusion);
std::unique_ptr<const ExactShape> make_exact_shape(const Extrusion& extrusion);

}  // namespace crt::core
