// The parts of the tracer that look at first hits alone.
#include "core/render/first_hit.hpp"

#include "core/render/tracer.hpp"

namespace crt::core {

void Tracer::tell_first_hits(std::span<FirstHit> first_hits) {
  for (std::size_t i = 0; i < first_hits.size(); ++i) {
    Seen& seen = round_[i];
    first_hits[i] = {};
    if (!seen.hit.found()) continue;
    // Behind a medium that lets nothing through the surface has not been looked at.
    if (is_black(seen.weight)) look_up(data_, seen.path.ray, seen.hit, work_, seen.surface);
    first_hits[i] = {.normal = seen.surface.normal, .color = seen.surface.color};
  }
}

void Tracer::look(std::span<const CameraRay> rays, std::span<FirstPlace> places) {
  std::array<WorldRay, packet_size> world_rays;
  std::array<RayHit, packet_size> hits;
  for (std::size_t i = 0; i < rays.size(); ++i) world_rays[i] = Frame::eye_ray(rays[i]);
  tick(static_cast<unsigned>(rays.size()));
  data_.intersect_each(std::span(world_rays).first(rays.size()), hits, work_.rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    places[i] = {};
    if (!hits[i].found()) continue;
    PathRay path{.ray = world_rays[i]};
    if (hits[i].has_company && frame_.features().transparency) {
      hits[i] = seen_of(path, data_.intersect(path.ray, work_.rays));
    }
    const HitPoint point = data_.hit_point(path.ray, hits[i], false);
    places[i] = {.distance = point.t, .entity_id = point.entity_id};
  }
}

}  // namespace crt::core
