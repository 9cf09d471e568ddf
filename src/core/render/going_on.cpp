// The parts of the tracer about rays that go on from a surface: mirrored, or through it.
#include "core/math/vector.hpp"
#include "core/render/media_order.hpp"
#include "core/render/surface_hit.hpp"
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

void Tracer::split(std::size_t ray) {
  const SurfaceLane lit = surface(ray);
  const SurfaceHit& hit = lit.hit();
  double mirror_share = hit.material->description->reflectivity;
  if (mirror_share <= 0 && hit.transparency <= 0) return;

  const Vec3& direction = round_->rays[ray].direction;
  const Rgb& weight = round_->paths[ray].weight;
  const Vec3 normal = lit.normal();
  const Vec3 face_normal = lit.face_normal();
  const MediaLists::List before = round_->paths[ray].media;
  MediaLists& media = round_->works[ray]->media;
  const std::uint32_t mirror_media_mark = media.mark();
  Passage open;
  Refraction refraction;
  Rgb through_weight(0);
  if (hit.transparency > 0) {
    pass(ray, open);
    refraction =
        refract(direction, normal, refractive_index(media, before), refractive_index(media, open.media));
    mirror_share += open.transparency * refraction.reflectance;
    through_weight = open.transparency * (1 - refraction.reflectance) * weight * open.color;
  }
  const Rgb mirror_weight = mirror_share * weight;
  const bool mirrors = mirror_share > 0 && is_worth_it(ray, mirror_weight);
  const bool goes_through = !is_black(through_weight) && is_worth_it(ray, through_weight);

  // What goes through is followed first; media lists made for it are dropped before the other's turn.
  if (mirrors) {
    const Departure mirror = depart(ray, RayKind::reflection, mirror_weight, goes_through);
    mirror.ray->direction = kept_on_side(mirrored(direction, normal), face_normal);
    mirror.ray->start = hit.start;
    mirror.path->media = before;
    mirror.path->media_mark = mirror_media_mark;
  }
  if (goes_through) {
    const Departure through = depart(ray, RayKind::refraction, through_weight, false);
    through.ray->direction = kept_on_side(refraction.direction, -face_normal);
    through.ray->start = hit.start_behind();
    through.path->media = open.media;
    through.path->media_mark = media.mark();
    if (data_.is_solid(hits_[ray])) ++work_.stats.media_changes;
  }
}

bool Tracer::is_worth_it(std::size_t ray, const Rgb& weight) {
  const double least = frame_.settings().min_weight;
  const bool is_too_weak = weight.x < least && weight.y < least && weight.z < least;
  const bool is_too_deep = round_->paths[ray].bounces >= frame_.settings().recursion_depth;
  if (!is_too_weak && !is_too_deep) return true;
  ++(is_too_weak ? work_.stats.rays_below_min_weight : work_.stats.rays_beyond_depth);
  round_->samples[ray]->dropped += largest_component(weight);
  return false;
}

Tracer::Departure Tracer::depart(std::size_t ray, RayKind kind, const Rgb& weight, bool waits) {
  SampleWork& work = *round_->works[ray];
  const PathState& path = round_->paths[ray];
  Departure departure{};
  if (waits || work.rays == most_rays_per_sample) {
    PathRay& pending = work.pending.emplace_back();
    departure = {&pending.ray, &pending.path};
  } else {
    work.goes_on = true;
    departure = {&next_round_->rays[next_round_->count], &next_round_->paths[next_round_->count]};
  }
  departure.ray->origin = surface(ray).position();
  departure.path->kind = kind;
  departure.path->bounces = path.bounces + 1;
  departure.path->path_length = path.path_length + hits_[ray].t;
  departure.path->weight = weight;
  return departure;
}

void Tracer::pass(std::size_t ray, Passage& passage) {
  const SurfaceLane lit = surface(ray);
  const RayHit& hit = hits_[ray];
  const MediaLists::List before = round_->paths[ray].media;
  MediaLists& media = round_->works[ray]->media;
  passage.transparency = lit.hit().transparency;
  passage.color = lit.color();
  passage.media = before;
  const auto ray_behind = [&] {
    return WorldRay{.origin = lit.position(),
                    .direction = round_->rays[ray].direction,
                    .start = lit.hit().start_behind()};
  };
  if (hit.has_company) {
    pass_company(ray_behind(), ray, passage);
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
void Tracer::pass_company(const WorldRay& behind, std::size_t ray, Passage& passage) {
  const RayHit& hit = hits_[ray];
  const WorldRay& before = round_->rays[ray];
  MediaLists& media = round_->works[ray]->media;
  data_.intersect(before, work_.rays);  // once more: others have been asked for since then
  std::vector<RayHit>& entered = work_.entered;
  entered.clear();
  const auto pass = [&](const RayHit& crossing, bool at_place) {
    const bool solid = data_.is_solid(crossing);
    const bool passed = solid ? data_.stay(behind, crossing.object, work_.rays).inside == crossing.entering
                              : at_place || crossing.t - hit.t <= behind.start.t_error;
    if (!passed) return;
    if (crossing.leaf != hit.leaf || crossing.face != hit.face || crossing.root != hit.root) {
      const CrossingFilter filter = crossing_filter(data_, before, crossing, work_.stats);
      passage.transparency *= filter.transparency;
      passage.color *= filter.color;
    }
    if (!solid) return;
    if (crossing.entering) {
      const bool is_new = !media.holds(round_->paths[ray].media, crossing.object);
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

void Tracer::go_on(std::size_t ray) {
  SampleWork& work = *round_->works[ray];
  Sample& sample = *round_->samples[ray];
  std::vector<PathRay>& pending = work.pending;
  const std::size_t place = next_round_->count;
  if (!work.goes_on) {
    if (work.rays == most_rays_per_sample) {
      ++work_.stats.samples_over_ray_bound;
      for (const PathRay& dropped : pending) sample.dropped += largest_component(dropped.path.weight);
      pending.clear();
      return;
    }
    next_round_->rays[place] = pending.back().ray;
    next_round_->paths[place] = pending.back().path;
    pending.pop_back();
  }
  work.goes_on = false;
  ++work.rays;
  const PathState& path = next_round_->paths[place];
  RenderStats& stats = work_.stats;
  ++(path.kind == RayKind::reflection ? stats.reflection_rays : stats.refraction_rays);
  work.media.release(path.media_mark);
  next_round_->works[place] = &work;
  next_round_->samples[place] = &sample;
  ++next_round_->count;
}

}  // namespace crt::core
