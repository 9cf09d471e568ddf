#include "core/render/next_rays.hpp"

#include "core/math/vector.hpp"
#include "core/render/behind_surfaces.hpp"
#include "core/shading/fresnel.hpp"

namespace crt::core {

namespace {

/// A sample follows no more rays than this: where every hit sends two full-weight rays on, a deep
/// recursion would not end in a lifetime. With weights that add up to 1 it is never reached.
constexpr int most_rays_per_sample = 65536;

/// A Branch is the rays of a group that go on in one way.
struct Branch {
  RayMask rays = 0;
  VectorLanes directions;
  VectorLanes weights;
};

/// A Split is all rays that surfaces of a group send on.
struct Split {
  Branch mirrored;
  Branch refracted;
  std::array<MediaLists::List, lane_count> media_behind;
};

/// Keeps directions on a side of the faces. A bump may send a ray to the wrong side, and it then
/// bounces off the face once more.
VectorLanes kept_on_side(const VectorLanes& direction, const VectorLanes& side) {
  return select(dot(direction, side) < 0.0, mirrored(direction, side), direction);
}

/// Finds the rays that go on from some of a group of surfaces.
Split split(TraceContext& context, const PathRays& rays, const PathHits& hits,
            const Surfaces& surfaces, std::size_t group, RayMask some) {
  Split split;
  const SurfaceGroup& from = surfaces.groups[group];
  const VectorLanes& view = from.phong.view;
  const VectorLanes& normal = from.phong.normal;
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

/// Puts the rays that some of a group of surfaces send on onto their samples' stacks, that which
/// goes through a surface last. Returns which samples got any.
RayMask send_on(TraceContext& context, const PathRays& rays, const PathHits& hits,
                const Surfaces& surfaces, std::size_t group, RayMask some) {
  const Split parts = split(context, rays, hits, surfaces, group, some);
  RayMask sent = 0;
  for_each_ray(some, [&](std::size_t lane) {
    const std::size_t ray = group * lane_count + lane;
    const SurfaceLane from = surfaces.of(ray);
    const PathState& state = rays.states[ray];
    SampleWork& work = *rays.works[ray];
    const auto send = [&](const Branch& branch, RayKind kind, MediaLists::List media,
                          std::uint32_t media_mark) {
      if ((branch.rays >> lane & 1u) == 0) return;
      const Rgb weight = branch.weights.lane(lane);
      if (!is_worth_it(context, state, weight, *rays.samples[ray])) return;
      const bool goes_through = kind == RayKind::refraction;
      PathRay& next = work.pending.push();  // Filled in place, which is faster than a copy.
      next.origin = from.position();
      next.direction = branch.directions.lane(lane);
      next.start = goes_through ? from.start_behind() : from.start();
      next.weight = weight;
      next.path = {kind, state.bounces + 1, from.path_length(), media, media_mark};
      sent |= RayMask{1} << lane;
      context.work.stats.media_changes += goes_through && context.data.is_solid(hits.hits[ray]);
    };
    send(parts.mirrored, RayKind::reflection, state.media, state.media_mark);
    send(parts.refracted, RayKind::refraction, parts.media_behind[lane], work.media.mark());
  });
  return sent;
}

/// Takes the last ray from a sample's stack, if there is one, into the next round.
void pop(RenderStats& stats, SampleWork& work, Sample& sample, PathRays& next) {
  PathStack& stack = work.pending;
  if (stack.empty()) return;
  if (work.rays == most_rays_per_sample) {
    ++stats.samples_over_ray_bound;
    for (const PathRay& dropped : stack.all()) sample.dropped += largest_component(dropped.weight);
    stack.clear();
    return;
  }
  const PathRay& last = stack.top();
  const bool is_refracted = last.path.kind == RayKind::refraction;
  ++(is_refracted ? stats.refraction_rays : stats.reflection_rays);
  next.add(last, work, sample);
  work.media.release(last.path.media_mark);
  stack.pop();
}

}  // namespace

void next_rays(TraceContext& context, const PathRays& rays, const PathHits& hits,
               const Surfaces& surfaces, PathRays& next) {
  next.count = 0;
  next.batch.with_starts = 0;
  const Features& features = context.data.features();
  if (!features.reflection && !features.transparency) return;
  for (std::size_t group = 0; group * lane_count < rays.count; ++group) {
    const RayMask some = RayPacket::lanes(surfaces.rays, group) & surfaces.groups[group].sending_on;
    const RayMask sent = some == 0 ? 0 : send_on(context, rays, hits, surfaces, group, some);
    const auto pop_of = [&](std::size_t lane) {
      const std::size_t ray = group * lane_count + lane;
      pop(context.work.stats, *rays.works[ray], *rays.samples[ray], next);
    };
    for_each_ray(sent, pop_of);
    for_each_ray(RayPacket::lanes(rays.all(), group) & ~sent, pop_of);
  }
}

}  // namespace crt::core
