#include "core/render/next_rays.hpp"

#include <tuple>

#include "core/math/vector.hpp"
#include "core/render/behind_surfaces.hpp"
#include "core/shading/fresnel.hpp"

namespace crt::core {

namespace {

/// A sample follows no more rays than this: where every hit sends two full-weight rays on, a deep
/// recursion would not end in a lifetime. With weights that add up to 1 it is never reached.
constexpr int most_rays_per_sample = 65536;

/// Those rays of a group that go on in one way.
struct Branch {
  RayMask rays = 0;
  VectorLanes directions;
  VectorLanes weights;
};

/// The rays that surfaces of a group send on.
struct Split {
  Branch mirrored;
  Branch refracted;
  std::array<MediaLists::List, lane_count> media_behind;
};

/// Keeps directions on a side of the faces. A bump may send a ray to the wrong side, and it then
/// bounces off the face once more.
VectorLanes kept_on_side(const VectorLanes& direction, const VectorLanes& side) {
  return chosen(dot(direction, side) < 0.0, mirrored(direction, side), direction);
}

/// Finds the rays that go on from some of a group of surfaces.
Split split(TraceContext& context, const PathRays& rays, const PathHits& hits,
            const Surfaces& surfaces, std::size_t group, RayMask some) {
  Split split;
  const SurfaceGroup& from = surfaces.groups[group];
  const auto& [view, normal] = std::tie(from.phong.view, from.phong.normal);
  const VectorLanes& weights = rays.weights[group];
  Lanes mirrored_share = from.reflectivity;
  const RayMask transparent = some & mask_of(from.transparency > 0.0);
  if (transparent != 0) {
    const Behind behind = behind_surfaces(context, rays, hits, surfaces, group, transparent);
    const auto refraction = refract(view, normal, behind.index_before, behind.index_behind);
    mirrored_share += behind.transparency * refraction.reflectance;
    Branch& through = split.refracted;
    through.weights = bounded_share(behind.transparency * (1.0 - refraction.reflectance) * weights *
                                    behind.color);
    through.directions = kept_on_side(refraction.direction, -from.face_normal);
    through.rays = transparent & ~mask_of(is_black(through.weights));
    split.media_behind = behind.media;
  }
  split.mirrored = {.rays = some & mask_of(mirrored_share > 0.0),
                    .directions = kept_on_side(mirrored(view, normal), from.face_normal),
                    .weights = mirrored_share * weights};
  return split;
}

/// Asks whether a ray of such a weight is worth following after another one. If it is not, it
/// counts as dropped, with the most that it may weigh after all that brightens light behind it.
bool is_worth_it(TraceContext& context, const PathState& before, const Rgb& weight,
                 Sample& sample) {
  const Settings& settings = context.frame.settings();
  const bool is_brightened = context.data.features().gain != 1;
  const Rgb most = is_brightened ? context.frame.gain_behind(before.bounces) * weight : weight;
  const double least = settings.min_weight;
  const bool is_weak = most.x < least && most.y < least && most.z < least;
  if (!is_weak && before.bounces < settings.recursion_depth) return true;
  RenderStats& stats = context.work.stats;
  ++(is_weak ? stats.rays_below_min_weight : stats.rays_beyond_depth);
  sample.dropped += largest_component(most);
  return false;
}

/// Lets a sample follow a ray in the next round.
void follow(RenderStats& stats, const PathRay& ray, SampleWork& work, Sample& sample,
            PathRays& next) {
  ++(ray.path.kind == RayKind::reflection ? stats.reflection_rays : stats.refraction_rays);
  next.add(ray, work, sample);
}

/// Sends on what goes on from the surface that a ray meets. Returns whether the next round has a
/// ray of it.
bool send_on(TraceContext& context, const PathRays& rays, const RayHit& hit,
             const SurfaceLane& from, std::size_t ray, const Split& split, PathRays& next) {
  RenderStats& stats = context.work.stats;
  const PathState& state = rays.states[ray];
  SampleWork& work = *rays.works[ray];
  Sample& sample = *rays.samples[ray];
  const auto has = [&](const Branch& branch) {
    return (branch.rays >> from.lane & 1u) != 0 &&
           is_worth_it(context, state, branch.weights.lane(from.lane), sample);
  };
  const auto send = [&](const Branch& branch, const StartPoint& start, bool waits, RayKind kind,
                        MediaLists::List media, std::uint32_t media_mark) {
    const PathRay sent = {
        .origin = from.position(),
        .direction = branch.directions.lane(from.lane),
        .start = start,
        .weight = branch.weights.lane(from.lane),
        .path = {kind, state.bounces + 1, from.path_length(), media, media_mark},
    };
    if (!waits) return follow(stats, sent, work, sample, next);
    work.pending.push() = sent;
    ++next.waiting;
  };
  const bool is_mirrored = has(split.mirrored);
  const bool is_refracted = has(split.refracted);
  const bool waits = work.rays == most_rays_per_sample;
  // What goes through is followed first. Media lists made for it are dropped before the other's
  // turn.
  if (is_mirrored) {
    if (!is_refracted) work.media.release(state.media_mark);
    send(split.mirrored, from.start(), waits || is_refracted, RayKind::reflection, state.media,
         state.media_mark);
  }
  if (is_refracted) {
    stats.media_changes += context.data.is_solid(hit) ? 1 : 0;
    send(split.refracted, from.start_behind(), waits, RayKind::refraction,
         split.media_behind[from.lane], work.media.mark());
  }
  return !waits && (is_mirrored || is_refracted);
}

/// Takes up the last ray that waits of a sample.
void pop(RenderStats& stats, SampleWork& work, Sample& sample, PathRays& next) {
  if (work.rays == most_rays_per_sample) {
    ++stats.samples_over_ray_bound;
    for (const PathRay& dropped : work.pending.all()) {
      sample.dropped += largest_component(dropped.weight);
    }
    next.waiting -= work.pending.all().size();
    work.pending.clear();
    return;
  }
  const PathRay& last = work.pending.top();
  follow(stats, last, work, sample, next);
  work.media.release(last.path.media_mark);
  work.pending.pop();
  --next.waiting;
}

}  // namespace

PathRays& next_rays(TraceContext& context, const PathRays& rays, const PathHits& hits,
                    const Surfaces& surfaces, PathRays& next) {
  RenderStats& stats = context.work.stats;
  next.clear();
  next.waiting = rays.waiting;
  for (std::size_t group = 0; group * lane_count < rays.count; ++group) {
    RayMask done = RayPacket::lanes(rays.all(), group);
    const SurfaceGroup& from = surfaces.groups[group];
    const RayMask splitting = RayPacket::lanes(surfaces.rays, group) & from.sending_on;
    if (splitting != 0) {
      const Split parts = split(context, rays, hits, surfaces, group, splitting);
      for_each_ray(splitting, [&](std::size_t lane) {
        const std::size_t ray = group * lane_count + lane;
        const bool goes_on = send_on(context, rays, hits.hits[ray], {from, lane}, ray, parts, next);
        done &= ~(static_cast<RayMask>(goes_on) << lane);
      });
    }
    if (next.waiting == 0) continue;
    for_each_ray(done, [&](std::size_t lane) {
      const std::size_t ray = group * lane_count + lane;
      SampleWork& work = *rays.works[ray];
      if (!work.pending.empty()) pop(stats, work, *rays.samples[ray], next);
    });
  }
  return next;
}

}  // namespace crt::core
