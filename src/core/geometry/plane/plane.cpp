#include "core/geometry/plane/plane.hpp"

#include <glm/geometric.hpp>

#include "core/geometry/plane/functions.hpp"

namespace crt::core {

PlaneShape::PlaneShape(const Plane& plane)
    : face_(plane.normal, plane.position), axes_(plane_axes(plane.normal)) {}

std::unique_ptr<const FaceFunctions> PlaneShape::face_functions() const {
  const Vec3 normal =
      face_.normal() * inverse_of_power(power_of_two_below(largest_component(face_.normal())));
  return face_functions_of(PlaneFunction{
      {.normal = {Interval::of(normal.x), Interval::of(normal.y), Interval::of(normal.z)},
       .position = face_.position()}});
}

Bounds PlaneShape::bounds() const {
  Bounds result = Bounds::everything();
  if (face_.axis() >= 0) {
    const int axis = face_.axis();
    (face_.normal()[axis] > 0 ? result.upper : result.lower)[axis] = face_.position()[axis];
  }
  return result;
}

bool PlaneShape::crossings(const ObjectRay& ray, CrossingList& out) const {
  if (ray.start.face == 0) {
    const bool entering = ray.start.side == Side::inside;
    if (face_.meet(ray).rate == 0) return entering;
    out.push_back({.entering = entering});
    return !entering;
  }
  const PlaneFace::Meeting meeting = face_.meet(ray);
  if (!meeting.found) return face_.behind(ray);
  PlaneFace::emit(meeting, out);
  return meeting.rate > 0;
}

/// Lines are solved side by side if the plane is across a coordinate axis.
template <class Real, class Ray>
void PlaneShape::write_span(const Ray& ray, const WantedEnds<Real>& /*wanted*/,
                            ShapeSpan<Real>& span) const {
  const int axis = face_.axis();
  if (axis < 0) return;
  const auto meeting = face_.template meet_across_axis<Real>(ray);
  const auto enters =
      face_.normal()[axis] > 0 ? ray.direction[axis] < 0.0 : ray.direction[axis] > 0.0;
  span.enter = {.known = meeting.found && enters, .t = meeting.t, .error = meeting.error};
  span.leave = {.known = meeting.found && !enters, .t = meeting.t, .error = meeting.error};
}

template <class Real>
void PlaneShape::write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>&, std::uint32_t,
                             bool with_uv, SurfacePointOf<Real>& point) const {
  const Vec3Of<Real> relative = face_.onto_plane(offset);
  face_.write_point(relative, point);
  if (!with_uv) return;
  point.u = dot(relative, broadcast<Real>(axes_.u));
  point.v = dot(relative, broadcast<Real>(axes_.v));
}

std::unique_ptr<const Shape> make_shape(const Plane& plane) {
  return std::make_unique<PlaneShape>(plane);
}

}  // namespace crt::core
