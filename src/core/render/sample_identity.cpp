#include "core/render/sample_identity.hpp"

namespace crt::core {

namespace {

/// Takes one more thing that a sample has met into its identity.
void take(Sample& sample, std::uint64_t thing) {
  constexpr std::uint64_t factor = 0x9e3779b97f4a7c15u;  // 2^64 / the golden ratio
  const std::uint64_t mixed = (sample.identity ^ thing) * factor;
  sample.identity = mixed ^ mixed >> 29;
}

/// Returns a surface as it is met: a primitive, the triangles of a mesh all alike.
std::uint64_t met(const PreparedData& data, const RayHit& hit, RayKind kind) {
  constexpr std::uint64_t is_surface = std::uint64_t{1} << 32;
  constexpr std::uint64_t is_entered = std::uint64_t{1} << 33;
  constexpr int place_of_kind = 34;
  return (data.is_solid(hit) ? hit.leaf : is_surface | data.entity_id(hit)) |
         (hit.entering ? is_entered : 0) | static_cast<std::uint64_t>(kind) << place_of_kind;
}

}  // namespace

void identify_hits(const PreparedData& data, const PathRays& rays, const PathHits& hits,
                   const Surfaces& surfaces) {
  for_each_ray(hits.on_background, [&](std::size_t i) { take(*rays.samples[i], nothing); });
  const auto take_hit = [&](std::size_t i) {
    take(*rays.samples[i], met(data, hits.hits[i], rays.states[i].kind));
  };
  // Samples of camera rays follow each other and have met nothing before. Most groups of them meet
  // what others do: these get the same identity.
  const RayHit* last = nullptr;
  std::uint64_t identity = 0;
  RayPacket::for_each_group(surfaces.rays, [&](std::size_t group, RayMask lanes) {
    const std::size_t first = group * lane_count;
    if (!rays.are_from_camera() || surfaces.groups[group].like_first != RayPacket::group_mask) {
      for_each_ray(lanes, [&](std::size_t lane) { take_hit(first + lane); });
      return;
    }
    const RayHit& hit = hits.hits[first];
    Sample* const samples = rays.samples[first];
    if (last == nullptr || hit.leaf != last->leaf || hit.entering != last->entering) {
      take_hit(first);
      last = &hit;
      identity = samples->identity;
    }
    for (std::size_t lane = 0; lane < lane_count; ++lane) samples[lane].identity = identity;
  });
}

void identify_shadows(const PathRays& rays, std::size_t light, RayMask shaded) {
  constexpr std::uint64_t is_shadow = std::uint64_t{1} << 40;
  for_each_ray(shaded, [&](std::size_t i) { take(*rays.samples[i], is_shadow | light); });
}

}  // namespace crt::core
