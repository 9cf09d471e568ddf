// Cylinders and cones are round solids about an axis. Their radius changes at a constant rate, and
// two flat caps cut them off.
//
// Notation. The frame's origin is the centre of the *narrower* end, and w points to the wider one.
// So the radius r + z tan(alpha) at height z is a sum of what is not negative: nothing cancels, and
// an apex is exactly at z = 0. P and M are the cross products of the line's point and direction
// with w, times cos(alpha). The radius along the line, again times cos(alpha), is s0 + s1 x =
// cos(alpha) r + sin(alpha) z. Then the side is
//    |P + M x|^2 = (s0 + s1 x)^2   on the nappe s0 + s1 x >= 0,
// which is a x^2 + 2 b x + c = 0 with a = (|M| - |s1|)(|M| + |s1|), b = P . M - s0 s1 and
// c = (|P| - s0)(|P| + s0). Cross products keep |M| accurate to a rounding at any angle to the
// axis, where 1 - (w . d)^2 would have no digit left.
//
// Roundings. The left side minus the right one is (radial + radius) g, with g the distance from the
// side. P, M, s0 and s1 are off by some u of |p| and |d|. So the coefficients are off by some u
// times |P|^2 + s0^2, |P||M| + |s0 s1| and |M|^2 + s1^2. So g at x is off by some u times
//    ((|P| + |M x|)^2 + (|s0| + |s1 x|)^2) / (s0 + s1 x).
// The equation is solved between the caps where |P|^2 + s0^2 is least. There x has the sign of
// P . M + s0 s1, or that is 0, so this is at most 4 u (s0 + s1 x) at a root, times what "some" is.
// So the roots are those of a line that is moved by no more than what the standard tier promises.
// From where the radius is much larger than at the root, as it may be next to an apex, they would
// not be.
//
// The discriminant must be that of these very coefficients, b^2 - a c without another rounding.
// Then what little is left of a, b and c next to a ruling agrees with itself, and roots that leave
// the solid's reach do so on the right side. In exact arithmetic it equals
// |s0 M - s1 P|^2 - |P x M|^2, whose rounding is larger than b^2 next to rulings of cones.
//
// The set of points inside is convex, so a line cuts one span out of it.
#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include "core/geometry/angles.hpp"
#include "core/geometry/clipped_span.hpp"
#include "core/geometry/near_line.hpp"
#include "core/geometry/plane_face.hpp"
#include "core/geometry/shape.hpp"

namespace crt::core {

struct SideStart;

/// A FrustumShape is a cylinder or a cone. Faces: 0 is the side, 1 the cap at `from`, 2 the cap at
/// `to` (there is none at an apex). On the side u is the angle about the axis from -> to, from +z
/// (as frame_about() has it), and v is the height from `from`. On the caps u is the same angle, and
/// v is the distance from the axis. All are in [0, 1].
class FrustumShape : public ShapeOfSpans<FrustumShape> {
 public:
  FrustumShape(const Vec3& from, const Vec3& to, double from_radius, double to_radius);

  bool is_solid() const final { return true; }
  std::unique_ptr<const PlacedSolid> placed(const Placement& placement) const final;
  Bounds bounds() const final;
  std::optional<CoreSegment> core_segment() const final {
    return CoreSegment{from_, to_, radii_[0], radii_[1]};
  }
  bool crossings(const ObjectRay& ray, CrossingList& out) const final;
  template <class Real, class Ray>
  void write_span(const Ray& ray, const WantedEnds<Real>& wanted, ShapeSpan<Real>& span) const;
  /// Finds where a line crosses the whole surface of a cylinder's side, which it is known to do.
  /// Within `span` both crossings are those of crossings(), to the last bit.
  std::array<Crossing, 2> side_crossings(const ObjectRay& ray, ClippedSpan span) const;
  /// Returns the signs for a line that starts on the side.
  SideStart side_start(const ObjectRay& ray, const ClippedSpan& span) const;
  Vec3 anchor(std::uint32_t face) const final {
    return face == side_face ? narrow_ : caps_[face - 1]->position();
  }
  template <class Real>
  void write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>& direction, std::uint32_t face,
                   bool with_uv, SurfacePointOf<Real>& point) const;
  std::uint32_t face_count() const final { return caps_[1] ? 3 : 2; }
  Surface surface(std::uint32_t face) const final;
  SurfacePieces pieces() const final;
  std::unique_ptr<const FaceFunctions> face_functions() const final;
  std::size_t bytes() const override { return sizeof *this; }

