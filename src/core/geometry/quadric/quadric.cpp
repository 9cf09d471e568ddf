#include "core/geometry/quadric/quadric.hpp"

#include "core/geometry/angles.hpp"
#include "core/geometry/near_line.hpp"
#include "core/geometry/quadric/functions.hpp"
#include "core/geometry/quadric/line.hpp"

namespace crt::core {
namespace {

/// Returns a crossing of the standard tier.
Crossing crossing_at(const Bounded& t) {
  return {.t = t.value.hi, .error = rounding_of(t.value.hi) + t.error};
}

}  // namespace

QuadricShape::QuadricShape(const Quadric& quadric) : form_(quadric), extent_(quadric) {}

bool QuadricShape::crossings(const ObjectRay& ray, CrossingList& out) const {
  if (ray.start.face == 0) return crossings_from_surface(ray, out);
  const QuadricLine line = QuadricLine::at_closest(form_, {.near = ray});
  if (line.a.is_certain()) {
    const bool opens_up = line.a.value.hi > 0;
    const Bounded discriminant = line.discriminant();
    if (!(discriminant.is_certain() && discriminant.value.hi > 0)) return !opens_up;
    const auto [low, high] = line.roots(discriminant);
    if (!(low.value.hi < high.value.hi)) return !opens_up;
    return emit_roots(opens_up, {crossing_at(low), crossing_at(high)}, out);
  }
  if (extent_.is_bounded) return false;
  if (line.b.is_certain()) {
    return emit_only_root(line.b.value.hi > 0, crossing_at(line.only_root()), out);
  }
  return line.c.is_certain() && line.c.value.hi < 0;
}

bool QuadricShape::crossings_from_surface(const ObjectRay& ray, CrossingList& out) const {
  const QuadricLine line = QuadricLine::at_origin(form_, {.near = ray});
  if (line.a.is_certain()) {
    Crossing other = crossing_at(line.root_beside_zero());
    other.error += line.to_t_length(start_error(line.c.value.hi, line.a.value.hi, line.b.value.hi));
    return emit_from_surface(ray.start.side, line.a.value.hi > 0, other, shortest_length(ray), out);
  }
  if (line.b.is_certain()) return emit_start(ray.start.side, out);
  return ray.start.side == Side::inside;
}

template <class Real>
void QuadricShape::write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>& direction,
                               std::uint32_t, bool with_uv, SurfacePointOf<Real>& point) const {
  Vec3Of<Real> p = broadcast<Real>(inverse_of_power(form_.unit)) * offset;
  // Rounding has put the point beside the surface. These are steps of Newton's method across it.
  constexpr int steps = 2;
  for (int step = 0; step < steps; ++step) {
    const Vec3Of<Real> slope = form_.gradient(p);
    const Vec3Of<Real> move = (form_.value(p) / dot(slope, slope)) * slope;
    const auto is_sound = largest_component(move) <= largest_component(p);
    p = select(is_sound, p - move, p);
  }
  const Vec3Of<Real> slope = form_.gradient(p);
  const auto has_slope = largest_component(slope) > 0.0;
  point.position = broadcast<Real>(form_.unit) * p;
  point.normal = unit_vector(select(has_slope, slope, -direction));
  if (!with_uv) return;
  point.u = turn(point.position.z, point.position.x);
  point.v = point.position.y;
}

Surface QuadricShape::quadric_surface(const QuadricForm& form) {
  const auto& [x, y, z] = form.rows;
  Surface surface{.kind = SurfaceKind::quadric,
                  .direction = {x.x, y.y, z.z},
                  .sizes = {x.y, x.z, y.z, form.linear.x, form.linear.y, form.linear.z,
                            form.constant, form.unit}};
  // The first number that is not 0 becomes positive.
  double first = 0;
  for (int axis = 0; axis < 3 && first == 0; ++axis) first = surface.direction[axis];
  for (std::size_t i = 0; i < surface.sizes.size() && first == 0; ++i) first = surface.sizes[i];
  if (first > 0) return surface;
  surface.is_hollow = true;
  surface.direction = -surface.direction;
  for (double& size : surface.sizes) size = -size;
  surface.sizes.back() = form.unit;
  return surface;
}

std::unique_ptr<const FaceFunctions> QuadricShape::face_functions() const {
  return face_functions_of(QuadricFunction{form_});
}

std::unique_ptr<const Shape> make_shape(const Quadric& quadric) {
  return std::make_unique<QuadricShape>(quadric);
}

}  // namespace crt::core
