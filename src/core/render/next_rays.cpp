#include "core/render/next_rays.hpp"

#include <numbers>

#include "core/geometry/angles.hpp"
#include "core/math/vector.hpp"
#include "core/render/behind_surfaces.hpp"
#include "core/shading/fresnel.hpp"

namespace crt::core {

namespace {

/// A sample follows no more rays than this: where every hit sends two full-weight rays on, a deep
/// recursion would not end in a lifetime. With weights that add up to 1 it is never reached.
constexpr int max_rays_per_sample = 65536;

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
  Branch diffuse;
  Lanes diffuse_densities{};
  std::array<MediaLists::List, lane_count> media_behind;
};

/// Keeps directions on a side of the faces. A bump may send a ray to the wrong side, and it then
/// bounces off the face once more.
VectorLanes kept_on_side(const VectorLanes& direction, const VectorLanes& side) {
  return select(dot(direction, side) < 0.0, mirrored(direction, side), direction);
}

/// Returns rays that some of a group of surfaces send on as they send diffuse light back: in random
/// directions, most of them near the normal. The cosine in their density leaves a weight of the
/// surface's diffuse colour.
Branch diffuse_rays(const TraceContext& context, const PathRays& rays, const SurfaceGroup& from,
                    std::size_t group, RayMask some, Lanes& densities) {
  const Settings& settings = context.frame.settings();
  Branch branch;
  for_each_ray(some & mask_of(from.phong.diffuse > 0.0), [&](std::size_t lane) {
    const std::size_t ray = group * lane_count + lane;
    if (rays.states[ray].diffuse_bounces < settings.indirect) branch.rays |= RayMask{1} << lane;
  });
  if (branch.rays == 0) return branch;
  Lanes u;
  Lanes v;
  for_each_ray(branch.rays, [&](std::size_t lane) {
    const SampleWork& work = *rays.works[group * lane_count + lane];
    const auto numbers =
        sample_numbers(settings.seed, work.id,
                       {static_cast<std::uint32_t>(work.rays), SampleDecision::diffuse_direction});
    u[lane] = numbers[0];
    v[lane] = numbers[1];
  });
  const auto [x, y] = point_of_disc(u, v);
  const Lanes upwards = sqrt(max(Lanes{}, 1.0 - x * x - y * y));
  const VectorLanes& normal = from.phong.normal;
  const auto [a, b] = directions_across(normal);
  densities = (1 / std::numbers::pi) * upwards;
  branch.directions = kept_on_side(x * a + y * b + upwards * normal, from.face_normal);
  branch.weights = from.phong.diffuse * rays.weights[group] * from.phong.color;
  branch.rays &= ~mask_of(is_black(branch.weights));
  return branch;
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
  if (context.frame.settings().indirect > 0)
    split.diffuse = diffuse_rays(context, rays, from, group, some, split.diffuse_densities);
  return split;
}

/// Asks whether a ray of such a weight is worth following after another one. If it is not, it
/// counts as dropped, with the most that it may weigh after all that brightens light behind it.
bool is_worth_it(TraceContext& context, const PathState& before, const Rgb& weight,
                 bool is_within_depth, Sample& sample) {
  const Settings& settings = context.frame.settings();
  const bool is_brightened = context.data.features().gain != 1;
  const Rgb most = is_brightened ? context.frame.gain_behind(before.bounces) * weight : weight;
  const double least = settings.min_weight;
  const bool is_weak = most.x < least && most.y < least && most.z < least;
  if (!is_weak && is_within_depth) return true;
  RenderStats& stats = context.work.stats;
  ++(is_weak ? stats.rays_below_min_weight : stats.rays_beyond_depth);
  sample.dropped += largest_component(most);
  return false;
}

/// Adds what stands in for light along a ray that the recursion depth ends.
void add_cutoff(const TraceContext& context, const Rgb& weight, const Vec3& direction,
                Sample& sample) {
  if (context.frame.settings().cutoff != Cutoff::background) return;
  const Rgb light = weight * rgb(context.data.background().color(direction));
  sample.channels += lanes_of(light.x, light.y, light.z, 0);
}

/// Takes a ray into the next round. If its sample has followed as many as it may, it and all that
/// wait are dropped.
[[gnu::always_inline]] inline void take(RenderStats& stats, const PathRay& ray, SampleWork& work,
                                        Sample& sample, PathRays& next) {
  if (work.rays == max_rays_per_sample) {
    ++stats.samples_over_ray_bound;
    for (const PathRay& waiting : work.pending.all()) {
      sample.dropped += largest_component(waiting.weight);
    }
    sample.dropped += largest_component(ray.weight);
    work.pending.clear();
    return;
  }
  ++(ray.path.kind == RayKind::refraction ? stats.refraction_rays : stats.reflection_rays);
  next.add(ray, work, sample);
  work.media.release(ray.path.media_mark);
}

/// Sends rays of some of a group of surfaces on. Of a sample's diffuse ray, its mirrored one and
/// the one through the surface the last is taken into the next round. The others wait on the
/// sample's stack. Returns which samples got any.
RayMask send_on(TraceContext& context, const PathRays& rays, const PathHits& hits,
                const Surfaces& surfaces, std::size_t group, RayMask some, PathRays& next) {
  const Split parts = split(context, rays, hits, surfaces, group, some);
  RenderStats& stats = context.work.stats;
  RayMask sent = 0;
  for_each_ray(some, [&](std::size_t lane) {
    const std::size_t ray = group * lane_count + lane;
    const SurfaceLane from = surfaces.of(ray);
    const PathState& state = rays.states[ray];
    SampleWork& work = *rays.works[ray];
    Sample& sample = *rays.samples[ray];
    const bool is_within_depth = state.bounces < context.frame.settings().recursion_depth;
    const auto is_followed = [&](const Branch& branch) {
      if ((branch.rays >> lane & 1u) == 0) return false;
      const Rgb weight = branch.weights.lane(lane);
      const bool within = is_within_depth || &branch == &parts.diffuse;
      if (is_worth_it(context, state, weight, within, sample)) return true;
      if (!within && state.diffuse_bounces == 0)
        add_cutoff(context, weight, branch.directions.lane(lane), sample);
      return false;
    };
    // It is filled in place, which is faster than a copy.
    const auto describe = [&](PathRay& ray_on, const Branch& branch, const StartPoint& start,
                              const PathState& path) {
      ray_on.origin = from.position();
      ray_on.direction = branch.directions.lane(lane);
      ray_on.start = start;
      ray_on.weight = branch.weights.lane(lane);
      ray_on.path = path;
    };
    const bool is_diffuse = is_followed(parts.diffuse);
    const bool is_mirrored = is_followed(parts.mirrored);
    const bool goes_through = is_followed(parts.refracted);
    if (!is_diffuse && !is_mirrored && !goes_through) return;
    sent |= RayMask{1} << lane;
    PathRay last;
    if (is_diffuse) {
      PathState diffuse = state;
      diffuse.kind = RayKind::diffuse;
      ++diffuse.diffuse_bounces;
      diffuse.path_length = from.path_length();
      diffuse.density = parts.diffuse_densities[lane];
      const bool waits = is_mirrored || goes_through;
      describe(waits ? work.pending.push() : last, parts.diffuse, from.start(), diffuse);
    }
    if (is_mirrored) {
      PathState mirrored = state;
      mirrored.kind = RayKind::reflection;
      ++mirrored.bounces;
      mirrored.path_length = from.path_length();
      mirrored.density = 0;
      describe(goes_through ? work.pending.push() : last, parts.mirrored, from.start(), mirrored);
    }
    if (goes_through) {
      PathState through = state;
      through.kind = RayKind::refraction;
      ++through.bounces;
      through.path_length = from.path_length();
      through.density = 0;
      through.media = parts.media_behind[lane];
      through.media_mark = work.media.mark();
      describe(last, parts.refracted, from.start_behind(), through);
      stats.media_changes += context.data.is_solid(hits.hits[ray]);
    }
    take(stats, last, work, sample, next);
  });
  return sent;
}

}  // namespace

void next_rays(TraceContext& context, const PathRays& rays, const PathHits& hits,
               const Surfaces& surfaces, PathRays& next) {
  next.count = 0;
  next.batch.with_starts = 0;
  const Features& features = context.data.features();
  const bool is_indirect = context.frame.settings().indirect > 0;
  if (!features.reflection && !features.transparency && !is_indirect) return;
  for (std::size_t group = 0; group * lane_count < rays.count; ++group) {
    RayMask some = RayPacket::lanes(surfaces.rays, group);
    if (!is_indirect) some &= surfaces.groups[group].sending_on;
    const RayMask sent = some == 0 ? 0 : send_on(context, rays, hits, surfaces, group, some, next);
    for_each_ray(RayPacket::lanes(rays.all(), group) & ~sent, [&](std::size_t lane) {
      const std::size_t ray = group * lane_count + lane;
      PathStack& waiting = rays.works[ray]->pending;
      if (waiting.empty()) return;
      const PathRay last = waiting.top();
      waiting.pop();
      take(context.work.stats, last, *rays.works[ray], *rays.samples[ray], next);
    });
  }
}

}  // namespace crt::core
