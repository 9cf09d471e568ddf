#include "core/geometry/sphere.hpp"

#include <numbers>

#include "core/geometry/angles.hpp"
#include "core/geometry/checks.hpp"
#include "core/geometry/stretch.hpp"

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
  const auto chord = this->chord<double>(ray);
  if (!chord.found) return false;
  out.push_back({.t = chord.enter.t, .error = chord.enter.error, .root = 0, .entering = true});
  out.push_back({.t = chord.leave.t, .error = chord.leave.error, .root = 1, .entering = false});
  return false;
}

bool SphereShape::crossings_from_surface(const ObjectRay& ray, CrossingList& out) const {
  const auto end = SphereOtherEnd<double>::of(ray, center_, radius_, unit_);
  Stretch stretch(ray.start, end.least_way);
  if (ray.start.side == Side::outside) {
    stretch.enter({.t = end.t, .error = end.error, .root = 0});
    stretch.leave({.root = 1});
  } else {
    stretch.enter({.root = 0});
    stretch.leave({.t = end.t, .error = end.error, .root = 1});
  }
  return stretch.finish(out);
}

template <class Real>
SurfacePointOf<Real> SphereShape::point_near(const Vec3Of<Real>& offset, const Vec3Of<Real>& direction,
                                             std::uint32_t, bool with_uv) const {
  const auto is_apart = largest_component(offset) > 0.0;
  const Vec3Of<Real> n = unit_vector(chosen(is_apart, offset, -direction));
  SurfacePointOf<Real> result{.position = spread<Real>(center_) + spread<Real>(radius_) * n, .normal = n};
  if (!with_uv) return result;
  result.u = turn(n.z, n.x);
  result.v = rise(square_root(n.x * n.x + n.z * n.z), n.y);
  return result;
}

Surface SphereShape::surface(std::uint32_t) const {
  return {.kind = SurfaceKind::sphere, .position = center_ + Vec3(0.0), .sizes = {radius_, 0}};
}

void validate(const Sphere& sphere) {
  check_coordinates("center", sphere.center);
  check_radius("radius", sphere.radius);
}

std::unique_ptr<const Shape> make_shape(const Sphere& sphere) {
  return std::make_unique<SphereShape>(sphere);
}

}  // namespace crt::core
