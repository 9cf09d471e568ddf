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

void fill(const RayGroup& group, OutlineLine<Lanes>& lines, Lanes& limits) {
  const RayLanes rays = lines_of(group);
  lines.origin = {rays.origin.x, rays.origin.y, rays.origin.z};
  lines.direction = {rays.direction.x, rays.direction.y, rays.direction.z};
  lines.squared_speed = dot(lines.direction, lines.direction);
  lines.inverse_squared_speed = 1.0 / lines.squared_speed;
  lines.inverse_speed = sqrt(lines.inverse_squared_speed);
  for (std::size_t axis = 0; axis < 3; ++axis) lines.inverse[axis] = 1.0 / lines.direction[axis];
  lines.begin = gathered(group, &WorldRay::t_min);
  lines.start_error = gathered(group, [](const WorldRay& ray) { return ray.start.t_error; });
  lines.certain_from = farthest_start(lines.begin, lines.start_error);
  limits = gathered(group, &WorldRay::t_max);
  lines.certain_to = finite_end(certain_end(rays, limits, gathered(group, &WorldRay::end_error)));
}

}  // namespace

RayLanes ray_lanes(std::span<const WorldRay> rays) {
  return lines_of(group_from(rays, 0));
}

Lanes ray_lanes(std::span<const WorldRay> rays, double WorldRay::*number) {
  return gathered(group_from(rays, 0), number);
}

RayPacket::RayPacket(std::span<const WorldRay> rays) {
  std::size_t group = 0;
  for (; group * lane_count < rays.size(); ++group) {
    fill(group_from(rays, group * lane_count), groups[group], limits[group]);
  }
  for (; group < group_count; ++group) {
    groups[group] = groups[group - 1];
    limits[group] = limits[group - 1];
  }
}

bool go_together(std::span<const WorldRay> rays, RayMask some) {
  if (std::popcount(some) < fewest_together) return false;
  constexpr double widest = 0.9;  // the cosine of the angle with the first ray
  const Vec3& first = rays[first_ray(some)].direction;
  const VectorLanes first_lanes = lanes_of(first);
  const double first_square = widest * widest * glm::dot(first, first);
  for (std::size_t i = 0; i < rays.size(); i += lane_count) {
    const RayMask lanes = RayPacket::lanes(some, i / lane_count);
    if (lanes == 0) continue;
    const VectorLanes direction = gathered(group_from(rays, i), &WorldRay::direction);
    const Lanes along = dot(direction, first_lanes);
    const LaneMask is_near = (along > 0.0) & (along * along > first_square * dot(direction, direction));
    if ((lanes & ~mask_of(is_near)) != 0) return false;
  }
  return true;
}

}  // namespace crt::core
