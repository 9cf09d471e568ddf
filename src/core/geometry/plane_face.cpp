#include "core/geometry/plane_face.hpp"

#include "core/math/vector.hpp"

namespace crt::core {

PlaneFace::PlaneFace(const Vec3& normal, const Vec3& position)
    : normal_(scaled_to_one(normal)),
      unit_normal_(unit_vector(normal)),
      position_(position),
      axis_(coordinate_axis(normal)) {}

PlaneFace::Meeting PlaneFace::meet(const ObjectRay& ray) const {
  if (axis_ >= 0) return meet_axis_plane(ray);
  Meeting result;
  const DoubleDouble rate =
      accurate_dot(normal_, ray.direction) + glm::dot(normal_, ray.direction_low);
  result.rate = rate.value();
  if (result.rate == 0) return result;

  // This is in double-double. From afar or nearly along the plane, the rounding of any point on the
  // way would be larger than what decides.
  DoubleDouble t = -(height_at_origin(ray) / rate);
  if (!std::isfinite(t.hi)) return result;
  // For a position next to the line's point even that leaves a remainder, which is measured there.
  // A remainder within the rounding of the measurement is ignored.
  Vec3 near = ray.from_center(position_, t.hi, t.lo);
  const double rest = accurate_dot(normal_, near).value();
  constexpr double measurable = 12 * unit_roundoff;
  if (std::abs(rest) > measurable * largest_component(near)) {
    const double step = -rest / result.rate;
    const DoubleDouble moved = t + DoubleDouble(step);
    if (std::isfinite(moved.hi)) {
      t = moved;
      near += step * ray.direction;
    }
  }
  result.found = true;
  result.t = t.hi;
  result.t_low = t.lo;
  result.error = meeting_error(t.hi, glm::length(near), glm::length(normal_), result.rate);
  return result;
}

double PlaneFace::meeting_error(double t, double reach, double normal_length, double rate) {
  constexpr double roundings = 8;
  return rounding_of(t) + roundings * unit_roundoff * reach * normal_length / std::abs(rate);
}

PlaneFace::Meeting PlaneFace::meet_axis_plane(const ObjectRay& ray) const {
  const double speed = ray.direction[axis_];
  const auto meeting = meet_across_axis<double>(ray);
  return {.found = meeting.found,
          .t = meeting.t,
          .t_low = meeting.t_low,
          .error = meeting.error,
          .rate = normal_[axis_] > 0 ? speed : -speed};
}

Vec3 PlaneFace::point(const ObjectRay& ray, const Meeting& meeting) const {
  return onto_plane(ray.from_center(position_, meeting.t, meeting.t_low));
}

DoubleDouble PlaneFace::height_at_origin(const ObjectRay& ray) const {
  DoubleDouble height;
  for (int axis = 0; axis < 3; ++axis) {
    const DoubleDouble offset = two_sum(ray.origin[axis], -position_[axis]);
    height = height + two_product(normal_[axis], offset.hi) +
             DoubleDouble(normal_[axis] * (offset.lo + ray.origin_low[axis]));
  }
  return height;
}

void PlaneFace::clip(const ObjectRay& ray, std::uint32_t face, ClippedSpan& span) const {
  if (ray.start.face == face) {
    const double rate = meet(ray).rate;
    const Crossing start{.face = face};
    if (rate > 0) {
      span.leave(start);
    } else if (ray.start.side == Side::outside) {
      span.clear();
    } else if (rate < 0) {
      span.enter(start);
    }
    return;
  }
  const Meeting meeting = meet(ray);
  if (!meeting.found) {
    if (!behind(ray)) span.clear();
    return;
  }
  const Crossing crossing{.t = meeting.t, .error = meeting.error, .face = face};
  if (meeting.rate > 0) {
    span.leave(crossing);
  } else {
    span.enter(crossing);
  }
}

PlaneFace::Meeting PlaneFace::meet_surface(const ObjectRay& ray) const {
  Meeting meeting = meet(ray);
  if (ray.start.face != 0 || meeting.rate == 0) return meeting;
  const double rate = std::abs(meeting.rate);
  return {.found = true, .rate = ray.start.side == Side::inside ? -rate : rate};
}

void PlaneFace::emit(const Meeting& meeting, CrossingList& out) {
  out.push_back(
      {.t = meeting.t, .error = meeting.error, .face = 0, .root = 0, .entering = meeting.rate < 0});
}

Surface PlaneFace::surface() const {
  Surface surface{.kind = SurfaceKind::plane, .position = position_, .direction = normal_};
  if (axis_ >= 0) {
    surface.position = Vec3(0.0);
    surface.position[axis_] = position_[axis_];
  }
  return surface;
}

Vec3 canonical_axis(const Vec3& axis) {
  int largest = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(axis[i]) > std::abs(axis[largest])) largest = i;
  }
  return axis / axis[largest];
}

PlaneAxes plane_axes(const Vec3& normal) {
  const Vec3 n = unit_vector(normal);
  const Vec3 size = glm::abs(n);
  const int along = size.x > size.y && size.x > size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const int u_axis = along == 0 ? 2 : 0;
  const int v_axis = along == 1 ? 2 : 1;
  Vec3 u(0.0);
  u[u_axis] = 1;
  u = unit_vector(u - n * n[u_axis]);
  Vec3 v = glm::cross(n, u);
  if (v[v_axis] < 0) v = -v;
  return {u + Vec3(0.0), v + Vec3(0.0)};
}

}  // namespace crt::core
