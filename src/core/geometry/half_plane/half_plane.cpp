#include "core/geometry/half_plane/half_plane.hpp"

#include "core/geometry/checks.hpp"
#include "core/math/vector.hpp"

namespace crt::core {
namespace {

/// Returns the edge's direction, normal x direction up to a positive factor. Each component is 0 or
/// has nearly all of its digits. So it is 0 only if the two are parallel.
Vec3 edge(const HalfPlane& half_plane) {
  return accurate_cross(scaled_to_one(half_plane.normal), scaled_to_one(half_plane.direction));
}

}  // namespace

HalfPlaneShape::HalfPlaneShape(const HalfPlane& half_plane)
    : face_(half_plane.normal, half_plane.position),
      inward_(unit_vector(accurate_cross(unit_vector(edge(half_plane)), face_.normal())) +
              Vec3(0.0)) {}

Bounds HalfPlaneShape::bounds() const {
  Bounds result = Bounds::everything();
  if (face_.axis() >= 0) {
    result.lower[face_.axis()] = face_.position()[face_.axis()];
    result.upper[face_.axis()] = face_.position()[face_.axis()];
  }
  const int axis = coordinate_axis(inward_);
  if (axis >= 0) (inward_[axis] > 0 ? result.lower : result.upper)[axis] = face_.position()[axis];
  return result;
}

bool HalfPlaneShape::crossings(const ObjectRay& ray, CrossingList& out) const {
  const PlaneFace::Meeting meeting = face_.meet_surface(ray);
  if (!meeting.found) return false;
  if (PlaneFace::starts_here(ray) || glm::dot(face_.point(ray, meeting), inward_) >= 0)
    PlaneFace::emit(meeting, out);
  return false;
}

template <class Real>
void HalfPlaneShape::write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>&, std::uint32_t,
                                 bool with_uv, SurfacePointOf<Real>& point) const {
  const Vec3Of<Real> relative = face_.onto_plane(offset);
  face_.write_point(relative, point);
  if (!with_uv) return;
  point.u = max(Real{}, dot(relative, broadcast<Real>(inward_)));
  point.v = dot(relative, broadcast<Real>(glm::cross(face_.unit_normal(), inward_)));
}

void validate(const HalfPlane& half_plane) {
  if (largest_component(edge(half_plane)) == 0)
    reject("direction", "must not be parallel to normal");
}

std::unique_ptr<const Shape> make_shape(const HalfPlane& half_plane) {
  return std::make_unique<HalfPlaneShape>(half_plane);
}

}  // namespace crt::core
