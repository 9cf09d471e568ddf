#include "core/ray/ray_packet.hpp"

#include <glm/geometric.hpp>

#include "core/ray/line_of_ray.hpp"

namespace crt::core {

WorldRay RayBatch::ray(std::size_t index) const {
  const std::size_t group = index / lane_count;
  const std::size_t lane = index % lane_count;
  WorldRay ray{.origin = lines[group].origin.lane(lane),
               .direction = lines[group].direction.lane(lane),
               .t_min = t_min[group][lane],
               .t_max = t_max[group][lane],
               .end_error = end_errors[group][lane],
               .max_size_error = max_size_error,
               .is_input = is_input};
  if ((with_starts >> index & 1u) != 0) ray.start = starts[index];
  if ((with_ends >> index & 1u) != 0) {
    ray.end_point = ends[index].point;
    ray.end_error = ends[index].error;
  }
  ray.start.t_error = start_errors[group][lane];
  return ray;
}

void RayBatch::set(std::size_t index, const WorldRay& ray) {
  const std::size_t group = index / lane_count;
  const std::size_t i = index % lane_count;
  set(index, ray.origin, ray.direction, ray.start);
  t_min[group][i] = ray.t_min;
  t_max[group][i] = ray.t_max;
  end_errors[group][i] = ray.end_error;
  if (ray.end_point.is_known()) {
    ends[index] = {ray.end_point, ray.end_error};
    end_errors[group][i] = infinity;
    with_ends |= RayMask{1} << index;
  }
  max_size_error = ray.max_size_error;
  is_input = ray.is_input;
}

template <>
RayPacketOf<Lanes>::RayPacketOf(const RayBatch& rays, const Starts& of_rays, RayMask some)
    : source(rays), starts(of_rays) {
  for_each_group(some, [&](std::size_t group, RayMask) {
    limits[group] = rays.t_max[group];
    set_line(rays.lines[group], rays.t_min[group], rays.start_errors[group], limits[group],
             rays.end_errors[group], rays.max_size_error, groups[group]);
  });
}

bool go_together(const RayBatch& rays, RayMask some) {
  if (std::popcount(some) < fewest_together) return false;
  constexpr double widest = 0.9;  // the cosine of the angle with the first ray
  const Vec3 direction = rays.direction(first_ray(some));
  const VectorLanes first_lanes = lanes_of(direction);
  const double first_square = widest * widest * glm::dot(direction, direction);
  RayMask astray = 0;
  RayPacket::for_each_group(some, [&](std::size_t group, RayMask lanes) {
    const VectorLanes& others = rays.lines[group].direction;
    const Lanes along = dot(others, first_lanes);
    const LaneMask is_near = (along > 0.0) & (along * along > first_square * dot(others, others));
    astray |= lanes & ~mask_of(is_near);
  });
  return astray == 0;
}

}  // namespace crt::core
