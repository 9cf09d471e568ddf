// A revolution has all points that a profile passes as it turns about the y axis.
//
// x of the profile is the distance from the axis and y the height. A straight piece makes a part of
// a plane, a cylinder or a cone, and an arc a part of a sphere or of a torus. Where the center of
// the arc is beyond the axis, that is the inner lemon of a spindle torus. Which of these a line
// crosses, and where, is in turned_walls.hpp.
//
// Faces: 0 is the end at which the turn begins, and 1 that at which it ends. Wall i of the profile
// (Profile::Wall) has the faces 2 + 2 i and 3 + 2 i (profile/wall_faces.hpp), as the even-odd rule
// may have the inside to either side of it.
// Tests: tests/geometry/revolution_test.cpp
#pragma once

#include <memory>
#include <vector>

#include "core/geometry/revolution/turned_walls.hpp"

namespace crt::core {

class RevolutionShape final : public Shape {
 public:
  explicit RevolutionShape(const Revolution& revolution);

  bool is_solid() const override { return true; }
  bool is_convex() const override { return false; }
  Bounds bounds() const override { return bounds_; }
  bool crossings(const ObjectRay& ray, CrossingList& out) const override;
  Vec3 anchor(std::uint32_t face) const override { return body(face).anchor(0); }
  SurfacePoint point_on(const Vec3& offset, const Vec3& direction, std::uint32_t face,
                        bool with_uv) const override;
  void points_on(const VectorLanes& offsets, const VectorLanes& directions, std::uint32_t some,
                 std::uint32_t face, bool with_uv, SurfacePointLanes& points) const override;
  std::uint32_t face_count() const override {
    return end_count + 2 * turned_.profile->wall_count();
  }
  Surface surface(std::uint32_t face) const override;
  std::unique_ptr<const FaceFunctions> face_functions() const override;
  /// Returns only its own bytes and those of the profile, which others may share.
  std::size_t bytes() const override;

 private:
  const Shape& body(std::uint32_t face) const { return *bodies_[body_of_face(face)]; }
  template <class Real>
  void finish_point(std::uint32_t face, bool with_uv, SurfacePointOf<Real>& point) const;

  TurnedProfile turned_;
  double turns_;  ///< the angle as a share of a whole turn
  Bounds bounds_;
  std::vector<std::unique_ptr<const Shape>> bodies_;
};

void validate(const Revolution& revolution);
inline bool is_solid(const Revolution&) {
  return true;
}
std::unique_ptr<const Shape> make_shape(const Revolution& revolution);
std::unique_ptr<const ExactShape> make_exact_shape(const Revolution& revolution);

}  // namespace crt::core
