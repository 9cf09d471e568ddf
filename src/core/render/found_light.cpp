#include "core/render/found_light.hpp"

#include <glm/geometric.hpp>

#include "core/base/invalid_index.hpp"

namespace crt::core {

Lanes shares_of_rays(const TraceContext& context, const PathRays& rays, std::size_t group,
                     const PreparedLight& light, std::uint32_t chosen, const Lanes& t) {
  const Lanes own = rays.densities(group);
  if (all(own == 0.0)) return lanes_of(1);
  const RayLanes& lines = rays.batch.lines[group];
  Lanes densities = light.densities(lines, t);
  if (chosen != invalid_index) {
    const LightTree& tree = context.data.chosen_lights()->tree();
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      if (!(own[lane] > 0)) continue;
      const PathState& state = rays.states[group * lane_count + lane];
      densities[lane] *=
          tree.probability({lines.origin.lane(lane), state.normal.direction()}, chosen);
    }
  }
  return select(own > 0.0, balanced<Lanes>(own, densities), lanes_of(1));
}

Lanes shares_of_emission(const TraceContext& context, const PathRays& rays, std::size_t group,
                         RayMask some, const SurfaceGroup& surfaces) {
  Lanes shares = lanes_of(1);
  const ChosenLights* const lights = context.data.chosen_lights();
  if (lights == nullptr) return shares;
  some &= mask_of(rays.densities(group) > 0.0);
  for_each_ray(some, [&](std::size_t lane) {
    const StartPoint& place = surfaces.starts[lane];
    const std::uint32_t number = lights->of_face(place.leaf, place.face);
    if (number == invalid_index) return;
    const Vec3 way = surfaces.position.lane(lane) - rays.batch.lines[group].origin.lane(lane);
    shares[lane] = shares_of_rays(context, rays, group, lights->lights()[number], number,
                                  lanes_of(glm::length(way)))[lane];
  });
  return shares;
}

}  // namespace crt::core
