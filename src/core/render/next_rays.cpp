#include "core/render/next_rays.hpp"

#include <limits>
#include <numbers>
#include <optional>

#include "core/geometry/angles.hpp"
#include "core/math/vector.hpp"
#include "core/render/behind_surfaces.hpp"
#include "core/shading/fresnel.hpp"
#include "core/shading/microfacets.hpp"

namespace crt::core {

namespace {

/// A sample follows no more rays than this: where every hit sends two full-weight rays on, a deep
/// recursion would not end in a lifetime. With weights that add up to 1 it is never reached.
constexpr int max_rays_per_sample = 65536;

/// The samples of lights that a surface takes pass what casts no shadow, and stand for all light
/// behind it. So a ray through it goes on as if it had hardly any chance to find these lights.
constexpr double least_density = std::numeric_limits<double>::min();

/// A Branch is the rays of a group that go on in one way.
struct Branch {
  RayMask rays = 0;
  VectorLanes directions;
  VectorLanes weights;
  Lanes densities{};  ///< PathState::density
};

/// A Split is all rays that surfaces of a group send on.
struct Split {
  std::optional<Branch> diffuse;  ///< only where light is followed over diffuse bounces
  Branch mirrored;
  Branch refracted;
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
                    std::size_t group, RayMask some) {
  const RayMask principled = some & from.principled_rays;
  Branch branch;
  branch.rays = (some & mask_of(from.phong.diffuse > 0.0)) | principled;
  branch.rays &= RayPacket::lanes(rays.sending_diffuse(context.frame.settings().indirect), group);
  if (branch.rays == 0) return branch;
  const auto [u, v] = rays.draw<2>(context.frame, group, SampleDecision::diffuse_direction);
  const auto [x, y] = point_of_disc(u, v);
  const Lanes upwards = sqrt(max(Lanes{}, 1.0 - x * x - y * y));
  const VectorLanes& normal = from.phong.normal;
  const VectorLanes directions = NormalFrame<Lanes>(normal).to_world({x, y, upwards});
  branch.directions = kept_on_side(directions, from.face_normal);
  branch.weights = from.phong.diffuse * rays.weights[group] * from.phong.color;
  branch.densities = (1 / std::numbers::pi) * upwards;
  if (principled != 0) {
    const VectorLanes body =
        evaluate<Lanes>(from.principled, -from.phong.view, normal, directions).body;
    const VectorLanes weights = rays.weights[group] * (body / branch.densities);
    branch.weights = select(lanes_with(principled), weights, branch.weights);
  }
  branch.rays &= ~mask_of(is_black(branch.weights));
  return branch;
}

/// Replaces the rays that principled surfaces of a group send on by one each, to either side.
void scatter(const TraceContext& context, const PathRays& rays, const SurfaceGroup& from,
             std::size_t group, RayMask principled, Split& split) {
  const auto [u, v, w, spare] =
      rays.draw(context.frame, group, SampleDecision::scattered_direction);
  const ScatteredRay<Lanes> ray =
      sample<Lanes>(from.principled, -from.phong.view, from.phong.normal, {u, v, w});
  const VectorLanes weights = rays.weights[group] * ray.weight;
  const RayMask seen = principled & ~mask_of(is_black(weights));
  const RayMask through = seen & mask_of(ray.is_transmitted);
  const auto replace = [&](Branch& branch, RayMask of_branch, const VectorLanes& side) {
    const LaneMask lanes = lanes_with(principled);
    branch.rays = (branch.rays & ~principled) | of_branch;
    branch.directions = select(lanes, kept_on_side(ray.direction, side), branch.directions);
    branch.weights = select(lanes, weights, branch.weights);
  };
  replace(split.mirrored, seen & ~through, from.face_normal);
  replace(split.refracted, through, -from.face_normal);
  // Surfaces have taken no samples of lights behind them.
  split.mirrored.densities = select(lanes_with(principled), ray.density, Lanes{});
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
  const RayMask principled = some & from.principled_rays;
  if (principled != 0) scatter(context, rays, from, group, principled, split);
  if (context.frame.settings().indirect > 0)
    split.diffuse = diffuse_rays(context, rays, from, group, some);
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
      const bool within = is_within_depth || (parts.diffuse && &branch == &*parts.diffuse);
      if (is_worth_it(context, state, weight, within, sample)) return true;
      if (!within && state.diffuse_bounces == 0)
        add_cutoff(context, weight, branch.directions.lane(lane), sample);
      return false;
    };
    // It is filled in place, which is faster than a copy.
    const auto describe = [&](PathRay& ray_on, const Branch& branch, const StartPoint& start,
                              RayKind kind) -> PathState& {
      ray_on.origin = from.position();
      ray_on.direction = branch.directions.lane(lane);
      ray_on.start = start;
      ray_on.weight = branch.weights.lane(lane);
      PathState& path = ray_on.path;
      path = state;
      path.kind = kind;
      path.path_length = from.path_length();
      path.density = branch.densities[lane];
      path.is_scattered = state.is_scattered || path.density > 0;
      if (context.data.chosen_lights() != nullptr)
        path.normal = PackedDirection(surfaces.groups[group].face_normal.lane(lane));
      return path;
    };
    const bool is_diffuse = parts.diffuse && is_followed(*parts.diffuse);
    const bool is_mirrored = is_followed(parts.mirrored);
    const bool goes_through = is_followed(parts.refracted);
    if (!is_diffuse && !is_mirrored && !goes_through) return;
    sent |= RayMask{1} << lane;
    PathRay last;
    if (is_diffuse) {
      PathRay& ray_on = is_mirrored || goes_through ? work.pending.push() : last;
      ++describe(ray_on, *parts.diffuse, from.start(), RayKind::diffuse).diffuse_bounces;
    }
    if (is_mirrored) {
      PathRay& ray_on = goes_through ? work.pending.push() : last;
      ++describe(ray_on, parts.mirrored, from.start(), RayKind::reflection).bounces;
    }
    if (goes_through) {
      PathState& through =
          describe(last, parts.refracted, from.start_behind(), RayKind::refraction);
      ++through.bounces;
      through.media = parts.media_behind[lane];
      through.media_mark = work.media.mark();
      if (context.data.features().shadowless && state.density > 0 &&
          context.data.is_passed(hits.hits[ray].object, passing_shadow)) {
        through.density = least_density;
        through.normal = state.normal;
      }
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
  if (!features.reflection && !features.transparency && !features.principled && !is_indirect)
    return;
  for (std::size_t group = 0; group * lane_count < rays.count; ++group) {
    RayMask some = RayPacket::lanes(surfaces.rays, group);
    const SurfaceGroup& from = surfaces.groups[group];
    if (!is_indirect) some &= from.sending_on | from.principled_rays;
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
