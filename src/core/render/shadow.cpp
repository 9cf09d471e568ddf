#include "core/render/shadow.hpp"

#include "core/render/surface_hit.hpp"

namespace crt::core {

namespace {

/// What the media along the ray absorb, between the crossings in work.crossings.
Rgb absorbed_share(const PreparedData& data, const WorldRay& ray, MediaLists::List media, Workspace& work) {
  const std::uint32_t mark = work.media.mark();
  Rgb share(1);
  double reached = 0;
  const auto go_on_to = [&](double t) {
    if (media != MediaLists::empty) {
      share *= transmittance(data.materials()[work.media.innermost(media).material], t - reached);
    }
    reached = t;
  };
  for (const RayHit& crossing : work.crossings) {
    go_on_to(crossing.t);
    if (!data.is_solid(crossing)) continue;
    media = crossing.entering ? work.media.entered(media, {crossing.object, data.hit_material(crossing)})
                              : work.media.left(media, crossing.object);
  }
  go_on_to(ray.t_max);
  work.media.release(mark);
  return share;
}

}  // namespace

Rgb light_share(const PreparedData& data, const WorldRay& ray, MediaLists::List media, Workspace& work) {
  ++work.stats.shadow_rays;
  if (!data.features().transparency) return Rgb(data.occluded(ray, work.rays) ? 0 : 1);
  if (!data.crossings(ray, true, work.crossings, work.rays)) return Rgb(0);

  Rgb share(1);
  for (const RayHit& crossing : work.crossings) {
    share *= crossing_tint(data, ray, crossing, work.stats);
    if (is_black(share)) return share;
  }
  if (data.features().absorption) share *= absorbed_share(data, ray, media, work);
  return share;
}

}  // namespace crt::core
