#include "core/render/tracer.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "core/base/invalid_index.hpp"
#include "core/render/found_light.hpp"
#include "core/render/next_rays.hpp"
#include "core/render/sample_identity.hpp"

namespace crt::core {

namespace {

MediaLists::List nested(MediaLists& lists, const std::vector<Medium>& outermost_first) {
  MediaLists::List list = MediaLists::empty;
  for (const Medium& medium : outermost_first) list = lists.entered(list, medium);
  return list;
}

/// Lets light that has come by diffuse bounces count no more than the settings say.
void clamp_bounced(const TraceContext& context, const PathRays& rays, PathLight& light) {
  const Settings& settings = context.frame.settings();
  if (settings.clamp <= 0 || settings.indirect == 0) return;
  const VectorLanes most = lanes_of(Rgb(settings.clamp));
  RayPacket::for_each_group(light.rays & rays.after_diffuse(),
                            [&](std::size_t group, RayMask lanes) {
                              VectorLanes& colors = light.colors[group];
                              colors = select(lanes_with(lanes), min(colors, most), colors);
                            });
}

/// Adds the sun of a sky to what rays see of it. Surfaces that draw directions, and diffuse ones,
/// have taken samples of it as of other lights, through clear glass as well.
void add_sun(const Sky& sky, const PathRays& rays, PathLight& light) {
  const RayMask some = light.rays & ~rays.after_scattering();
  RayPacket::for_each_group(some, [&](std::size_t group, RayMask lanes) {
    const VectorLanes sun = sky.sun(rays.batch.lines[group].direction);
    VectorLanes& colors = light.colors[group];
    colors = select(lanes_with(lanes), colors + rays.weights[group] * sun, colors);
  });
}

/// Adds what the rays see that hit nothing. Only to the camera the background may be transparent.
/// After a diffuse bounce it is there only as far as it is a light.
void add_background(const TraceContext& context, const PathRays& rays, const PathHits& hits) {
  const bool is_seen_through = rays.are_from_camera();
  const PreparedLight* const environment = context.frame.environment();
  PathLight light{.rays = hits.on_background(), .colors = {}};
  RayMask bounced = context.frame.settings().indirect > 0 ? rays.after_diffuse() : 0;
  if (environment == nullptr) {
    light.rays &= ~std::exchange(bounced, 0);
  } else if (context.data.features().principled) {
    bounced |= rays.drawn();
  }
  RayPacket::for_each_group(light.rays, [&](std::size_t group, RayMask lanes) {
    const ColorLanes seen =
        context.data.background().colors(rays.batch.lines[group].direction, lanes);
    const VectorLanes& weights = rays.weights[group];
    VectorLanes& colors = light.colors[group];
    colors = (is_seen_through ? seen.alpha * weights : weights) * seen.color;
    if (const RayMask some = RayPacket::lanes(bounced, group) & lanes; some != 0) {
      const Lanes shares =
          shares_of_rays(context, rays, group, *environment, invalid_index, Lanes{});
      const VectorLanes lit = shares * lanes_of(environment->color()) * colors;
      colors = select(lanes_with(some), lit, colors);
    }
    if (!is_seen_through) return;
    for_each_ray(lanes, [&](std::size_t lane) {
      Lanes& channels = rays.samples[group * lane_count + lane]->channels;
      channels[3] = seen.alpha[lane];
    });
  });
  const Sky* const sky = context.data.background().sky();
  if (sky != nullptr && sky->has_sun()) add_sun(*sky, rays, light);
  clamp_bounced(context, rays, light);
  add(rays.samples, light);
}

/// Adds the lights that rays end at.
void add_visible_lights(const TraceContext& context, const PathRays& rays, const PathHits& hits) {
  PathLight light{.rays = hits.seen & hits.on_light, .colors = {}};
  for_each_ray(light.rays, [&](std::size_t i) {
    const Rgb color = context.frame.lights()[hits.lights[i]].color();
    const std::size_t group = i / lane_count;
    light.colors[group].set(i % lane_count, rays.weights[group].lane(i % lane_count) * color);
  });
  clamp_bounced(context, rays, light);
  add(rays.samples, light);
}

/// Adds the lights that drawn rays find on their way. `hits` are those of the surfaces behind.
void add_lights_on_way(const TraceContext& context, const PathRays& rays, const PathHits& hits) {
  PathLight light{};
  for_each_light_met(
      context, rays, rays.drawn(), hits,
      [&](std::uint32_t number, std::size_t group, RayMask lanes, const Lanes& t) {
        const PreparedLight& source = context.frame.lights()[number];
        const Lanes shares =
            shares_of_rays(context, rays, group, source, context.frame.number_of_chosen(number), t);
        for_each_ray(lanes, [&](std::size_t lane) {
          const std::size_t ray = group * lane_count + lane;
          const Rgb weight = weight_after(context, rays, ray, t[lane]);
          light.colors[group].set(
              lane, light.colors[group].lane(lane) + shares[lane] * (weight * source.color()));
          light.rays |= RayMask{1} << ray;
        });
      });
  clamp_bounced(context, rays, light);
  add(rays.samples, light);
}

/// Writes down what camera rays have met, also where a medium before it lets no light through.
void report(const PathRays& rays, const PathHits& hits, const Surfaces& surfaces,
            std::span<FirstHit> first_hits) {
  for (std::size_t i = 0; i < first_hits.size(); ++i) {
    first_hits[i] = {};
    if (!hits.hits[i].found()) continue;
    const SurfaceLane surface = surfaces.of(i);
    const Vec3 way = surface.position() - rays.batch.ray(i).origin;
    constexpr double least_distance = 0x1p-100;
    first_hits[i] = {.normal = surface.normal(),
                     .color = surface.color(),
                     .cover = 1,
                     .nearness = 1 / std::max(least_distance, glm::length(way))};
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
                   std::span<const SampleId> ids, std::span<FirstHit> first_hits) {
  PathRays* rays = &start(camera_rays, samples, ids);
  PathRays* next = &rays_[1];
  while (!rays->empty()) {
    PathHits& hits = intersect(context_, *rays, hits_);
    if (context_.frame.shows_lights()) {
      add_lights_on_way(context_, *rays, hits);
      meet_lights(context_, *rays, hits);
    }
    absorb(context_, *rays, hits);
    const Surfaces& surfaces = surfaces_of(context_, *rays, hits, !first_hits.empty(), surfaces_);
    report(*rays, hits, surfaces, std::exchange(first_hits, {}));
    if (context_.data.features().unseen) enter_unseen_media(*rays, surfaces);
    if (context_.identifies) identify_hits(context_.data, *rays, hits);
    add_background(context_, *rays, hits);
    if (hits.on_light != 0) add_visible_lights(context_, *rays, hits);
    PathLight light = direct_light(context_, *rays, surfaces, shadow_rays_);
    clamp_bounced(context_, *rays, light);
    add(rays->samples, light);
    next_rays(context_, *rays, hits, surfaces, *next);
    std::swap(rays, next);
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
    places[i] = {.distance = point.t,
                 .entity_id = point.entity_id,
                 .part_id = context_.data.ids(hits.hits[i]).part};
  }
}

PathRays& Tracer::start(std::span<const RayLanes> camera_rays, std::span<Sample> samples,
                        std::span<const SampleId> ids) {
  PathRays& rays = rays_[0];
  rays.count = samples.size();
  Frame::set_camera_rays(camera_rays, rays.batch);
  rays.weights.fill(lanes_of(Rgb(1)));
  for (std::size_t i = 0; i < rays.count; ++i) {
    samples[i] = {};
    rays.samples[i] = &samples[i];
    rays.works[i] = &context_.work.samples[i];
    rays.works[i]->rays = 1;
    rays.works[i]->id = ids.empty() ? SampleId{} : ids[i];
    rays.states[i] = camera_state_;
  }
  if (context_.data.features().transparency) start_media(rays);
  context_.work.stats.camera_rays += rays.count;
  return rays;
}

void Tracer::start_media(PathRays& rays) {
  std::vector<Medium>& surrounding = context_.work.surrounding;
  for (std::size_t i = 0; i < rays.count; ++i) {
    MediaLists& lists = rays.works[i]->media;
    lists.release(camera_state_.media_mark);
    if (context_.frame.one_viewpoint()) continue;
    find_surrounding_media(context_.data, rays.batch.ray(i), passing_camera, surrounding,
                           context_.work);
    rays.states[i].media = nested(lists, surrounding);
    rays.states[i].media_mark = lists.mark();
  }
}

void Tracer::enter_unseen_media(PathRays& rays, const Surfaces& surfaces) {
  const PreparedData& data = context_.data;
  if (!rays.are_from_camera() || !data.features().transparency) return;
  std::vector<Medium>& surrounding = context_.work.surrounding;
  for_each_ray(surfaces.rays, [&](std::size_t i) {
    const SurfaceLane from = surfaces.of(i);
    const WorldRay back{
        .origin = from.position(), .direction = -rays.batch.direction(i), .start = from.start()};
    find_surrounding_media(data, back, passing_none, surrounding, context_.work);
    const bool any_unseen = std::any_of(
        surrounding.begin(), surrounding.end(),
        [&](const Medium& medium) { return data.is_passed(medium.object, passing_camera); });
    if (!any_unseen) return;
    MediaLists& lists = rays.works[i]->media;
    rays.states[i].media = nested(lists, surrounding);
    rays.states[i].media_mark = lists.mark();
  });
}

}  // namespace crt::core
