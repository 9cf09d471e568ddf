#include "core/render/path_hits.hpp"

#include <limits>

#include "core/render/surface_hit.hpp"

namespace crt::core {

namespace {

/// Of the surfaces at the place of a ray's first hit the one that is seen.
RayHit seen_hit(TraceContext& context, const WorldRay& ray) {
  Workspace& work = context.work;
  RayHit seen = context.data.intersect(ray, work.rays);
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
  data.intersect_each(rays.batch, rays.all(), hits.hits, context.work.rays);
  data.prefetch_points(hits.hits, rays.all());
  hits.on_surface = 0;
  for (std::size_t i = 0; i < rays.count; ++i) {
    RayHit& hit = hits.hits[i];
    if (hit.has_coincident && data.features().transparency) {
      hit = seen_hit(context, rays.batch.ray(i));
    }
    hits.on_surface |= static_cast<RayMask>(hit.found()) << i;
  }
  hits.on_background = rays.all() & ~hits.on_surface;
  return hits;
}

void absorb(const TraceContext& context, PathRays& rays, PathHits& hits) {
  if (!context.data.features().absorption) return;
  for_each_ray(rays.all(), [&](std::size_t i) {
    const MediaLists::List media = rays.states[i].media;
    if (media == MediaLists::empty) return;
    const Medium& medium = rays.works[i]->media.innermost(media);
    VectorLanes& weights = rays.weights[i / lane_count];
    const Rgb left = weights.lane(i % lane_count) *
                     transmittance(context.data.materials()[medium.material], hits.hits[i].t);
    weights.set(i % lane_count, left);
    if (!is_black(left)) return;
    hits.on_surface &= ~(RayMask{1} << i);
    hits.on_background &= ~(RayMask{1} << i);
  });
}

const Surfaces& surfaces_of(TraceContext& context, const PathRays& rays, const PathHits& hits,
                            Surfaces& surfaces) {
  surfaces.rays = hits.on_surface;
  RayPacket::for_each_group(hits.on_surface, [&](std::size_t i, RayMask lanes) {
    SurfaceGroup& group = surfaces.groups[i];
    look_up(context.data, rays.batch.lines[i], hits.of_group(i), lanes, group, context.work);
    for (int lane = 0; lane < lane_count; ++lane) {
      const auto ray = i * lane_count + static_cast<std::size_t>(lane);
      group.path_length[lane] = rays.states[ray].path_length + hits.hits[ray].t;
    }
  });
  return surfaces;
}

}  // namespace crt::core
