// What cylinders and cones have in common: a round solid about an axis whose radius changes at a
// constant rate, cut off by two flat caps.
//
// Notation. The frame's origin is the centre of the *narrower* end and w points to the wider one, so
// that the radius r + z tan(alpha) at height z is a sum of what is not negative: nothing cancels, and
// an apex is exactly at z = 0. With P and M the cross products of the line's point and direction with
// w, times cos(alpha), and s0 + s1 x = cos(alpha) r + sin(alpha) z the radius along the line, again
// times cos(alpha), the side is
//     |P + M x|^2 = (s0 + s1 x)^2   on the nappe s0 + s1 x >= 0,
// a x^2 + 2 b x + c = 0 with a = (|M| - |s1|)(|M| + |s1|), b = P . M - s0 s1, c = (|P| - s0)(|P| + s0).
// Its discriminant b^2 - a c is |s0 M - s1 P|^2 - |P x M|^2: the cross product form, which does not
// cancel for lines that are nearly parallel to the axis. Cross products keep |M| good to a rounding at
// any angle to the axis, where 1 - (w . d)^2 would have no digit left.
// The set of points inside is convex, so a line cuts one stretch out of it.
#pragma once

#include <algorithm>
#include <optional>

#include "core/geometry/angles.hpp"
#include "core/geometry/near_line.hpp"
#include "core/geometry/plane_face.hpp"
#include "core/geometry/shape.hpp"
#include "core/geometry/stretch.hpp"

namespace crt::core {

/// Faces: 0 is the side, 1 the cap at `from`, 2 the cap at `to` (there is none at an apex). On the side
/// u is the angle about the axis from -> to, from +z (as frame_about() has it), and v the height from
/// `from`; on the caps u is the same angle and v the distance from the axis; all in [0, 1].
class FrustumShape : public ShapeOfPoints<FrustumShape> {
 public:
  FrustumShape(const Vec3& from, const Vec3& to, double from_radius, double to_radius);

  bool is_solid() const final { return true; }
  Bounds bounds() const final;
  std::optional<Spine> spine() const final { return Spine{from_, to_, radii_[0], radii_[1]}; }
  bool crossings(const ObjectRay& ray, CrossingList& out) const final;
  Vec3 anchor(std::uint32_t face) const final {
    return face == side_face ? narrow_ : caps_[face - 1]->position();
  }
  template <class Real>
  SurfacePointOf<Real> point_near(const Vec3Of<Real>& offset, const Vec3Of<Real>& direction,
                                  std::uint32_t face, bool with_uv) const;
  std::uint32_t face_count() const final { return caps_[1] ? 3 : 2; }
  Surface surface(std::uint32_t face) const final;
  std::size_t bytes() const override { return sizeof *this; }

  static constexpr std::uint32_t side_face = 0;

 private:
  /// a x^2 + 2 b x + c = 0, and what else is known of the side along a line.
  struct SideEquation {
    double a, b, c;
    double discriminant;
    double radius, radius_rate;  ///< s0 and s1
  };
  SideEquation side_equation(const NearLine& line) const;
  static double approach(const SideEquation& side, double x);
  struct Root {
    double x;
    bool entering;
    std::uint8_t number;
  };
  /// Of a point in units, relative to the narrow end.
  double distance_from_side(const Vec3& p) const;
  Crossing polished(const ObjectRay& ray, const NearLine& line, const SideEquation& side,
                    const Root& root) const;
  Crossing side_crossing(const NearLine& line, const SideEquation& side, double x, std::uint8_t root) const;
  void center_on_grazing(const ObjectRay& ray, NearLine& line, SideEquation& side) const;
  void clip_side(const ObjectRay& ray, NearLine& line, Stretch& stretch) const;
  void clip_side_from_surface(const ObjectRay& ray, Stretch& stretch) const;
  /// What is on the side at `offset` from the middle of the narrow end, or next to it.
  template <class Real>
  struct SidePoint {
    Vec3Of<Real> radial;  ///< from the axis, of length 1
    Real share;           ///< of the height
    SurfacePointOf<Real> point;

    SidePoint(const FrustumShape& frustum, const Vec3Of<Real>& offset);
  };
  /// What is on a cap at `offset` from its middle, or next to it.
  template <class Real>
  SurfacePointOf<Real> cap_point(const Vec3Of<Real>& offset, std::size_t end, bool with_uv) const;

  Vec3 from_;
  Vec3 to_;
  std::array<double, 2> radii_;                   ///< at from and to
  std::array<std::optional<PlaneFace>, 2> caps_;  ///< at from and to
  AxisFrame frame_;                               ///< about from -> to
  Vec3 narrow_;                                   ///< the frame's origin
  Vec3 axis_;                                     ///< w
  double unit_;                                   ///< a power of two near the larger radius
  double height_;                                 ///< in units, as are the next two
  double narrow_radius_;
  double wide_radius_;
  double cosine_ = 1;
  double sine_ = 0;
};
// Cylinders and cones are made where the formula is not to be seen.
extern template class ShapeOfPoints<FrustumShape>;

}  // namespace crt::core
