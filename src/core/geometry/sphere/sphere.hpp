// A sphere has all points p with |p - center| <= radius.
//
// It is solved relative to the closest approach, with the discriminant r^2 - l^2 (l is the distance
// of line and centre) factored as (r + l)(r - l).
// Source: Haines, Guenther, Akenine-Moeller, Precision improvements for ray/sphere intersection,
// Ray Tracing Gems ch. 7, 2019.
//
// Face 0 is all of it. u is the longitude about y, 0 at +z and growing towards +x. v is the
// latitude, 0 at the lowest point and 1 at the highest. Both are in [0, 1].
// Tests: tests/geometry/sphere_test.cpp
#pragma once

#include <array>

#include "core/geometry/near_line.hpp"
#include "core/geometry/shape.hpp"
#include "core/geometry/sphere/enclose.hpp"
#include "core/ray/plain_ray.hpp"

namespace crt::core {

/// A SphereChord is where a line, or as many as a Real has lanes, enters and leaves a sphere.
template <class Real>
struct SphereChord {
  decltype(Real{} < Real{}) found{};  ///< if not, the ends mean nothing
  Real enter{};                       ///< t there
  Real leave{};
  Real error{};  ///< of both ends, without the rounding of each

  /// Returns the error of one end, as in Crossing.
  Real error_of(const Real& end) const { return rounding_of(end) + error; }

  /// Finds the chord of a line that does not start on the surface. `unit` is the sphere's (see
  /// below). All numbers of the sphere may differ by lane.
  template <class Ray, class Center, class Size>
  static SphereChord of(const Ray& ray, const Center& center, const Size& radius,
                        const Size& unit) {
    Real closest;
    const auto line = NearLineOf<Real>::at_closest(ray, center, unit, closest);
    return on(line, closest, radius * inverse_of_power(unit));
  }
  /// Finds the chord from the line near the sphere, its closest() and the radius in its units.
  template <class Size>
  static SphereChord on(const NearLineOf<Real>& line, const Real& closest, const Size& r);
};

template <class Real>
template <class Size>
SphereChord<Real> SphereChord<Real>::on(const NearLineOf<Real>& line, const Real& closest,
                                        const Size& r) {
  const Real a = line.squared_length;
  const Vec3Of<Real> nearest = line.at(closest);
  const Real distance = sqrt(dot(nearest, nearest));
  const auto meets = distance < r;
  if (!any(meets)) return {};

  const Real squared_root = a * (r + distance) * (r - distance);
  const Real root = sqrt(squared_root);
  const Real half_chord = root / a;
  const Real enter = line.to_t(closest - half_chord);
  const Real leave = line.to_t(closest + half_chord);
  // This is standard_error() for |n . d| = root / r. Almost no ray comes near the grazing error.
  const Size reach = 2.0 * r;
  const Size across = standard_error_across(reach) * r;
  Real along = across / root;
  constexpr double flattest = 0x1p-40;
  if (any(meets && squared_root <= flattest * r * r * a)) {
    const Real longest = grazing_error(line, reach, r);
    along = select(across < longest * root, along, longest);
  }
  return {meets && enter < leave, enter, leave, line.to_t_length(along)};
}

/// A SphereOtherEnd is where lines that start on the surface are on it once more.
template <class Real>
struct SphereOtherEnd {
  Real t{};
  Real error{};         ///< as in Crossing
  Real least_length{};  ///< the rounding of a path of length 0

  template <class Ray>
  static SphereOtherEnd of(const Ray& ray, const Vec3& center, double radius, double unit);
};

/// One root of a x^2 + 2 b x + c is 0 by identity, so c is 0 whatever rounding made of the origin,
/// and the other root is -2 b / a.
template <class Real>
template <class Ray>
SphereOtherEnd<Real> SphereOtherEnd<Real>::of(const Ray& ray, const Vec3& center, double radius,
                                              double unit) {
  const auto line = NearLineOf<Real>::at_origin(ray, center, unit);
  const double r = radius / unit;
  const double reach = 2 * r;
  const Real a = line.squared_length;
  const Real b = dot(line.point, line.direction);
  const Real distance = sqrt(dot(line.point, line.point));
  const Real off_surface = abs((distance + r) * (distance - r));
  SphereOtherEnd end;
  end.t = line.to_t(-2.0 * b / a);
  end.error = standard_error(line, end.t, reach, abs(b) / r, grazing_error(line, reach, r)) +
              line.to_t_length(start_error(off_surface, a, b));
  end.least_length = line.to_t_length(broadcast<Real>(unit_roundoff * r));
  return end;
}

class SphereShape final : public ShapeOfSpans<SphereShape> {
 public:
  explicit SphereShape(const Sphere& sphere);

  bool is_solid() const override { return true; }
  std::unique_ptr<const PlacedSolid> placed(const Placement& placement) const override {
    return place(EnclosedSphere{center_, radius_}, placement);
  }
  Bounds bounds() const override;
  std::optional<BoundingSphere> bounding_sphere() const override {
    return BoundingSphere{center_, radius_};
  }
  bool crossings(const ObjectRay& ray, CrossingList& out) const override;
  bool has_quick_spans() const override { return true; }
  template <class Real, class Ray>
  void write_span(const Ray& ray, const WantedEnds<Real>& wanted, ShapeSpan<Real>& span) const;
  void exit_from_surface(const PlainRay<double>& line, SpanEnd<double>& end) const override;
  void exit_from_surface(const RayLanes& lines, SpanEnd<Lanes>& end) const override;
  Vec3 anchor(std::uint32_t) const override { return center_; }
  template <class Real>
  void write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>& direction, std::uint32_t face,
                   bool with_uv, SurfacePointOf<Real>& point) const;
  const void* family() const override;
  void points_on_each(const std::array<const Shape*, lane_count>& spheres, const RayLanes& rays,
                      const Lanes& t, bool with_uv, SurfacePointLanes& points) const override;
  std::uint32_t face_count() const override { return 1; }
  Surface surface(std::uint32_t face) const override;
  SurfacePieces pieces() const override;
  std::unique_ptr<const FaceFunctions> face_functions() const override;
  std::size_t bytes() const override { return sizeof *this; }

 private:
  bool crossings_from_surface(const ObjectRay& ray, CrossingList& out) const;

  Vec3 center_;
  double radius_;
  double unit_;  ///< a power of two near the radius
};

inline bool is_solid(const Sphere&) {
  return true;
}
std::unique_ptr<const Shape> make_shape(const Sphere& sphere);
std::unique_ptr<const ExactShape> make_exact_shape(const Sphere& sphere);

}  // namespace crt::core
