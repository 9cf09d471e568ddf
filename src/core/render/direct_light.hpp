// Direct light is what surfaces send back along paths of the light that comes straight from lights.
#pragma once

#include "core/render/path_hits.hpp"

namespace crt::core {

/// ShadowRays are memory for the rays from a round's surfaces to a light.
struct ShadowRays {
  RayBatch batch;
  std::array<VectorLanes, RayPacket::group_count> light;  ///< that comes if they meet nothing
  /// This is the part of it that rays which the surfaces send on find, too, through what is
  /// transparent. It is set where PreparedLight::is_found_by_rays().
  std::array<VectorLanes, RayPacket::group_count> found_by_rays;
  std::array<LightNumbers, RayPacket::group_count> numbers;  ///< of lights with a size
  std::array<LightView, RayPacket::group_count> views;       ///< of the light that is asked
  LightSamples samples;  ///< of a group; a new one for each would be filled with zeros first
};

/// Returns what surfaces send back of the ambient light, and of all lights that reach them.
PathLight direct_light(TraceContext& context, const PathRays& rays, const Surfaces& surfaces,
                       ShadowRays& shadow_rays);

}  // namespace crt::core
