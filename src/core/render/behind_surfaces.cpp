#include "core/render/behind_surfaces.hpp"

#include "core/render/media_order.hpp"
#include "core/render/surface_hit.hpp"

namespace crt::core {

namespace {

/// A Passage is a path ray that goes on through the place of its hit, and what it finds there.
struct Passage {
  TraceContext& context;
  const PathRays& rays;
  std::size_t ray;
  const RayHit& hit;
  SurfaceLane surface;
  MediaLists& lists = rays.works[ray]->media;
  MediaLists::List media = rays.states[ray].media;  ///< behind what has been passed
  double transparency = surface.transparency();     ///< of all surfaces there together
  Rgb color = surface.color();

  /// Asks whether the ray is in a solid just behind the hit, and where it leaves it.
  SolidExit find_exit(std::uint32_t object) const {
    const WorldRay behind = {.origin = surface.position(),
                             .direction = rays.batch.direction(ray),
                             .start = surface.start_behind()};
    return context.data.find_exit(behind, object, context.work.rays);
  }
};

/// Takes a crossing into the media behind the place.
void cross(Passage& passage, const RayHit& crossing) {
  if (!crossing.entering) {
    passage.media = passage.lists.left(passage.media, crossing.object);
  } else {
    const Medium entered{crossing.object, passage.context.data.hit_material(crossing)};
    passage.media =
        entered_in_order(passage.lists, passage.media, entered,
                         [&](std::uint32_t object) { return passage.find_exit(object).exit; });
  }
}

/// Returns the crossings at or near a hit that the ray passes when it goes on. A ray that starts at
/// the hit finds some crossings next to it behind itself, whatever rounding makes of their order.
/// What it starts inside of tells which of them it has passed.
const std::vector<RayHit>& passed_crossings(const Passage& passage, const WorldRay& before) {
  const PreparedData& data = passage.context.data;
  Workspace& work = passage.context.work;
  data.intersect(before, work.rays,
                 passage.rays.passing());  // Others have been asked for since it was.
  std::vector<RayHit>& passed = work.crossings;
  passed.clear();
  const auto add_passed = [&](const RayHit& crossing, bool is_at_place) {
    passage.context.count_rays(1);
    const bool is_passed =
        data.is_solid(crossing)
            ? passage.find_exit(crossing.object).inside == crossing.entering
            : is_at_place || crossing.t - passage.hit.t <= passage.surface.start().t_error;
    if (is_passed) passed.push_back(crossing);
  };
  for (const RayHit& crossing : work.rays.here) add_passed(crossing, true);
  for (const RayHit& crossing : work.rays.near) add_passed(crossing, false);
  return passed;
}

/// Goes through the surfaces of several objects at one place.
void pass_coincident(Passage& passage) {
  const PreparedData& data = passage.context.data;
  Workspace& work = passage.context.work;
  const RayHit& hit = passage.hit;
  const WorldRay before = passage.rays.batch.ray(passage.ray);
  const MediaLists::List media_before = passage.media;
  work.entered.clear();
  for (const RayHit& crossing : passed_crossings(passage, before)) {
    if (crossing.leaf != hit.leaf || crossing.face != hit.face || crossing.root != hit.root) {
      const CrossingFilter filter = crossing_filter(data, before, crossing, work.stats);
      passage.transparency *= filter.transparency;
      passage.color = bounded_share(passage.color * filter.color);
    }
    if (!data.is_solid(crossing)) continue;
    if (!crossing.entering) {
      cross(passage, crossing);
    } else if (!passage.lists.holds(media_before, crossing.object) &&
               work.entered.size() < max_media_at_once) {
      work.entered.push_back(crossing);
    }
  }
  sort_outermost_first(work.entered,
                       [&](std::uint32_t object) { return passage.find_exit(object).exit; });
  for (const RayHit& crossing : work.entered) cross(passage, crossing);
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
  Behind behind;
  behind.color = surfaces.groups[group].phong.color;
  for_each_ray(lanes, [&](std::size_t lane) {
    const std::size_t ray = group * lane_count + lane;
    Passage passage{context, rays, ray, hits.hits[ray], surfaces.of(ray)};
    behind.index_before[lane] = refractive_index(data, passage.lists, passage.media);
    if (passage.hit.has_coincident) {
      pass_coincident(passage);
      behind.color.set(lane, passage.color);
    } else if (data.is_solid(passage.hit)) {
      cross(passage, passage.hit);
    }
    behind.transparency[lane] = passage.transparency;
    behind.index_behind[lane] = refractive_index(data, passage.lists, passage.media);
    behind.media[lane] = passage.media;
  });
  return behind;
}

}  // namespace crt::core
