#include "core/geometry/sphere/sphere.hpp"

#include <numbers>

#include "core/geometry/angles.hpp"
#include "core/geometry/clipped_span.hpp"

#include "core/geometry/sphere/functions.hpp"

namespace crt::core {

SphereShape::SphereShape(const Sphere& sphere)
    : center_(sphere.center), radius_(sphere.radius), unit_(power_of_two_below(sphere.radius)) {}

Bounds SphereShape::bounds() const {
  Bounds result;
  result.include_around(center_, Vec3(radius_));
  return result;
}

bool SphereShape::crossings(const ObjectRay& ray, CrossingList& out) const {
  if (ray.start.face == 0) return crossings_from_surface(ray, out);
  const auto chord = SphereChord<double>::of(ray, center_, radius_, unit_);
  if (!chord.found) return false;
  const double enter = chord.enter;
  const double leave = chord.leave;
  out.push_back({.t = enter, .error = chord.error_of(enter), .root = 0, .entering = true});
  out.push_back({.t = leave, .error = chord.error_of(leave), .root = 1, .entering = false});
  return false;
}

template <class Real, class Ray>
void SphereShape::write_span(const Ray& ray, const WantedEnds<Real>& /*wanted*/,
                             ShapeSpan<Real>& span) const {
  const auto chord = SphereChord<Real>::of(ray, center_, radius_, unit_);
  span.misses = !chord.found;
  span.enter = {.known = chord.found, .t = chord.enter, .error = chord.error_of(chord.enter)};
  span.leave = {.known = chord.found, .t = chord.leave, .error = chord.error_of(chord.leave)};
  span.leave_root = 1;
}

void SphereShape::exit_from_surface(const PlainRay<double>& line, SpanEnd<double>& end) const {
  const auto other = SphereOtherEnd<double>::of(line, center_, radius_, unit_);
  end = {.known = other.t > 0.0, .t = other.t, .error = other.error};
}
void SphereShape::exit_from_surface(const RayLanes& lines, SpanEnd<Lanes>& end) const {
  const auto other = SphereOtherEnd<Lanes>::of(lines, center_, radius_, unit_);
  end = {.known = other.t > 0.0, .t = other.t, .error = other.error};
}

bool SphereShape::crossings_from_surface(const ObjectRay& ray, CrossingList& out) const {
  const auto end = SphereOtherEnd<double>::of(ray, center_, radius_, unit_);
  ClippedSpan span(ray.start, end.least_length);
  if (ray.start.side == Side::outside) {
    span.enter({.t = end.t, .error = end.error, .root = 0});
    span.leave({.root = 1});
  } else {
    span.enter({.root = 0});
    span.leave({.t = end.t, .error = end.error, .root = 1});
  }
  return span.finish(out);
}

namespace {

/// Writes the point of a sphere, or of a sphere for each lane, next to `offset` from the center. A
/// line of the given direction crosses the sphere there.
template <class Real>
inline void write_sphere_point(const Vec3Of<Real>& center, const Real& radius,
                               const Vec3Of<Real>& offset, const Vec3Of<Real>& direction,
                               bool with_uv, SurfacePointOf<Real>& point) {
  const auto is_apart = largest_component(offset) > 0.0;
  const Vec3Of<Real> n = unit_vector(select(is_apart, offset, -direction));
  point.position = center + radius * n;
  point.normal = n;
  if (!with_uv) return;
  point.u = turn(n.z, n.x);
  point.v = latitude(sqrt(n.x * n.x + n.z * n.z), n.y);
}

}  // namespace

template <class Real>
void SphereShape::write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>& direction,
                              std::uint32_t, bool with_uv, SurfacePointOf<Real>& point) const {
  write_sphere_point<Real>(broadcast<Real>(center_), broadcast<Real>(radius_), offset, direction,
                           with_uv, point);
}

const void* SphereShape::family() const {
  static constexpr char spheres = 0;
  return &spheres;
}

void SphereShape::points_on_each(const std::array<const Shape*, lane_count>& spheres,
                                 const RayLanes& rays, const Lanes& t, bool with_uv,
                                 SurfacePointLanes& points) const {
  const auto row = [&](std::size_t lane) {
    const auto& sphere = static_cast<const SphereShape&>(*spheres[lane]);
    return lanes_of(sphere.center_.x, sphere.center_.y, sphere.center_.z, sphere.radius_);
  };
  const auto [x, y, z, radius] = transposed({row(0), row(1), row(2), row(3)});
  const VectorLanes center = {x, y, z};
  write_sphere_point<Lanes>(center, radius, rays.from_center(center, t), rays.direction, with_uv,
                            points);
}

Surface SphereShape::surface(std::uint32_t) const {
  return {.kind = SurfaceKind::sphere, .position = center_ + Vec3(0.0), .sizes = {radius_, 0}};
}

std::unique_ptr<const FaceFunctions> SphereShape::face_functions() const {
  const double inverse_unit = inverse_of_power(unit_);
  return face_functions_of(SphereFunction{.center = center_,
                                          .inverse_unit = inverse_unit,
                                          .radius = Interval::of(radius_ * inverse_unit)});
}

SurfacePieces SphereShape::pieces() const {
  return {{.kind = SurfacePiece::Kind::sphere, .origin = center_, .radius = radius_}};
}

std::unique_ptr<const Shape> make_shape(const Sphere& sphere) {
  return std::make_unique<SphereShape>(sphere);
}

}  // namespace crt::core
