// Identities of samples: those that meet the same things on the same paths have the same one,
// others most likely not. The things are surfaces with the side and the kind of ray that they are
// met by, the background, and shadows of lights.
#pragma once

#include "core/render/path_hits.hpp"

namespace crt::core {

/// Takes one more thing that a sample has met into its identity.
inline void identify(Sample& sample, std::uint64_t thing) {
  constexpr std::uint64_t factor = 0x9e3779b97f4a7c15u;  // 2^64 / the golden ratio
  const std::uint64_t mixed = (sample.identity ^ thing) * factor;
  sample.identity = mixed ^ mixed >> 29;
}

/// Takes what the rays of a round have met: a primitive, the triangles of a mesh all alike, or the
/// background.
inline void identify_hits(const PreparedData& data, const PathRays& rays, const PathHits& hits) {
  constexpr std::uint64_t is_surface = std::uint64_t{1} << 32;
  constexpr std::uint64_t is_entered = std::uint64_t{1} << 33;
  constexpr int place_of_kind = 34;
  for_each_ray(hits.on_background(),
               [&](std::size_t i) { identify(*rays.samples[i], invalid_index); });
  for_each_ray(hits.on_surface(), [&](std::size_t i) {
    const RayHit& hit = hits.hits[i];
    const std::uint64_t met = data.is_solid(hit) ? hit.leaf : is_surface | data.entity_id(hit);
    const auto kind = static_cast<std::uint64_t>(rays.states[i].kind) << place_of_kind;
    identify(*rays.samples[i], met | (hit.entering ? is_entered : 0) | kind);
  });
}

/// Takes that something is on the paths from the surfaces of some rays to a light.
inline void identify_shadows(const PathRays& rays, std::size_t light, RayMask shaded) {
  constexpr std::uint64_t is_shadow = std::uint64_t{1} << 40;
  for_each_ray(shaded, [&](std::size_t i) { identify(*rays.samples[i], is_shadow | light); });
}

}  // namespace crt::core
