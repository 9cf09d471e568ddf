#include "core/render/next_rays.hpp"

#include <bit>

#include "core/math/vector.hpp"
#include "core/render/behind_surfaces.hpp"
#include "core/shading/fresnel.hpp"

namespace crt::core {

namespace {

/// A sample follows no more rays than this: where every hit sends two full-weight rays on, a deep
/// recursion would not end in a lifetime. With weights that add up to 1 it is never reached.
constexpr int most_rays_per_sample = 65536;

/// Those of a group's rays that go on by one kind.
struct Branch {
  RayMask rays = 0;
  VectorLanes directions;
  VectorLanes weights;
};

/// The rays that go on from a group of surfaces.
struct Split {
  Branch mirrored;
  Branch refracted;
  std::array<MediaLists::List, lane_count> media_behind;
  std::array<std::uint32_t, lane_count> media_marks;  ///< before lists were made of those
};

/// Keeps directions on a side of the faces. A bump may send a ray to the wrong side, and it then
/// bounces off the face once more.
VectorLanes kept_on_side(const VectorLanes& direction, const VectorLanes& side) {
  return chosen(dot(direction, side) < 0.0, mirrored(direction, side), direction);
}

LaneMask is_weaker(const VectorLanes& weight, double least) {
  return (weight.x < least) & (weight.y < least) & (weight.z < least);
}

/// Returns what rays may weigh after all that brightens light on their further paths. (In place,
/// its memory on the stack would cost the scenes where nothing does.)
[[gnu::noinline]] VectorLanes most_weights(const Frame& frame, const PathState* states,
                                           const VectorLanes& weights) {
  Lanes gains{};
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    gains[static_cast<int>(lane)] = frame.gain_behind(states[lane].bounces);
  }
  return gains * weights;
}

/// Returns the rays that are worth following by the most that they may weigh, and counts the others
/// as dropped. Some are too deep.
inline RayMask heavy_enough(TraceContext& context, Sample* const* samples, RayMask some,
                            RayMask deep, const VectorLanes& most) {
  const RayMask weak = some & mask_of(is_weaker(most, context.frame.settings().min_weight));
  deep &= some & ~weak;
  const RayMask dropped = weak | deep;
  if (dropped == 0) return some;
  context.work.stats.rays_below_min_weight += static_cast<unsigned>(std::popcount(weak));
  context.work.stats.rays_beyond_depth += static_cast<unsigned>(std::popcount(deep));
  for_each_ray(dropped, [&](std::size_t lane) {
    samples[lane]->dropped += largest_component(most.lane(lane));
  });
  return some & ~dropped;
}

/// Returns those of some rays of a group that are worth following.
RayMask worth_it(TraceContext& context, const PathRays& rays, std::size_t group, RayMask some,
                 RayMask deep, const VectorLanes& weights) {
  Sample* const* const samples = &rays.samples[group * lane_count];
  if (context.data.features().gain == 1) {
    return heavy_enough(context, samples, some, deep, weights);
  }
  const PathState* const states = &rays.states[group * lane_count];
  return heavy_enough(context, samples, some, deep, most_weights(context.frame, states, weights));
}

/// Finds the rays that go on from some of a group of surfaces.
Split split(TraceContext& context, const PathRays& rays, const PathHits& hits,
            const Surfaces& surfaces, std::size_t group, RayMask lanes) {
  Split split;
  const SurfaceGroup& at_group = surfaces.groups[group];
  const PhongSurfaces& phong = at_group.phong;
  const VectorLanes& weights = rays.weights[group];
  RayMask deep = 0;
  for_each_ray(lanes, [&](std::size_t lane) {
    const std::size_t ray = group * lane_count + lane;
    const bool is_deep = rays.states[ray].bounces >= context.frame.settings().recursion_depth;
    deep |= static_cast<RayMask>(is_deep) << lane;
    split.media_marks[lane] = rays.works[ray]->media.mark();
  });

  Branch& through = split.refracted;
  Lanes mirrored_share = at_group.reflectivity;
  RayMask transparent = lanes & mask_of(at_group.transparency > 0.0);
  RayMask into_volumes = 0;
  if (transparent != 0) {
    const Behind behind = behind_surfaces(context, rays, hits, surfaces, group, transparent);
    const auto refraction =
        refract(phong.view, phong.normal, behind.index_before, behind.index_behind);
    mirrored_share += behind.transparency * refraction.reflectance;
    through.weights = bounded_share(behind.transparency * (1.0 - refraction.reflectance) * weights *
                                    behind.color);
    through.directions = kept_on_side(refraction.direction, -at_group.face_normal);
    split.media_behind = behind.media;
    into_volumes = behind.into_volumes;
  }
  Branch& back = split.mirrored;
  back.weights = mirrored_share * weights;
  back.directions = kept_on_side(mirrored(phong.view, phong.normal), at_group.face_normal);
  back.rays =
      worth_it(context, rays, group, lanes & mask_of(mirrored_share > 0.0), deep, back.weights);
  transparent &= ~mask_of(is_black(through.weights));
  through.rays = worth_it(context, rays, group, transparent, deep, through.weights);
  context.work.stats.media_changes +=
      static_cast<unsigned>(std::popcount(through.rays & into_volumes));
  return split;
}

/// Lets a sample follow a ray in the next round.
void follow(RenderStats& stats, const PathRay& ray, SampleWork& work, Sample& sample,
            PathRays& next) {
  ++(ray.path.kind == RayKind::reflection ? stats.reflection_rays : stats.refraction_rays);
  next.add(ray, work, sample);
}

/// Sends the rays of a group on. Returns which samples have one of them in the next round.
RayMask send_on(RenderStats& stats, const PathRays& rays, const Surfaces& surfaces,
                std::size_t group, const Split& split, PathRays& next) {
  RayMask followed = 0;
  // What goes through is followed first. Media lists made for it are dropped before the other's
  // turn.
  for_each_ray(split.mirrored.rays | split.refracted.rays, [&](std::size_t lane) {
    const std::size_t ray = group * lane_count + lane;
    const SurfaceLane from = surfaces.of(ray);
    const PathState& state = rays.states[ray];
    SampleWork& work = *rays.works[ray];
    const auto send = [&](const Branch& branch, bool waits, RayKind kind, const StartPoint& start,
                          MediaLists::List media, std::uint32_t media_mark) {
      const PathRay sent = {.origin = from.position(),
                            .direction = branch.directions.lane(lane),
                            .start = start,
                            .weight = branch.weights.lane(lane),
                            .path = {.kind = kind,
                                     .bounces = state.bounces + 1,
                                     .path_length = from.path_length(),
                                     .media = media,
                                     .media_mark = media_mark}};
      if (waits) {
        work.pending.push() = sent;
        ++next.waiting;
      } else {
        follow(stats, sent, work, *rays.samples[ray], next);
      }
    };
    const bool goes_through = (split.refracted.rays >> lane & 1u) != 0;
    const bool waits = work.rays == most_rays_per_sample;
    if ((split.mirrored.rays >> lane & 1u) != 0) {
      const std::uint32_t mark = split.media_marks[lane];
      send(split.mirrored, waits || goes_through, RayKind::reflection, from.start(), state.media,
           mark);
      if (!goes_through) work.media.release(mark);
    }
    if (goes_through) {
      send(split.refracted, waits, RayKind::refraction, from.start_behind(),
           split.media_behind[lane], work.media.mark());
    }
    followed |= static_cast<RayMask>(!waits) << lane;
  });
  return followed;
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
    RayMask followed = 0;
    const RayMask on_surface = RayPacket::lanes(surfaces.rays, group);
    const RayMask splitting = on_surface & surfaces.groups[group].sending_on;
    if (splitting != 0) {
      followed = send_on(stats, rays, surfaces, group,
                         split(context, rays, hits, surfaces, group, splitting), next);
    }
    if (next.waiting == 0) continue;
    for_each_ray(RayPacket::lanes(rays.all(), group) & ~followed, [&](std::size_t lane) {
      const std::size_t ray = group * lane_count + lane;
      SampleWork& work = *rays.works[ray];
      if (!work.pending.empty()) pop(stats, work, *rays.samples[ray], next);
    });
  }
  return next;
}

}  // namespace crt::core