  static constexpr std::uint32_t side_face = 0;

 private:
  /// SideRates are what the line's direction alone says of the side.
  template <class Real>
  struct SideRatesOf {
    Vec3Of<Real> m;
    Real m_squared;
    Real radius_rate;  ///< s1
  };
  using SideRates = SideRatesOf<double>;
  /// A side equation is a x^2 + 2 b x + c = 0, and what else is known of the side along a line.
  template <class Real>
  struct SideEquationOf {
    Real a, b, c;
    Real discriminant;
    Real radius, radius_rate;  ///< s0 and s1

    /// Returns whether the line is within the cone at x = 0, on either nappe.
    MaskOf<Real> is_within() const { return c < 0.0; }
    /// Returns whether the roots are on the other nappe, for a >= 0, where both are on one nappe.
    /// If the line is within the cone at x = 0, it is the nappe there, whatever is left of a and b.
    /// Otherwise it is that of the middle between them.
    MaskOf<Real> is_on_other_nappe() const {
      return (is_within() && radius < 0.0) || (a * radius < b * radius_rate && !is_within());
    }
    /// Moves a root that is on this nappe back to the apex, if rounding of a and b put it beyond.
    Real on_nappe(const Real& x) const {
      return select(radius + radius_rate * x < 0.0, -radius / radius_rate, x);
    }
    /// Returns whether a step along the line strays from the tangent by no more than the rounding
    /// of a distance. The step ends where the radius is `radius_there`. The distance's second
    /// derivative is at most |M|^2 / (s0 + s1 x).
    MaskOf<Real> is_straight(const Real& step, const Real& radius_there, const Real& reach) const {
      return step * step * (a + radius_rate * radius_rate) <=
             2 * unit_roundoff * reach * radius_there;
    }
  };
  using SideEquation = SideEquationOf<double>;
  template <class Real>
  SideRatesOf<Real> side_rates(const NearLineOf<Real>& line) const;
  template <class Real>
  SideEquationOf<Real> side_equation(const NearLineOf<Real>& line,
                                     const SideRatesOf<Real>& rates) const;
  /// Returns x of the point where |P|^2 + s0^2 is least. It is not finite if there is none.
  template <class Real>
  Real where_least(const NearLineOf<Real>& line, const SideRatesOf<Real>& rates) const;
  static double approach(const SideEquation& side, double x);
  /// Returns whether the line does not graze the side.
  template <class Real>
  static MaskOf<Real> passes_plainly(const NearLineOf<Real>& line,
                                     const SideEquationOf<Real>& side);
  struct Root {
    double x = 0;
    bool entering = false;
    std::uint8_t number = 0;
  };
  /// Returns the distance of a point in units, relative to the narrow end.
  template <class Vector>
  RealOf<Vector> distance_from_side(const Vector& p) const;
  Crossing polished(const ObjectRay& ray, const NearLine& line, const SideEquation& side,
                    const Root& root, const ClippedSpan& span) const;
  /// Returns R + |x| of a point in units, relative to the narrow end.
  double reach_of(const Vec3& p) const;
  Crossing side_crossing(const NearLine& line, const SideEquation& side, const Root& root,
                         double reach) const;
  /// SideRoots are both roots of a side equation, by the formulas that add what has one sign (Ray
  /// Tracing Gems ch. 7).
  template <class Real>
  struct SideRoots {
    Real low;
    Real high;

    explicit SideRoots(const SideEquationOf<Real>& side);
  };
  bool move_to_least(const ObjectRay& ray, NearLine& line, const SideRates& rates,
                     const ClippedSpan& span) const;
  void center_on_grazing(const ObjectRay& ray, NearLine& line, const SideRates& rates,
                         SideEquation& side) const;
  void clip_side(const ObjectRay& ray, NearLine& line, const SideRates& rates,
                 ClippedSpan& span) const;
  Crossing root_next_to_apex(const ObjectRay& ray, bool entering, const ClippedSpan& span) const;
  /// A SidePoint is the point of the side at `offset` from the middle of the narrow end, or next to
  /// it.
  template <class Real>
  struct SidePoint {
    Vec3Of<Real> radial;  ///< from the axis, of length 1
    Real share;           ///< of the height

