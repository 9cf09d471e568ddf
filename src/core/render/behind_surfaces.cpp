#include "core/render/behind_surfaces.hpp"

#include "core/render/media_order.hpp"
#include "core/render/surface_hit.hpp"

namespace crt::core {

namespace {

/// A path ray at its hit.
struct RayAtHit {
  const RayBatch& batch;
  std::size_t ray;
  const RayHit& hit;
  SurfaceLane surface;
  MediaLists& lists;
  MediaLists::List media;  ///< before the hit

  /// Returns the ray that goes straight on.
  WorldRay behind() const {
    return {.origin = surface.position(),
            .direction = batch.direction(ray),
            .start = surface.start_behind()};
  }
};

/// What a ray that goes on through a hit's place finds.
struct Passage {
  double transparency = 0;  ///< of all surfaces there together
  Rgb color{1, 1, 1};
  MediaLists::List media = MediaLists::empty;  ///< behind them
};

/// Returns the media behind the surface of a solid that is alone at its place.
MediaLists::List media_behind(TraceContext& context, const RayAtHit& at) {
  const PreparedData& data = context.data;
  if (!at.hit.entering) return at.lists.left(at.media, at.hit.object);
  return entered_in_order(
      at.lists, at.media, {at.hit.object, data.hit_material(at.hit)},
      [&](std::uint32_t object) { return data.stay(at.behind(), object, context.work.rays).exit; });
}

/// Takes one of the crossings at or near a hit's place into what the ray finds. Solids that it
/// enters there are put aside in Workspace::entered.
void pass(TraceContext& context, const RayAtHit& at, const WorldRay& before, const WorldRay& behind,
          const RayHit& crossing, bool is_at_place, Passage& passage) {
  const PreparedData& data = context.data;
  Workspace& work = context.work;
  context.count_rays(1);
  const bool solid = data.is_solid(crossing);
  // A ray that starts at the hit finds some crossings next to it behind itself, whatever rounding
  // makes of their order. What it starts inside of tells which of them it has passed.
  const bool passed =
      solid ? data.stay(behind, crossing.object, work.rays).inside == crossing.entering
            : is_at_place || crossing.t - at.hit.t <= behind.start.t_error;
  if (!passed) return;
  if (crossing.leaf != at.hit.leaf || crossing.face != at.hit.face ||
      crossing.root != at.hit.root) {
    const CrossingFilter filter = crossing_filter(data, before, crossing, work.stats);
    passage.transparency *= filter.transparency;
    passage.color = bounded_share(passage.color * filter.color);
  }
  if (!solid) return;
  if (!crossing.entering) {
    passage.media = at.lists.left(passage.media, crossing.object);
  } else if (!at.lists.holds(at.media, crossing.object) &&
             work.entered.size() < most_media_at_once) {
    work.entered.push_back(crossing);
  }
}

/// Goes through the surfaces of several objects at one place.
void pass_coincident(TraceContext& context, const RayAtHit& at, Passage& passage) {
  const PreparedData& data = context.data;
  Workspace& work = context.work;
  const WorldRay before = at.batch.ray(at.ray);
  const WorldRay behind = at.behind();
  data.intersect(before, work.rays);  // Others have been asked for since it was.
  work.entered.clear();
  for (const RayHit& crossing : work.rays.here) {
    pass(context, at, before, behind, crossing, true, passage);
  }
  for (const RayHit& crossing : work.rays.near) {
    pass(context, at, before, behind, crossing, false, passage);
  }
  const auto exit_of = [&](std::uint32_t object) {
    return data.stay(behind, object, work.rays).exit;
  };
  sort_outermost_first(work.entered, exit_of);
  for (const RayHit& crossing : work.entered) {
    const Medium medium{crossing.object, data.hit_material(crossing)};
    passage.media = entered_in_order(at.lists, passage.media, medium, exit_of);
  }
}

double refractive_index(const PreparedData& data, const MediaLists& lists, MediaLists::List media) {
  constexpr double vacuum = 1;
  if (media == MediaLists::empty) return vacuum;
  return data.materials()[lists.innermost(media).material].description->refractive_index;
}

}  // namespace

Behind behind_surfaces(TraceContext& context, const PathRays& rays, const PathHits& hits,
                       const Surfaces& surfaces, std::size_t group, RayMask lanes) {
  const PreparedData& data = context.data;
  const SurfaceGroup& at_group = surfaces.groups[group];
  Behind behind{.color = at_group.phong.color};
  for_each_ray(lanes, [&](std::size_t lane) {
    const std::size_t ray = group * lane_count + lane;
    const auto i = static_cast<int>(lane);
    const RayAtHit at = {rays.batch,
                         ray,
                         hits.hits[ray],
                         surfaces.of(ray),
                         rays.works[ray]->media,
                         rays.states[ray].media};
    Passage passage{.transparency = at_group.transparency[i], .media = at.media};
    if (at.hit.has_coincident) {
      passage.color = at.surface.color();
      pass_coincident(context, at, passage);
      behind.color.set(lane, passage.color);
    } else if (data.is_solid(at.hit)) {
      passage.media = media_behind(context, at);
    }
    behind.transparency[i] = passage.transparency;
    behind.index_before[i] = refractive_index(data, at.lists, at.media);
    behind.index_behind[i] = refractive_index(data, at.lists, passage.media);
    behind.media[lane] = passage.media;
  });
  return behind;
}

}  // namespace crt::core
