#include "core/scene/ray_packet.hpp"

#include <algorithm>

#include "core/scene/certain_end.hpp"

namespace crt::core {

namespace {

/// Rays that are side by side in lanes.
using RayGroup = std::array<const WorldRay*, lane_count>;

/// What is beyond the last ray is like it, so that no lane holds nonsense.
RayGroup group_from(std::span<const WorldRay> rays, std::size_t first) {
  const WorldRay* ray = &rays[first];
  const std::size_t last = rays.size() - 1 - first;
  if (last >= lane_count - 1) return {ray, ray + 1, ray + 2, ray + 3};
  return {ray, ray + std::min<std::size_t>(1, last), ray + std::min<std::size_t>(2, last), ray + last};
}

/// One number of each.
template <class Of>
Lanes gathered(const RayGroup& group, const Of& of) {
  return Lanes{of(*group[0]), of(*group[1]), of(*group[2]), of(*group[3])};
}

/// (A call would cost as much as it does.)
[[gnu::always_inline]] inline VectorLanes gathered(const RayGroup& group, Vec3 WorldRay::*vector) {
  const auto component = [&](int axis) {
    return gathered(group, [=](const WorldRay& ray) { return (ray.*vector)[axis]; });
  };
  return {component(0), component(1), component(2)};
}

Lanes gathered(const RayGroup& group, double WorldRay::*number) {
  return gathered(group, [=](const WorldRay& ray) { return ray.*number; });
}

RayLanes lines_of(const RayGroup& group) {
  return {gathered(group, &WorldRay::origin), gathered(group, &WorldRay::direction)};
}

/// When rays begin and end, and by how much both may be off.
struct Ends {
  Lanes t_min;
  Lanes start_error;
  Lanes t_max;
  Lanes end_error;
};

void fill(const RayLanes& rays, const Ends& ends, OutlineLine<Lanes>& lines, Lanes& limits) {
  lines.origin = {rays.origin.x, rays.origin.y, rays.origin.z};
  lines.direction = {rays.direction.x, rays.direction.y, rays.direction.z};
  lines.squared_speed = dot(lines.direction, lines.direction);
  lines.inverse_squared_speed = 1.0 / lines.squared_speed;
  lines.inverse_speed = sqrt(lines.inverse_squared_speed);
  for (std::size_t axis = 0; axis < 3; ++axis) lines.inverse[axis] = 1.0 / lines.direction[axis];
  lines.begin = ends.t_min;
  lines.start_error = ends.start_error;
  lines.certain_from = farthest_start(lines.begin, lines.start_error);
  limits = ends.t_max;
  lines.certain_to = finite_end(certain_end(rays, limits, ends.end_error));
}

/// Whether some rays go nearly the same way as the first of them; directions(group) are those of a group.
template <class Directions>
bool go_together(RayMask some, const Vec3& first, const Directions& directions) {
  constexpr double widest = 0.9;  // the cosine of the angle with the first ray
  const VectorLanes first_lanes = lanes_of(first);
  const double first_square = widest * widest * glm::dot(first, first);
  RayMask astray = 0;
  RayPacket::for_each_group(some, [&](std::size_t group, RayMask lanes) {
    const VectorLanes direction = directions(group);
    const Lanes along = dot(direction, first_lanes);
    const LaneMask is_near = (along > 0.0) & (along * along > first_square * dot(direction, direction));
    astray |= lanes & ~mask_of(is_near);
  });
  return astray == 0;
}

}  // namespace

RayLanes ray_lanes(std::span<const WorldRay> rays) {
  return lines_of(group_from(rays, 0));
}

Lanes ray_lanes(std::span<const WorldRay> rays, double WorldRay::*number) {
  return gathered(group_from(rays, 0), number);
}

WorldRay SurfaceRays::ray(std::size_t index) const {
  const std::size_t group = index / lane_count;
  const std::size_t lane = index % lane_count;
  const auto i = static_cast<int>(lane);
  return {.origin = lines[group].origin.lane(lane),
          .direction = lines[group].direction.lane(lane),
          .t_max = t_max[group][i],
          .start = starts[index],
          .end_error = end_errors[group][i]};
}

RayPacket::RayPacket(std::span<const WorldRay> rays) {
  for (std::size_t group = 0; group * lane_count < rays.size(); ++group) {
    const RayGroup of_rays = group_from(rays, group * lane_count);
    const Ends ends = {
        .t_min = gathered(of_rays, &WorldRay::t_min),
        .start_error = gathered(of_rays, [](const WorldRay& ray) { return ray.start.t_error; }),
        .t_max = gathered(of_rays, &WorldRay::t_max),
        .end_error = gathered(of_rays, &WorldRay::end_error)};
    fill(lines_of(of_rays), ends, groups[group], limits[group]);
  }
}

RayPacket::RayPacket(const SurfaceRays& rays, RayMask some) : starts(rays.noted) {
  for_each_group(some, [&](std::size_t group, RayMask) {
    const StartPoint* const start = &rays.starts[group * lane_count];
    const Ends ends = {
        .t_min = {},
        .start_error = {start[0].t_error, start[1].t_error, start[2].t_error, start[3].t_error},
        .t_max = rays.t_max[group],
        .end_error = rays.end_errors[group]};
    fill(rays.lines[group], ends, groups[group], limits[group]);
  });
}

bool go_together(std::span<const WorldRay> rays, RayMask some) {
  if (std::popcount(some) < fewest_together) return false;
  return go_together(some, rays[first_ray(some)].direction, [&](std::size_t group) {
    return gathered(group_from(rays, group * lane_count), &WorldRay::direction);
  });
}

bool go_together(const SurfaceRays& rays, RayMask some) {
  if (std::popcount(some) < fewest_together) return false;
  const std::size_t first = first_ray(some);
  return go_together(some, rays.lines[first / lane_count].direction.lane(first % lane_count),
                     [&](std::size_t group) { return rays.lines[group].direction; });
}

}  // namespace crt::core
