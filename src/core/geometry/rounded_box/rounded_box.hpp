// A rounded box has all points p within a radius r of an inner box, which is the box between the
// two corners less r on each side:
//    |q| <= r, where q = p - (the point of the inner box that is nearest to p).
// It has flat faces, quarters of cylinders along the edges and eighths of spheres at the corners.
// Where two of them meet, at a seam, they have one tangent plane.
//
// The square of |q| along a line is convex and piecewise a polynomial. walk.hpp finds the pieces in
// which the line enters and leaves. A flat face is then met as that of a Box is, at the same bits.
// Of a round one the quadratic is solved relative to the closest approach to the edge or the
// corner, as that of a sphere is.
// Source: the distance from a box is that of Quilez, Distance functions, iquilezles.org.
//
// Roundings. Coordinates are relative to the center, so they are off by some u of the box's size,
// wherever it is and however small the radius. A crossing next to a seam may be found in the piece
// beside, which is tangent there. As the walk goes from piece to piece, none is lost between them,
// and none counts twice.
//
// A ray that starts on the surface walks on from there. The surface is taken to be where the start
// is, |q| = |q(0)|. So the root at the start is divided out, and no other piece is met beside it.
//
// Faces: 0 to 5 are the flat ones, numbered as those of a Box. 6 to 9 are the edges along x, 10 to
// 13 along y, 14 to 17 along z. Of four edges the first is at the lower end of both other axes, the
// second at the upper end of the former, the third at the upper end of the latter, the fourth at
// both. 18 to 25 are the corners: 18 at the lower end of all axes, and 1, 2 and 4 more at the upper
// end of x, y and z.
//
// (u, v) are those of a Box: of the point of its face, 0 to 5, that is beside this one. On a round
// face it is the face that the normal is nearest to.
// Tests: tests/geometry/rounded_box_test.cpp, tests/geometry/exact_rounded_box_test.cpp
#pragma once

#include "core/geometry/box/box.hpp"
#include "core/geometry/rounded_box/walk.hpp"
#include "core/geometry/shape.hpp"

namespace crt::core {

class RoundedBoxShape final : public Shape {
 public:
  explicit RoundedBoxShape(const RoundedBox& box);

  bool is_solid() const override { return true; }
  Bounds bounds() const override { return box_.bounds(); }
  std::optional<CoreSegment> core_segment() const override { return box_.core_segment(); }
  bool crossings(const ObjectRay& ray, CrossingList& out) const override;
  Vec3 anchor(std::uint32_t face) const override {
    return face < flat_faces_of_box ? box_.anchor(face) : layout_.center;
  }
  SurfacePoint point_on(const Vec3& offset, const Vec3& direction, std::uint32_t face,
                        bool with_uv) const override;
  void points_on(const VectorLanes& offsets, const VectorLanes& directions, std::uint32_t some,
                 std::uint32_t face, bool with_uv, SurfacePointLanes& points) const override;
  std::uint32_t face_count() const override { return 26; }
  Surface surface(std::uint32_t face) const override;
  std::unique_ptr<const FaceFunctions> face_functions() const override;
  std::size_t bytes() const override { return sizeof *this; }

 private:
  bool crossings_from_face(const ObjectRay& ray, CrossingList& out) const;
  Crossing crossing(const ObjectRay& ray, const NearLine& line, const WalkStep& step,
                    bool entering) const;
  Crossing flat_crossing(const ObjectRay& ray, const NearLine& line, const WalkStep& step,
                         bool entering) const;
  /// Returns where a ray leaves that starts on a face and goes in. It may have been turned round.
  Crossing exit_from_face(const ObjectRay& ray) const;
  /// Writes the point of a round face next to `offset` from the center.
  template <class Real>
  void write_round_point(const Vec3Of<Real>& offset, std::uint32_t face, bool with_uv,
                         SurfacePointOf<Real>& point) const;

  BoxShape box_;
  RoundedBoxLayout layout_;
};

inline bool is_solid(const RoundedBox&) {
  return true;
}
void validate(const RoundedBox& box);
std::unique_ptr<const Shape> make_shape(const RoundedBox& box);
std::unique_ptr<const ExactShape> make_exact_shape(const RoundedBox& box);

/// Returns the box without the rounding.
inline Box box_of(const RoundedBox& box) {
  return {.corner_a = box.corner_a, .corner_b = box.corner_b};
}

/// Returns the largest double that is at most half of the shortest side.
double largest_radius(const RoundedBox& box);

/// Returns the radius that counts: one that is larger by rounding is the largest.
inline double radius_of(const RoundedBox& box) {
  return std::min(box.radius, largest_radius(box));
}

/// Returns whether a ray starts on a face of a rounded box, and not beside it in its plane. A round
/// face is all of its surface.
inline bool starts_on_face(const FaceStart& start) {
  if (start.face == invalid_index) return false;
  return start.on_face || start.face >= flat_faces_of_box;
}

/// Moves a crossing of a ray that starts in the plane of a flat face, at t = 0, to the side of it
/// where the box is.
inline void move_behind_plane(const FaceStart& start, Crossing& crossing) {
  if (start.side == Side::outside ? crossing.t > 0 : crossing.t < 0) {
    crossing.t = 0;
    crossing.t_low = 0;
  }
}

/// Returns a ray turned round.
inline ObjectRay turned_round(const ObjectRay& ray) {
  ObjectRay back = ray;
  back.direction = -ray.direction;
  back.direction_low = -ray.direction_low;
  return back;
}

/// Appends the crossings of a ray that starts on a face. `other` is where it leaves if it goes in,
/// and otherwise where it would leave if it were turned round.
bool append_from_face(const FaceStart& start, Crossing other, double shortest, CrossingList& out);

}  // namespace crt::core
