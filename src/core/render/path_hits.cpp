#include "core/render/path_hits.hpp"

#include <limits>

#include "core/render/surface_hit.hpp"

namespace crt::core {

namespace {

/// Returns the hit of that surface which is seen of several at the place of a ray's first hit.
RayHit seen_hit(TraceContext& context, const WorldRay& ray, PassingRays kind) {
  Workspace& work = context.work;
  RayHit seen = context.data.intersect(ray, work.rays, kind);
  double least = std::numeric_limits<double>::infinity();
  for (const RayHit& crossing : work.rays.here) {
    const double transparency =
        crossing_filter(context.data, ray, crossing, work.stats).transparency;
    if (!(transparency < least)) continue;
    least = transparency;
    seen = crossing;
  }
  seen.has_coincident = true;
  return seen;
}

}  // namespace

PathHits& intersect(TraceContext& context, const PathRays& rays, PathHits& hits) {
  const PreparedData& data = context.data;
  context.count_rays(static_cast<unsigned>(rays.count));
  const PassingRays kind = rays.passing();
  data.intersect_each(rays.batch, rays.all(), hits.hits, context.work.rays, Packets::where_they_pay,
                      kind);
  data.prefetch_points(hits.hits, rays.all());
  hits.found = 0;
  hits.on_light = 0;
  hits.seen = rays.all();
  for (std::size_t i = 0; i < rays.count; ++i) {
    RayHit& hit = hits.hits[i];
    if (hit.has_coincident && data.features().transparency) {
      hit = seen_hit(context, rays.batch.ray(i), kind);
    }
    hits.found |= mask_of(hit.found()) << i;
  }
  return hits;
}

void meet_lights(const TraceContext& context, const PathRays& rays, PathHits& hits) {
  for_each_light_met(context, rays, rays.all() & ~rays.drawn(), hits,
                     [&](std::uint32_t number, std::size_t group, RayMask lanes, const Lanes& t) {
                       for_each_ray(lanes, [&](std::size_t lane) {
                         const std::size_t ray = group * lane_count + lane;
                         hits.hits[ray] = {.t = t[lane]};
                         hits.lights[ray] = number;
                         hits.on_light |= RayMask{1} << ray;
                       });
                     });
  hits.found &= ~hits.on_light;
}

Rgb weight_after(const TraceContext& context, const PathRays& rays, std::size_t i, double t) {
  const Rgb weight = rays.weights[i / lane_count].lane(i % lane_count);
  if (rays.states[i].media == MediaLists::empty) return weight;
  const Medium& medium = rays.works[i]->media.innermost(rays.states[i].media);
  return weight * transmittance(context.data.materials()[medium.material], t);
}

void absorb(const TraceContext& context, PathRays& rays, PathHits& hits) {
  if (!context.data.features().absorption) return;
  for_each_ray(rays.in_media(), [&](std::size_t i) {
    const Rgb left = weight_after(context, rays, i, hits.hits[i].t);
    rays.weights[i / lane_count].set(i % lane_count, left);
    if (is_black(left)) hits.seen &= ~(RayMask{1} << i);
  });
}

const Surfaces& surfaces_of(TraceContext& context, const PathRays& rays, const PathHits& hits,
                            bool with_unseen, Surfaces& surfaces) {
  surfaces.rays = hits.on_surface();
  const RayMask some = with_unseen ? hits.found : surfaces.rays;
  RayPacket::for_each_group(some, [&](std::size_t i, RayMask lanes) {
    SurfaceGroup& group = surfaces.groups[i];
    const std::size_t first = i * lane_count;
    const auto of_group = std::span(hits.hits).subspan(first).first<lane_count>();
    look_up(context.data, rays.batch.lines[i], of_group, lanes, group, context.work);
    const PathState* const states = &rays.states[first];
    group.path_length =
        Lanes([&](auto lane) { return states[lane].path_length + of_group[lane].t; });
  });
  return surfaces;
}

}  // namespace crt::core
