// A torus has all points within `thickness` of the circle of the given `radius` about `center`
// across `axis`.
//
// Let rho be the distance from the axis and z the height along it, R the radius and r the
// thickness. A point is inside if G = (rho - R)^2 + z^2 - r^2 < 0. The usual quartic is G times
// (rho + R)^2 + z^2 - r^2, whose roots are the inner lemon of a spindle torus, which is no
// boundary. So roots are isolated on G itself, evaluated at points near the torus, and never by
// coefficients.
//
// Along a line the second derivative of G is 2 a - 2 R rho'', and rho'' = D / rho^3 (D is constant)
// has a single maximum where the line passes the axis. So G is convex, concave and convex, between
// two points known in closed form. It has at most one interval below 0 in each convex part, and at
// most one above 0 between them, with a root between neighbours. Newton's iteration for a root
// begins where the parabola is 0 that osculates G at the interval's inner point. It ends when a
// step leaves less of G than its rounding.
//
// The inner lemon itself has the same G with R < 0: it is what a part of a circle makes whose
// center is beyond the axis, as it turns (revolution/). Such a G is convex along every line.
//
// A ray that starts on the surface has G(x) = (x - x0) H(x), with H in closed form (a difference of
// squares and of distances). So its own root is removed by algebra.
//
// Face 0 is all of it. u is the angle about the axis from +z (as frame_about() has it), and v is
// the angle about the ring from its outermost circle towards the axis. Both are in [0, 1].
// Tests: tests/geometry/torus_test.cpp
#pragma once

#include "core/geometry/angles.hpp"
#include "core/geometry/near_line.hpp"
#include "core/geometry/shape.hpp"
#include "core/geometry/torus/enclose.hpp"
#include "core/geometry/torus/line.hpp"

namespace crt::core {

/// A TorusEntry is where a line, or as many as a Real has lanes, first enters a torus.
template <class Real>
struct TorusEntry {
  using Mask = decltype(Real{} < Real{});

  Mask found{};  ///< the line is in the torus somewhere
  Mask known{};  ///< t and error are those of the first entry; if not, they mean nothing
  Real t{};
  Real error{};  ///< as in Crossing
};

class TorusShape final : public ShapeOfSpans<TorusShape> {
 public:
  explicit TorusShape(const Torus& torus);

  bool is_solid() const override { return true; }
  bool is_convex() const override { return false; }
  Bounds bounds() const override;
  std::unique_ptr<const PlacedSolid> placed(const Placement& placement) const override {
    return place(EnclosedTorus{center_, frame_.along, radius_, thickness_}, placement);
  }
  bool crossings(const ObjectRay& ray, CrossingList& out) const override;
  template <class Real, class Ray>
  void write_span(const Ray& ray, const WantedEnds<Real>& wanted, ShapeSpan<Real>& span) const;
  bool leaves_for_good(const ObjectRay& ray, bool wanted) const override;
  LaneMask leaves_for_good(const ObjectRayLanes& rays, const LaneMask& wanted) const override;
  Vec3 anchor(std::uint32_t) const override { return center_; }
  template <class Real>
  void write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>& direction, std::uint32_t face,
                   bool with_uv, SurfacePointOf<Real>& point) const;
  std::uint32_t face_count() const override { return 1; }
  Surface surface(std::uint32_t face) const override;
  std::unique_ptr<const FaceFunctions> face_functions() const override;
  std::size_t bytes() const override { return sizeof *this; }

 private:
  /// Finds the first crossing of a ray in the torus's frame.
  template <class Real>
  TorusEntry<Real> first_entry(const NearLineOf<Real>& line, const TorusLineOf<Real>& torus,
                               const typename TorusEntry<Real>::Mask& wanted) const;
  template <class Real>
  TorusLineOf<Real> in_frame(const NearLineOf<Real>& line, bool on_surface) const;
  /// Returns a vector in the torus's frame: z is along the axis.
  template <class Vector>
  Vector in_frame(const Vector& v) const;

  /// A Meeting is what the error of a crossing depends on, as standard_error() takes it.
  template <class Real>
  struct Meeting {
    Real reach;
    Real approach;
    Real longest;
  };
  /// Returns the meeting at x, next to a span of that length inside the torus.
  template <class Real>
  Meeting<Real> meeting(const NearLineOf<Real>& line, const TorusLineOf<Real>& torus, const Real& x,
                        const Real& length) const;

  /// A TubePlace is a place relative to the nearest point of the ring.
  template <class Real>
  struct TubePlace {
    Vec3Of<Real> radial;  ///< from the axis to the ring, of length 1
    Real outward;         ///< the place's offset along `radial`
    Real height;          ///< the place's offset along the axis

    TubePlace(const TorusShape& torus, const Vec3Of<Real>& offset);
  };

  Vec3 center_;
  AxisFrame frame_;
  double radius_;
  double thickness_;
  double unit_;  ///< a power of two near |radius| + thickness
  double ring_;  ///< R in units
  double tube_;  ///< r in units
};

inline bool is_solid(const Torus&) {
  return true;
}
std::unique_ptr<const Shape> make_shape(const Torus& torus);
std::unique_ptr<const ExactShape> make_exact_shape(const Torus& torus);

}  // namespace crt::core
