// These parts of the tracer look at first hits alone.
#include "core/render/first_hit.hpp"

#include "core/render/tracer.hpp"

namespace crt::core {

void Tracer::tell_first_hits(std::span<FirstHit> first_hits) {
  for (std::size_t i = 0; i < first_hits.size(); ++i) {
    first_hits[i] = {};
    if (!hits_[i].found()) continue;
    // Behind a medium that lets nothing through the surface has not been looked up.
    if (is_black(weight(i))) look_up_each(RayMask{1} << i);
    first_hits[i] = {.normal = surface(i).normal(), .color = surface(i).color()};
  }
}

void Tracer::look(std::span<const RayLanes> camera_rays, std::span<FirstPlace> places) {
  RayBatch& rays = round_->rays;
  Frame::set_camera_rays(camera_rays, rays);
  tick(static_cast<unsigned>(places.size()));
  data_.intersect_each(rays, RayPacket::all(places.size()), hits_, work_.rays);
  for (std::size_t i = 0; i < places.size(); ++i) {
    RayHit& hit = hits_[i];
    places[i] = {};
    if (!hit.found()) continue;
    const WorldRay ray = rays.ray(i);
    if (hit.has_coincident && frame_.features().transparency) hit = seen_of(ray);
    HitPoint point;
    data_.hit_point(ray, hit, false, point);
    places[i] = {.distance = point.t, .entity_id = point.entity_id};
  }
}

}  // namespace crt::core
