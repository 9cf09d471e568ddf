// Torus: all points within `thickness` of the circle of the given `radius` about `center` across
// `axis`.
//
// With rho the distance from the axis and z the height along it, R the radius and r the thickness,
// a point is inside if G = (rho - R)^2 + z^2 - r^2 < 0. The usual quartic is G times (rho + R)^2 +
// z^2 - r^2, whose roots are the inner lemon of a spindle torus, which is no boundary. So roots are
// isolated on G itself, evaluated at points near the torus, never by coefficients: along a line its
// second derivative is 2 a - 2 R rho'', and rho'' = D / rho^3 (D constant) has a single bump where
// the line passes the axis. G is therefore convex, concave, convex, between two points known in
// closed form; it has at most one span in each convex part and one rise between them, and a root
// between each two of those. Newton's iteration for a root begins where the parabola that osculates
// G at the span's inner point ends, and ends when a step leaves less of G than its rounding.
//
// A ray that starts on the surface has G(x) = (x - x0) H(x), with H in closed form (a difference of
// squares and of distances), so its own root is gone by algebra.
//
// Face 0 is all of it. u is the angle about the axis from +z (as frame_about() has it), v the angle
// about the ring from its outermost circle towards the axis; both in [0, 1].
// Tests: tests/geometry/torus_test.cpp
#pragma once

#include "core/geometry/angles.hpp"
#include "core/geometry/near_line.hpp"
#include "core/geometry/shape.hpp"
#include "core/geometry/torus/line.hpp"

namespace crt::core {

/// Where a line, or as many as a Real has lanes, first enters a torus.
template <class Real>
struct TorusEntry {
  using Mask = decltype(Real{} < Real{});

  Mask found{};  ///< it is in the torus somewhere
  Mask known{};  ///< where it enters first is told here; else t and error mean nothing
  Real t{};
  Real error{};  ///< as in Crossing
};

class TorusShape final : public ShapeOfPoints<TorusShape> {
 public:
  explicit TorusShape(const Torus& torus);

  bool is_solid() const override { return true; }
  TypedShape typed() const override { return this; }
  bool is_convex() const override { return false; }
  Bounds bounds() const override;
  bool crossings(const ObjectRay& ray, CrossingList& out) const override;
  /// The first crossing of rays that do not start on the surface, where it is told without the
  /// others; of wanted rays, which are each an ObjectRay or as many side by side.
  template <class Real, class Ray>
  TorusEntry<Real> first_entry(const Ray& ray, const typename TorusEntry<Real>::Mask& wanted) const;
  /// Which of wanted rays, which start on the surface and outwards, may cross it again at t > 0.
  template <class Real, class Ray>
  typename TorusEntry<Real>::Mask comes_back(const Ray& ray,
                                             const typename TorusEntry<Real>::Mask& wanted) const;
  Vec3 anchor(std::uint32_t) const override { return center_; }
  template <class Real>
  void write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>& direction, std::uint32_t face,
                   bool with_uv, SurfacePointOf<Real>& point) const;
  std::uint32_t face_count() const override { return 1; }
  Surface surface(std::uint32_t face) const override;
  std::size_t bytes() const override { return sizeof *this; }

 private:
  /// The same of a ray seen from the torus.
  template <class Real>
  TorusEntry<Real> first_entry(const NearLineOf<Real>& line, const TorusLineOf<Real>& torus,
                               const typename TorusEntry<Real>::Mask& wanted) const;
  template <class Real>
  TorusLineOf<Real> in_frame(const NearLineOf<Real>& line, bool on_surface) const;
  /// A vector in the torus's frame: z is along the axis.
  template <class Vector>
  Vector in_frame(const Vector& v) const;

  /// What the error of a crossing depends on, as standard_error() takes it.
  template <class Real>
  struct Meeting {
    Real reach;
    Real approach;
    Real longest;
  };
  /// At x, next to a span inside the torus of that length.
  template <class Real>
  Meeting<Real> meeting(const NearLineOf<Real>& line, const TorusLineOf<Real>& torus, const Real& x,
                        const Real& length) const;

  /// Seen from the point of the ring that is nearest to a place.
  template <class Real>
  struct TubePlace {
    Vec3Of<Real> radial;  ///< from the axis to that point, of length 1
    Real outward;         ///< the place, along `radial`
    Real height;          ///< and along the axis

    TubePlace(const TorusShape& torus, const Vec3Of<Real>& offset);
  };

  Vec3 center_;
  AxisFrame frame_;
  double radius_;
  double thickness_;
  double unit_;  ///< a power of two near radius + thickness
  double ring_;  ///< R in units
  double tube_;  ///< r in units
};

void validate(const Torus& torus);
inline bool is_solid(const Torus&) {
  return true;
}
std::unique_ptr<const Shape> make_shape(const Torus& torus);
std::unique_ptr<const ExactShape> make_exact_shape(const Torus& torus);

}  // namespace crt::core