    /// Writes the position and the normal of `point`, too.
    SidePoint(const FrustumShape& frustum, const Vec3Of<Real>& offset, SurfacePointOf<Real>& point);
  };
  /// Writes the point of a cap at `offset` from its middle, or next to it.
  template <class Real>
  void write_cap_point(const Vec3Of<Real>& offset, std::size_t end, bool with_uv,
                       SurfacePointOf<Real>& point) const;

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

template <class Real>
[[gnu::always_inline]] inline auto FrustumShape::side_rates(const NearLineOf<Real>& line) const
    -> SideRatesOf<Real> {
  const Vec3Of<Real> axis = broadcast<Real>(axis_);
  const Vec3Of<Real> m = broadcast<Real>(cosine_) * accurate_cross(line.direction, axis);
  return {.m = m, .m_squared = dot(m, m), .radius_rate = sine_ * dot(line.direction, axis)};
}

template <class Real>
[[gnu::always_inline]] inline Real FrustumShape::where_least(const NearLineOf<Real>& line,
                                                             const SideRatesOf<Real>& rates) const {
  const Vec3Of<Real> axis = broadcast<Real>(axis_);
  const Real across = cosine_ * dot(accurate_cross(line.point, axis), rates.m);
  const Real s0 = cosine_ * narrow_radius_ + sine_ * dot(line.point, axis);
  const Real s1 = rates.radius_rate;
  return -(across + s0 * s1) / (rates.m_squared + s1 * s1);
}

template <class Real>
auto FrustumShape::side_equation(const NearLineOf<Real>& line, const SideRatesOf<Real>& rates) const
    -> SideEquationOf<Real> {
  const Vec3Of<Real> axis = broadcast<Real>(axis_);
  const Vec3Of<Real> p = broadcast<Real>(cosine_) * accurate_cross(line.point, axis);
  const Real m_length = sqrt(rates.m_squared);
  const Real p_length = sqrt(dot(p, p));
  SideEquationOf<Real> side{};
  side.radius = cosine_ * narrow_radius_ + sine_ * dot(line.point, axis);
  side.radius_rate = rates.radius_rate;
  const Real s0 = side.radius;
  const Real s1 = side.radius_rate;
  side.a = (m_length - abs(s1)) * (m_length + abs(s1));
  side.b = dot(p, rates.m) - s0 * s1;
  side.c = (p_length - abs(s0)) * (p_length + abs(s0));
  side.discriminant = difference_of_products(side.b, side.b, side.a, side.c);
  return side;
}

template <class Real>
MaskOf<Real> FrustumShape::passes_plainly(const NearLineOf<Real>& line,
                                          const SideEquationOf<Real>& side) {
  constexpr double nearly = 0x1p-20;
  const Real radius = side.radius + side.radius_rate * (-side.b / side.a);
  return abs(side.discriminant) > nearly * nearly * line.squared_length * radius * radius;
}

template <class Real>
FrustumShape::SideRoots<Real>::SideRoots(const SideEquationOf<Real>& side) {
  const Real half = sqrt(max(side.discriminant, Real{}));
  const Real sum = select(side.b >= 0.0, -(side.b + half), half - side.b);
  const Real first = sum / side.a;
  // A line that touches the side, or passes it by less than rounding, has both roots in one place.
  const Real second = select(side.discriminant > 0.0, side.c / sum, first);
  low = min(first, second);
  high = max(first, second);
}

template <class Vector>
RealOf<Vector> FrustumShape::distance_from_side(const Vector& p) const {
  using Real = RealOf<Vector>;
  const Vector axis = broadcast<Real>(axis_);
  const Vector across = accurate_cross(p, axis);
  return cosine_ * (sqrt(dot(across, across)) - narrow_radius_) -
         sine_ * accurate_dot(p, axis).value();
}

// Cylinders and cones are instantiated where the definition is not visible.
extern template class ShapeOfPoints<FrustumShape>;
extern template class ShapeOfSpans<FrustumShape>;

}  // namespace crt::core
