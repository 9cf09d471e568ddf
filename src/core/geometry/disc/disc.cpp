#include "core/geometry/disc/disc.hpp"

#include <crt/elementary.hpp>

#include "core/math/vector.hpp"

namespace crt::core {

DiscShape::DiscShape(const Disc& disc)
    : face_(disc.normal, disc.center), frame_(frame_about(disc.normal)), radius_(disc.radius) {}

Vec3 disc_extents(const Vec3& axis, double radius) {
  // This is sqrt(1 - a_i^2) by the two other components, so nothing cancels.
  const Vec3 a = unit_vector(axis);
  return radius * Vec3(elementary::hypot(a.y, a.z), elementary::hypot(a.x, a.z),
                       elementary::hypot(a.x, a.y));
}

Bounds DiscShape::bounds() const {
  Bounds result;
  result.include_around(face_.position(), disc_extents(frame_.along, radius_));
  if (face_.axis() >= 0) {
    result.lower[face_.axis()] = face_.position()[face_.axis()];
    result.upper[face_.axis()] = face_.position()[face_.axis()];
  }
  return result;
}

bool DiscShape::crossings(const ObjectRay& ray, CrossingList& out) const {
  const PlaneFace::Meeting meeting = face_.meet_surface(ray);
  if (!meeting.found) return false;
  if (PlaneFace::starts_here(ray) || glm::length(face_.point(ray, meeting) / radius_) <= 1)
    PlaneFace::emit(meeting, out);
  return false;
}

template <class Real>
void DiscShape::write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>&, std::uint32_t,
                            bool with_uv, SurfacePointOf<Real>& point) const {
  const Vec3Of<Real> relative = face_.onto_plane(offset);
  face_.write_point(relative, point);
  if (with_uv) set_polar(relative, frame_, radius_, point);
}

SurfacePieces DiscShape::pieces() const {
  return {{.kind = SurfacePiece::Kind::disc,
           .origin = face_.position(),
           .edge_a = radius_ * frame_.zero,
           .edge_b = radius_ * frame_.quarter,
           .normal = frame_.along}};
}

std::unique_ptr<const Shape> make_shape(const Disc& disc) {
  return std::make_unique<DiscShape>(disc);
}

}  // namespace crt::core
