#include "core/geometry/plane.hpp"

#include <glm/geometric.hpp>

#include "core/geometry/checks.hpp"

namespace crt::core {

PlaneShape::PlaneShape(const Plane& plane)
    : face_(plane.normal, plane.position), axes_(plane_axes(plane.normal)) {}

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

SurfacePoint PlaneShape::surface_point(const ObjectRay& ray, const Crossing& crossing,
                                       bool /*with_uv*/) const {
  const Vec3 relative = face_.onto_plane(ray.from_center(face_.position(), crossing.t));
  SurfacePoint result = face_.surface_point(relative);
  result.u = glm::dot(relative, axes_.u);
  result.v = glm::dot(relative, axes_.v);
  return result;
}

void PlaneShape::surface_points(const VectorLanes& offsets, const VectorLanes&, std::uint32_t,
                                SurfacePointLanes& points) const {
  set_place(points, face_.surface_point(face_.onto_plane(offsets)));
}

void validate(const Plane& plane) {
  check_direction("normal", plane.normal);
  check_coordinates("position", plane.position);
}

std::unique_ptr<const Shape> make_shape(const Plane& plane) {
  return std::make_unique<PlaneShape>(plane);
}

}  // namespace crt::core
