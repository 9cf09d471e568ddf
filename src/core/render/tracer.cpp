#include "core/render/tracer.hpp"

#include <utility>

#include "core/render/next_rays.hpp"
#include "core/render/sample_identity.hpp"
#include "core/render/surface_hit.hpp"

namespace crt::core {

namespace {

MediaLists::List nested(MediaLists& lists, const std::vector<Medium>& outermost_first) {
  MediaLists::List list = MediaLists::empty;
  for (const Medium& medium : outermost_first) list = lists.entered(list, medium);
  return list;
}

/// Adds what the rays see that hit nothing.
void add_background(const PreparedBackground& background, const PathRays& rays, RayMask some) {
  if (some == 0) return;
  // Only to the camera the background may be transparent.
  const bool is_seen_through = rays.are_from_camera();
  PathLight light;
  light.rays = some;
  RayPacket::for_each_group(some, [&](std::size_t group, RayMask lanes) {
    const ColorLanes seen = background.colors(rays.batch.lines[group].direction, lanes);
    const VectorLanes& weights = rays.weights[group];
    light.colors[group] = (is_seen_through ? seen.alpha * weights : weights) * seen.color;
    if (!is_seen_through) return;
    for_each_ray(lanes, [&](std::size_t lane) {
      Lanes& channels = rays.samples[group * lane_count + lane]->channels;
      channels[3] = seen.alpha[static_cast<int>(lane)];
    });
  });
  add(rays.samples, light);
}

/// Says what camera rays have met, also where a medium before it lets no light through.
void report(TraceContext& context, const PathRays& rays, const PathHits& hits,
            const Surfaces& surfaces, std::span<FirstHit> first_hits) {
  SurfaceGroup unseen;
  for (std::size_t i = 0; i < first_hits.size(); ++i) {
    first_hits[i] = {};
    if (!hits.hits[i].found()) continue;
    const std::size_t lane = i % lane_count;
    const bool is_seen = (surfaces.rays >> i & 1u) != 0;
    if (!is_seen) {
      look_up(context.data, rays.batch.lines[i / lane_count], hits.of_group(i / lane_count),
              RayMask{1} << lane, unseen, context.work);
    }
    const SurfaceLane surface = {is_seen ? surfaces.groups[i / lane_count] : unseen, lane};
    first_hits[i] = {.normal = surface.normal(), .color = surface.color()};
  }
}

}  // namespace

Tracer::Tracer(const Frame& frame, Workspace& work, Progress& progress)
    : context_{frame, frame.data(), work, progress} {
  for (SampleWork& sample : work.samples) {
    sample.media.release(0);
    sample.pending.clear();
    // These are the same in every sample's lists.
    camera_state_.media = nested(sample.media, frame.camera_media());
    camera_state_.media_mark = sample.media.mark();
  }
}

void Tracer::trace(std::span<const RayLanes> camera_rays, std::span<Sample> samples,
                   std::span<FirstHit> first_hits) {
  PathRays* rays = &start(camera_rays, samples);
  while (!rays->empty()) {
    PathHits& hits = intersect(context_, *rays, hits_);
    absorb(context_, *rays, hits);
    const Surfaces& surfaces = surfaces_of(context_, *rays, hits, surfaces_);
    report(context_, *rays, hits, surfaces, std::exchange(first_hits, {}));
    if (context_.identifies) identify_hits(context_.data, *rays, hits, surfaces);
    add_background(context_.data.background(), *rays, hits.on_background);
    add(rays->samples, direct_light(context_, *rays, surfaces, shadow_rays_));
    rays = &next_rays(context_, *rays, hits, surfaces, rays == &rays_[0] ? rays_[1] : rays_[0]);
  }
}

void Tracer::look(std::span<const RayLanes> camera_rays, std::span<FirstPlace> places) {
  PathRays& rays = rays_[0];
  rays.count = places.size();
  Frame::set_camera_rays(camera_rays, rays.batch);
  const PathHits& hits = intersect(context_, rays, hits_);
  for (std::size_t i = 0; i < places.size(); ++i) {
    places[i] = {};
    if (!hits.hits[i].found()) continue;
    HitPoint point;
    context_.data.hit_point(rays.batch.ray(i), hits.hits[i], false, point);
    places[i] = {.distance = point.t, .entity_id = point.entity_id};
  }
}

PathRays& Tracer::start(std::span<const RayLanes> camera_rays, std::span<Sample> samples) {
  PathRays& rays = rays_[0];
  rays.count = samples.size();
  rays.waiting = 0;
  Frame::set_camera_rays(camera_rays, rays.batch);
  rays.weights.fill(lanes_of(Rgb(1)));
  for (std::size_t i = 0; i < rays.count; ++i) {
    samples[i] = {};
    rays.samples[i] = &samples[i];
    rays.works[i] = &context_.work.samples[i];
    rays.works[i]->rays = 1;
    rays.states[i] = camera_state_;
    if (context_.data.features().transparency) surround(rays, i);
  }
  context_.work.stats.camera_rays += rays.count;
  return rays;
}

void Tracer::surround(PathRays& rays, std::size_t ray) {
  MediaLists& lists = rays.works[ray]->media;
  PathState& state = rays.states[ray];
  lists.release(camera_state_.media_mark);
  if (context_.frame.one_viewpoint()) return;
  std::vector<Medium>& surrounding = context_.work.surrounding;
  find_surrounding_media(context_.data, rays.batch.ray(ray), surrounding, context_.work);
  state.media = nested(lists, surrounding);
  state.media_mark = lists.mark();
}

}  // namespace crt::core
