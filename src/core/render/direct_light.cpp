#include "core/render/direct_light.hpp"

#include <bit>
#include <limits>
#include <numbers>

#include "core/math/vector.hpp"
#include "core/render/found_light.hpp"
#include "core/render/sample_identity.hpp"
#include "core/render/shadow.hpp"

namespace crt::core {

namespace {

/// Returns how far rounding may put a light from surfaces that it is meant to be on. At the limb of
/// a ball a line that passes by some more is much shorter or longer.
Lanes light_errors(const VectorLanes& points, const LightSamples& light) {
  constexpr double roundings = 16;
  const Lanes error =
      roundings * unit_roundoff *
      fma(light.distances, largest_component(light.directions), largest_component(points));
  const Lanes along = error + sqrt(error * light.radii);
  return select(light.distances == std::numeric_limits<double>::infinity(), Lanes{}, along);
}

/// Lets shadow rays start at the surfaces that any light makes brighter.
void start_at(const Surfaces& surfaces, RayBatch& batch) {
  batch.with_starts = 0;
  RayPacket::for_each_group(surfaces.rays, [&](std::size_t i, RayMask lanes) {
    const SurfaceGroup& group = surfaces.groups[i];
    const LaneMask is_lit = (group.phong.diffuse > 0.0) | (group.phong.specular > 0.0) |
                            lanes_with(group.principled_rays);
    batch.start_errors[i] = group.start_errors;
    for_each_ray(lanes & mask_of(is_lit), [&](std::size_t lane) {
      batch.starts[i * lane_count + lane] = group.starts[lane];
      batch.with_starts |= RayMask{1} << (i * lane_count + lane);
    });
  });
}

/// Lets the light on smooth surfaces fade to nothing before facets turn away from it, which would
/// be black beside bright ones. That begins at twice the horizon of the normal, and ends there: it
/// has no jump between facets. But where corners' normals are far from the facets', the facet's own
/// normal says how much light is left.
///
/// Source of the latter: Chiang, Li, Burley, Taming the shadow terminator, SIGGRAPH 2019 talks.
void soften_terminator(const SurfaceGroup& group, const VectorLanes& to_light, VectorLanes& light) {
  constexpr double near_horizon = 0.5;
  constexpr double far_horizon = 0.7;
  const Lanes one = lanes_of(1);
  const VectorLanes& normal = group.phong.normal;
  const Lanes cosine = dot(normal, to_light);
  const Lanes above = max(Lanes{}, cosine - group.horizons);
  const Lanes risen = select(above < group.horizons, above / group.horizons, one);
  const Lanes by_horizon = risen * (2.0 - risen);
  const Lanes ratio = dot(group.face_normal, to_light) / (cosine * dot(normal, group.face_normal));
  const Lanes g = clamp(ratio, Lanes{}, one);
  const Lanes by_facet = g * (1.0 + g * (1.0 - g));
  const Lanes far =
      clamp((group.horizons - near_horizon) / (far_horizon - near_horizon), Lanes{}, one);
  const Lanes share = select(far > 0.0, by_horizon + far * (by_facet - by_horizon), by_horizon);
  const LaneMask fades = lanes_with(group.smooth) & (cosine > 0.0);
  light = select(fades, max(Lanes{}, share) * light, light);
}

/// Draws the numbers of a SampleDecision that say which points of a light surfaces see: those of
/// one of Settings::light_samples samples of it.
void draw_numbers(const TraceContext& context, const PathRays& rays, RayMask some,
                  std::uint32_t kind, int sample, ShadowRays& shadow_rays) {
  const int samples = context.frame.settings().light_samples;
  RayPacket::for_each_group(some, [&](std::size_t group, RayMask) {
    LightNumbers& numbers = shadow_rays.numbers[group];
    if (kind == SampleDecision::chosen_light) {
      const auto [u, v, choice, spare] = rays.draw(context.frame, group, kind, samples, sample);
      numbers = {u, v, choice};
    } else {
      const auto [u, v] = rays.draw<2>(context.frame, group, kind, samples, sample);
      numbers = {u, v};
    }
  });
}

/// FoundByRays says which surfaces send rays on that may find lights, too: diffuse rays, and those
/// that principled surfaces scatter otherwise.
struct FoundByRays {
  RayMask diffuse = 0;
  RayMask scattered = 0;
};

/// Sets the light that principled surfaces send back of samples of a light, and what of it rays
/// find, too.
void light_principled(const SurfaceGroup& group, const LightSamples& samples, bool is_balanced,
                      const FoundByRays& found_by, VectorLanes& light, VectorLanes& by_rays) {
  const Scattering<Lanes> found =
      evaluate<Lanes>(group.principled, -group.phong.view, group.phong.normal, samples.directions);
  VectorLanes scattered = found.value - found.body;
  if (is_balanced) {
    const Lanes by_ray = select(lanes_with(found_by.scattered), found.density, Lanes{});
    scattered = balanced<Lanes>(samples.densities(), by_ray) * scattered;
  }
  const VectorLanes body = samples.diffuse_shares * found.body;
  // A light of colour 1 shows 1 on a white surface, whose value is the cosine over pi.
  const VectorLanes factor = std::numbers::pi * samples.intensities * samples.colors;
  const LaneMask lanes = lanes_with(group.principled_rays);
  light = select(lanes, factor * (body + scattered), light);
  if (!is_balanced) return;
  const VectorLanes found_bodies = select(lanes_with(found_by.diffuse), body, VectorLanes{});
  const VectorLanes found_others = select(lanes_with(found_by.scattered), scattered, VectorLanes{});
  by_rays = select(lanes, factor * (found_bodies + found_others), by_rays);
}

/// A Source is a light that all surfaces ask or, if it is null, a light that is chosen for each.
struct Source {
  const PreparedLight* light;
  const ChosenLights* chosen;

