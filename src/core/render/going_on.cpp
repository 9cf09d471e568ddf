// The parts of the tracer about rays that go on from a surface: mirrored, or through it.
#include "core/math/vector.hpp"
#include "core/render/media_order.hpp"
#include "core/render/tracer.hpp"
#include "core/shading/fresnel.hpp"

namespace crt::core {

namespace {

/// A sample follows no more rays than this: where every hit sends two full-weight rays on, a deep
/// recursion would not end in a lifetime. With weights that add up to 1 it is never reached.
constexpr int most_rays_per_sample = 65536;

/// A bump may send a ray to the wrong side of the face; it then bounces off the face once more.
Vec3 kept_on_side(const Vec3& direction, const Vec3& side) {
  return glm::dot(direction, side) < 0 ? mirrored(direction, side) : direction;
}

}  // namespace

void Tracer::split(const Seen& seen, const SurfaceLane& surface) {
  const SurfaceHit& hit = surface.hit();
  double mirror_share = hit.material->description->reflectivity;
  if (mirror_share <= 0 && hit.transparency <= 0) return;

  const WorldRay& ray = *seen.ray;
  const Vec3 normal = surface.normal();
  const Vec3 face_normal = surface.face_normal();
  const MediaLists::List before = seen.path->media;
  MediaLists& media = seen.work->media;
  const std::uint32_t mirror_media_mark = media.mark();
  Passage open;
  Refraction refraction;
  Rgb through_weight(0);
  if (hit.transparency > 0) {
    pass(seen, surface, open);
    refraction =
        refract(ray.direction, normal, refractive_index(media, before), refractive_index(media, open.media));
    mirror_share += open.transparency * refraction.reflectance;
    through_weight = open.transparency * (1 - refraction.reflectance) * seen.weight * open.color;
  }
  const Rgb mirror_weight = mirror_share * seen.weight;
  const bool mirrors = mirror_share > 0 && is_worth_it(seen, mirror_weight);
  const bool goes_through = !is_black(through_weight) && is_worth_it(seen, through_weight);

  // What goes through is followed first; media lists made for it are dropped before the other's turn.
  if (mirrors) {
    const Departure mirror = depart(seen, surface.position(), RayKind::reflection, mirror_weight, goes_through);
    mirror.ray->direction = kept_on_side(mirrored(ray.direction, normal), face_normal);
    mirror.ray->start = hit.start;
    mirror.path->media = before;
    mirror.path->media_mark = mirror_media_mark;
  }
  if (goes_through) {
    const Departure through = depart(seen, surface.position(), RayKind::refraction, through_weight, false);
    through.ray->direction = kept_on_side(refraction.direction, -face_normal);
    through.ray->start = hit.start_behind();
    through.path->media = open.media;
    through.path->media_mark = media.mark();
    if (data_.is_solid(*seen.hit)) ++work_.stats.media_changes;
  }
}

bool Tracer::is_worth_it(const Seen& seen, const Rgb& weight) {
  const double least = frame_.settings().min_weight;
  const bool is_too_weak = weight.x < least && weight.y < least && weight.z < least;
  const bool is_too_deep = seen.path->bounces >= frame_.settings().recursion_depth;
  if (!is_too_weak && !is_too_deep) return true;
  ++(is_too_weak ? work_.stats.rays_below_min_weight : work_.stats.rays_beyond_depth);
  seen.sample->dropped += largest_component(weight);
  return false;
}

Tracer::Departure Tracer::depart(const Seen& seen, const Vec3& place, RayKind kind, const Rgb& weight, bool waits) {
  SampleWork& work = *seen.work;
  Departure departure{};
  if (waits || work.rays == most_rays_per_sample) {
    PathRay& pending = work.pending.emplace_back();
    departure = {&pending.ray, &pending.path};
  } else {
    work.goes_on = true;
    departure = {&next_round_->rays[next_round_->count], &next_round_->paths[next_round_->count]};
  }
  departure.ray->origin = place;
  departure.path->kind = kind;
  departure.path->bounces = seen.path->bounces + 1;
  departure.path->path_length = seen.path->path_length + seen.hit->t;
  departure.path->weight = weight;
  return departure;
}

void Tracer::pass(const Seen& seen, const SurfaceLane& surface, Passage& passage) {
  const RayHit& hit = *seen.hit;
  const MediaLists::List before = seen.path->media;
  MediaLists& media = seen.work->media;
  passage.transparency = surface.hit().transparency;
  passage.color = surface.color();
  passage.media = before;
  const auto ray_behind = [&] {
    return WorldRay{.origin = surface.position(),
                    .direction = seen.ray->direction,
                    .start = surface.hit().start_behind()};
  };
  if (hit.has_company) {
    pass_company(ray_behind(), seen, passage);
  } else if (data_.is_solid(hit)) {
    const auto exit_of = [&](std::uint32_t object) {
      return data_.stay(ray_behind(), object, work_.rays).exit;
    };
    const Medium medium{hit.object, data_.hit_material(hit)};
    passage.media =
        hit.entering ? entered_in_order(media, before, medium, exit_of) : media.left(before, medium.object);
  }
}

// A ray that starts at the hit finds some crossings next to it behind itself, whatever rounding makes of
// their order: which of them it has passed is told by what it starts inside of.
void Tracer::pass_company(const WorldRay& behind, const Seen& seen, Passage& passage) {
  const RayHit& hit = *seen.hit;
  MediaLists& media = seen.work->media;
  data_.intersect(*seen.ray, work_.rays);  // once more: others have been asked for since then
  std::vector<RayHit>& entered = work_.entered;
  entered.clear();
  const auto pass = [&](const RayHit& crossing, bool at_place) {
    const bool solid = data_.is_solid(crossing);
    const bool passed = solid ? data_.stay(behind, crossing.object, work_.rays).inside == crossing.entering
                              : at_place || crossing.t - hit.t <= behind.start.t_error;
    if (!passed) return;
    if (crossing.leaf != hit.leaf || crossing.face != hit.face || crossing.root != hit.root) {
      const CrossingFilter filter = crossing_filter(data_, *seen.ray, crossing, work_.stats);
      passage.transparency *= filter.transparency;
      passage.color *= filter.color;
    }
    if (!solid) return;
    if (crossing.entering) {
      const bool is_new = !media.holds(seen.path->media, crossing.object);
      if (is_new && entered.size() < most_media_at_once) entered.push_back(crossing);
    } else {
      passage.media = media.left(passage.media, crossing.object);
    }
  };
  for (const RayHit& crossing : work_.rays.here) pass(crossing, true);
  for (const RayHit& crossing : work_.rays.near) pass(crossing, false);

  const auto exit_of = [&](std::uint32_t object) { return data_.stay(behind, object, work_.rays).exit; };
  sort_outermost_first(entered, exit_of);
  for (const RayHit& crossing : entered) {
    const Medium medium{crossing.object, data_.hit_material(crossing)};
    passage.media = entered_in_order(media, passage.media, medium, exit_of);
  }
}

double Tracer::refractive_index(const MediaLists& lists, MediaLists::List media) const {
  constexpr double vacuum = 1;
  if (media == MediaLists::empty) return vacuum;
  return data_.materials()[lists.innermost(media).material].description->refractive_index;
}

void Tracer::go_on(const Seen& seen) {
  SampleWork& work = *seen.work;
  std::vector<PathRay>& pending = work.pending;
  const std::size_t place = next_round_->count;
  if (!work.goes_on) {
    if (pending.empty()) return;
    if (work.rays == most_rays_per_sample) {
      ++work_.stats.samples_over_ray_bound;
      for (const PathRay& dropped : pending) seen.sample->dropped += largest_component(dropped.path.weight);
      pending.clear();
      return;
    }
    next_round_->rays[place] = pending.back().ray;
    next_round_->paths[place] = pending.back().path;
    pending.pop_back();
  }
  work.goes_on = false;
  ++work.rays;
  work.media.release(next_round_->paths[place].media_mark);
  next_round_->works[place] = &work;
  next_round_->samples[place] = seen.sample;
  ++next_round_->count;
}

}  // namespace crt::core