  /// Returns whether rays may find it, too.
  bool is_found_by_rays() const { return light == nullptr || light->is_found_by_rays(); }
};

/// Takes a sample of a light for each of some surfaces of a group. Where rays do not find that
/// light, they are taken out of `found_by`. Returns where it shines.
LaneMask sample_chosen(const ChosenLights& chosen, const SurfaceGroup& group, RayMask some,
                       const LightNumbers& numbers, LightSamples& samples, RayMask& found_by) {
  LaneMask lit{};
  for_each_ray(some, [&](std::size_t lane) {
    const PackedDirection normal(group.face_normal.lane(lane));
    const LightTree::Choice choice =
        chosen.tree().choose({group.position.lane(lane), normal.direction()}, numbers.choice[lane]);
    if (choice.probability == 0) return;
    const PreparedLight& light = chosen.lights()[choice.light];
    LightSamples of_light;
    const LaneMask own = lanes_with(RayMask{1} << lane);
    lit |= own & light.sample(group.position, group.path_length, numbers, of_light);
    samples.directions = select(own, of_light.directions, samples.directions);
    samples.distances = select(own, of_light.distances, samples.distances);
    samples.intensities =
        select(own, of_light.intensities / choice.probability, samples.intensities);
    samples.colors = select(own, of_light.colors, samples.colors);
    samples.radii = select(own, of_light.radii, samples.radii);
    if (!light.is_found_by_rays()) found_by &= ~(RayMask{1} << lane);
  });
  return lit;
}

/// Aims shadow rays from some surfaces at a light. Returns to which it may come at all.
RayMask aim_at(const Source& source, const Surfaces& surfaces, RayMask some,
               const FoundByRays& found_by, ShadowRays& rays) {
  RayMask aimed = 0;
  LightSamples& samples = rays.samples;
  samples.diffuse_shares = lanes_of(1);
  const bool is_balanced = source.is_found_by_rays();
  RayPacket::for_each_group(some, [&](std::size_t i, RayMask lanes) {
    const SurfaceGroup& group = surfaces.groups[i];
    RayMask found = lanes;
    LaneMask lit = lanes_with(lanes);
    lit &= source.light == nullptr
               ? sample_chosen(*source.chosen, group, lanes, rays.numbers[i], samples, found)
               : source.light->sample(group.position, group.path_length, rays.numbers[i], samples,
                                      rays.views[i]);
    lit &= dot(samples.directions, group.face_normal) > 0.0;
    const FoundByRays of_group{.diffuse = RayPacket::lanes(found_by.diffuse, i) & found,
                               .scattered = RayPacket::lanes(found_by.scattered, i) & found};
    if (is_balanced) {
      // A diffuse ray has the density of the cosine over pi.
      const Lanes cosine = max(Lanes{}, dot(samples.directions, group.phong.normal));
      const Lanes by_ray =
          select(lanes_with(of_group.diffuse), (1 / std::numbers::pi) * cosine, Lanes{});
      samples.diffuse_shares = balanced<Lanes>(samples.densities(), by_ray);
    }
    direct_light(group.phong, samples, lit, rays.light[i]);
    VectorLanes& by_rays = rays.found_by_rays[i];
    if (is_balanced) by_rays = select(lanes_with(of_group.diffuse), rays.light[i], VectorLanes{});
    if (group.principled_rays != 0)
      light_principled(group, samples, is_balanced, of_group, rays.light[i], by_rays);
    if (group.smooth != 0) soften_terminator(group, samples.directions, rays.light[i]);
    lit &= !is_black(rays.light[i]);
    aimed |= mask_of(lit) << (i * lane_count);
    rays.batch.lines[i] = {group.position, samples.directions};
    rays.batch.t_max[i] = samples.distances;
    rays.batch.end_errors[i] = light_errors(group.position, samples);
  });
  return aimed;
}

/// Finds what shadow rays of a kind meet on their paths.
LightPaths paths_to_light(TraceContext& context, const RayBatch& batch, const PacketStarts& starts,
                          RayMask some, PassingRays kind = passing_shadow) {
  const auto count = static_cast<unsigned>(std::popcount(some));
  context.work.stats.shadow_rays += count;
  context.count_rays(count);
  const PreparedData& data = context.data;
  RayWorkspace& work = context.work.rays;
  if (data.features().transparency)
    return data.paths_to_light(batch, starts, some, work, Packets::where_they_pay, kind);
  return {.blocked = data.shadowed_each(batch, starts, some, work, kind)};
}

/// Finds what is on the paths of shadow rays that were sent to a light that rays find, too. What
/// casts no shadow hides the light from rays, and there it aims again, at all of the light.
LightPaths paths_beside_rays(TraceContext& context, const Source& source, const Surfaces& surfaces,
                             const PacketStarts& starts, RayMask sent, const FoundByRays& found_by,
                             ShadowRays& rays) {
  const RayBatch& batch = rays.batch;
  const LightPaths of_rays = paths_to_light(context, batch, starts, sent, passing_none);
  const LightPaths paths =
      paths_to_light(context, batch, starts, of_rays.blocked | of_rays.filtered);
  const RayMask hidden = (of_rays.blocked & ~paths.blocked) | (of_rays.filtered & ~paths.filtered);
  if (hidden != 0) {
    const FoundByRays elsewhere{.diffuse = found_by.diffuse & ~hidden,
                                .scattered = found_by.scattered & ~hidden};
    aim_at(source, surfaces, batch.with_starts, elsewhere, rays);
  }
  return paths;
}

/// Adds what gets through along shadow rays that were sent, times a factor, and is sent back. Those
/// of `absorbed` start in media that absorb.
void add_unblocked(TraceContext& context, const PathRays& rays, const LightPaths& paths,
                   RayMask sent, RayMask absorbed, double factor, bool is_found_by_rays,
                   const ShadowRays& shadow_rays, PathLight& sum) {
  Workspace& work = context.work;
  const RayMask unblocked = sent & ~paths.blocked;
  const RayMask filtered = paths.filtered | (unblocked & absorbed);
  RayPacket::for_each_group(unblocked & ~filtered, [&](std::size_t i, RayMask lanes) {
    VectorLanes& light = sum.colors[i];
    const VectorLanes more = factor == 1 ? shadow_rays.light[i] : factor * shadow_rays.light[i];
    light = select(lanes_with(lanes), light + more, light);
  });
  for_each_ray(filtered, [&](std::size_t i) {
    const Rgb share = light_share(context.data, shadow_rays.batch.ray(i), work.rays.on_paths[i],
                                  rays.works[i]->media, rays.states[i].media, work);
    const std::size_t lane = i % lane_count;
    const std::size_t group = i / lane_count;
    Rgb sent_back = shadow_rays.light[group].lane(lane);
    const bool is_through = (paths.filtered >> i & 1u) != 0;
    if (is_found_by_rays && is_through) sent_back -= shadow_rays.found_by_rays[group].lane(lane);
    VectorLanes& light = sum.colors[group];
    light.set(lane, light.lane(lane) + factor * (sent_back * share));
  });
}

/// Adds what gets through from all lights to surfaces and is sent back.
void add_lights(TraceContext& context, const PathRays& rays, const Surfaces& surfaces,
                ShadowRays& shadow_rays, PathLight& sum) {
  RayBatch& batch = shadow_rays.batch;
  start_at(surfaces, batch);
  const RayMask some = batch.with_starts;
  if (some == 0) return;
  const PacketStarts starts = context.data.noted_starts(batch, some);
  const Settings& settings = context.frame.settings();
  FoundByRays found_by{.diffuse = rays.sending_diffuse(settings.indirect)};
  if (context.data.features().principled)
    found_by.scattered = rays.within_depth(settings.recursion_depth);
  const bool may_be_hidden =
      context.data.features().shadowless && (found_by.diffuse | found_by.scattered) != 0;
  const RayMask absorbed = context.data.features().absorption ? rays.in_media() : 0;
  const auto add = [&](const Source& source, bool has_size, std::uint32_t kind, std::size_t index) {
    const int samples = has_size ? settings.light_samples : 1;
    for (LightView& view : shadow_rays.views) view.is_known = false;
    for (int sample = 0; sample < samples; ++sample) {
      if (has_size) draw_numbers(context, rays, some, kind, sample, shadow_rays);
      const RayMask sent = aim_at(source, surfaces, some, found_by, shadow_rays);
      const LightPaths paths =
          may_be_hidden && source.is_found_by_rays()
              ? paths_beside_rays(context, source, surfaces, starts, sent, found_by, shadow_rays)
              : paths_to_light(context, batch, starts, sent);
      // Shadows of what has a size have no edge.
      if (context.identifies && !has_size)
        identify_shadows(rays, index, paths.blocked | paths.filtered);
      add_unblocked(context, rays, paths, sent, absorbed, 1.0 / samples, source.is_found_by_rays(),
                    shadow_rays, sum);
    }
  };
  for (const std::uint32_t index : context.frame.asked_lights()) {
    const PreparedLight& light = context.frame.lights()[index];
    add({.light = &light, .chosen = nullptr}, light.has_size(), SampleDecision::of_light(index),
        index);
  }
  if (const ChosenLights* const chosen = context.data.chosen_lights())
    add({.light = nullptr, .chosen = chosen}, true, SampleDecision::chosen_light, 0);
}

}  // namespace

PathLight direct_light(TraceContext& context, const PathRays& rays, const Surfaces& surfaces,
                       ShadowRays& shadow_rays) {
  PathLight light;
  if (surfaces.rays == 0) return light;
  RayPacket::for_each_group(surfaces.rays, [&](std::size_t i, RayMask lanes) {
    const SurfaceGroup& group = surfaces.groups[i];
    light.colors[i] = ambient_light(context.frame.ambient(), context.frame.settings().ambient_model,
                                    group.phong.color, group.reflectivity, group.transparency);
    if (!context.data.features().emission) return;
    const Lanes shares = shares_of_emission(context, rays, i, lanes, group);
    light.colors[i] = light.colors[i] + shares * group.emission;
  });
  add_lights(context, rays, surfaces, shadow_rays, light);
  RayPacket::for_each_group(surfaces.rays, [&](std::size_t i, RayMask lanes) {
    light.rays |= (lanes & ~mask_of(is_black(light.colors[i]))) << (i * lane_count);
    light.colors[i] = rays.weights[i] * light.colors[i];
  });
  return light;
}

}  // namespace crt::core
