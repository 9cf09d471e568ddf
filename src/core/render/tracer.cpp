#include "core/render/tracer.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "core/math/vector.hpp"
#include "core/render/media_order.hpp"
#include "core/render/shadow.hpp"
#include "core/shading/fresnel.hpp"

namespace crt::core {

namespace {

/// A sample follows no more rays than this: where every hit sends two full-weight rays on, a deep
/// recursion would not end in a lifetime. With weights that add up to 1 it is never reached.
constexpr int most_rays_per_sample = 65536;

/// Rays between two looks at the progress.
constexpr unsigned ticks_per_poll = 256;

MediaLists::List nested(MediaLists& lists, const std::vector<Medium>& outermost_first) {
  MediaLists::List list = MediaLists::empty;
  for (const Medium& medium : outermost_first) list = lists.entered(list, medium);
  return list;
}

/// How far rounding may put a lamp from a surface that it is meant to be on.
double lamp_error(const Vec3& point, const LightSample& sample) {
  if (std::isinf(sample.distance)) return 0;
  constexpr double roundings = 16;
  return roundings * unit_roundoff *
         std::fma(sample.distance, largest_component(sample.direction), largest_component(point));
}

/// A surface as it is met: a primitive, the triangles of a mesh all alike.
std::uint64_t met(const HitPoint& point, RayKind kind) {
  constexpr std::uint64_t is_surface = std::uint64_t{1} << 32;
  constexpr std::uint64_t is_entered = std::uint64_t{1} << 33;
  constexpr int place_of_kind = 34;
  return (point.solid ? point.leaf : is_surface | point.entity_id) | (point.entering ? is_entered : 0) |
         static_cast<std::uint64_t>(kind) << place_of_kind;
}

/// A lamp's shadow.
std::uint64_t shaded_from(std::size_t lamp) {
  return std::uint64_t{1} << 40 | lamp;
}

/// A bump may send a ray to the wrong side of the face; it then bounces off the face once more.
Vec3 kept_on_side(const Vec3& direction, const Vec3& side) {
  return glm::dot(direction, side) < 0 ? mirrored(direction, side) : direction;
}

}  // namespace

Tracer::Tracer(const Frame& frame, Workspace& work, Progress& progress)
    : frame_(frame), data_(frame.data()), work_(work), progress_(progress) {
  for (SampleWork& sample : work.samples) {
    sample.media.release(0);
    camera_media_ = nested(sample.media, frame.camera_media());
    camera_media_mark_ = sample.media.mark();
  }
  for (std::size_t i = 0; i < packet_size; ++i) seen_[i].hit = &hits_[i];
}

void Tracer::trace(std::span<const CameraRay> rays, std::span<Sample> samples,
                   std::span<FirstHit> first_hits) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    SampleWork& work = work_.samples[i];
    work.media.release(camera_media_mark_);
    work.pending.clear();
    work.goes_on = false;
    work.rays = 1;
    samples[i] = {};
    round_->works[i] = &work;
    round_->samples[i] = &samples[i];
    start_path(rays[i], work.media, round_->rays[i], round_->paths[i]);
  }
  round_->count = rays.size();
  while (round_->count > 0) {
    follow();
    if (!first_hits.empty()) tell_first_hits(std::exchange(first_hits, {}));
    std::swap(round_, next_round_);
  }
}

void Tracer::start_path(const CameraRay& camera_ray, MediaLists& media, WorldRay& ray, PathState& path) {
  Frame::eye_ray(camera_ray, ray);
  path = {.media = camera_media_};
  if (frame_.features().transparency && !frame_.one_viewpoint()) {
    find_surrounding_media(data_, ray, work_.surrounding, work_);
    path.media = nested(media, work_.surrounding);
  }
  path.media_mark = media.mark();
}

void Tracer::follow() {
  const std::size_t count = round_->count;
  const std::span<const WorldRay> rays = std::span(round_->rays).first(count);
  tick(static_cast<unsigned>(count));
  const bool together = go_together(rays);
  if (together) data_.intersect(rays, hits_, work_.rays);

  std::array<Seen*, packet_size> on_surface;
  std::size_t surfaces = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Seen& seen = seen_[i];
    seen.work = round_->works[i];
    seen.sample = round_->samples[i];
    seen.ray = &rays[i];
    seen.path = &round_->paths[i];
    const bool ask_alone = !together || (hits_[i].has_company && frame_.features().transparency);
    if (ask_alone) hits_[i] = data_.intersect(rays[i], work_.rays);
    seen.is_on_surface = see(seen);
    if (seen.is_on_surface) on_surface[surfaces++] = &seen;
  }
  add_light(std::span(on_surface).first(surfaces));
  next_round_->count = 0;
  for (Seen& seen : std::span(seen_).first(count)) {
    if (seen.is_on_surface) {
      seen.sample->color += seen.weight * seen.light;
      split(seen);
    }
    go_on(seen);
  }
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

bool Tracer::see(Seen& seen) {
  const PathState& path = *seen.path;
  RenderStats& stats = work_.stats;
  ++(path.kind == RayKind::camera       ? stats.camera_rays
     : path.kind == RayKind::reflection ? stats.reflection_rays
                                        : stats.refraction_rays);
  if (seen.hit->has_company && frame_.features().transparency) *seen.hit = seen_of(*seen.ray, *seen.hit);
  seen.weight = path.weight;
  if (!pass_medium(seen)) return false;
  if (!seen.hit->found()) {
    see_background(seen);
    return false;
  }
  look_up(data_, *seen.ray, *seen.hit, work_, seen.surface);
  if (identifies_) note(*seen.sample, met(seen.surface.point, seen.path->kind));
  const SurfaceHit& surface = seen.surface;
  const Material& material = *surface.material->description;
  seen.light = ambient_light(frame_.ambient(), material.reflectivity);
  return true;
}

bool Tracer::pass_medium(Seen& seen) const {
  if (!frame_.features().absorption || seen.path->media == MediaLists::empty) return true;
  const Medium& medium = seen.work->media.innermost(seen.path->media);
  seen.weight *= transmittance(data_.materials()[medium.material], seen.hit->t);
  return !is_black(seen.weight);
}

void Tracer::see_background(Seen& seen) const {
  if (identifies_) note(*seen.sample, nothing);
  const Color background = data_.background().color(seen.ray->direction);
  if (seen.path->kind == RayKind::camera) {
    seen.sample->alpha = background.a;
    seen.sample->color += background.a * seen.weight * rgb(background);
  } else {
    seen.sample->color += seen.weight * rgb(background);
  }
}

bool Tracer::reaches(const PreparedLight& source, const Seen& seen, Rgb& light, WorldRay& shadow_ray) const {
  const PhongSurface& phong = seen.surface.phong;
  if (phong.diffuse <= 0 && phong.specular <= 0) return false;
  const Vec3& position = seen.surface.point.position;
  LightSample sample;
  if (!source.sample(position, seen.path->path_length + seen.hit->t, sample)) return false;
  if (glm::dot(sample.direction, seen.surface.face_normal) <= 0) return false;
  light = direct_light(phong, sample, source.color());
  if (is_black(light)) return false;
  shadow_ray.origin = position;
  shadow_ray.direction = sample.direction;
  shadow_ray.t_max = sample.distance;
  shadow_ray.start = seen.surface.start;
  shadow_ray.end_error = lamp_error(position, sample);
  return true;
}

void Tracer::add_light(std::span<Seen*> seen) {
  std::array<Seen*, packet_size> lit;
  std::array<Rgb, packet_size> lights;
  std::size_t lamp = 0;
  for (const PreparedLight& source : frame_.lights()) {
    std::size_t count = 0;
    for (Seen* surface : seen) {
      if (reaches(source, *surface, lights[count], shadow_rays_[count])) lit[count++] = surface;
    }
    work_.stats.shadow_rays += count;
    tick(static_cast<unsigned>(count));
    const RayMask hidden = data_.occluded_each(std::span(shadow_rays_).first(count), work_.rays);
    for (std::size_t i = 0; i < count; ++i) {
      const bool is_hidden = (hidden >> i & 1u) != 0;
      if (is_hidden && identifies_) note(*lit[i]->sample, shaded_from(lamp));
      lit[i]->light += lights[i] * light_share_of(shadow_rays_[i], *lit[i], is_hidden);
    }
    ++lamp;
  }
}

Rgb Tracer::light_share_of(const WorldRay& shadow_ray, const Seen& seen, bool hidden) {
  const Features& features = frame_.features();
  if (!hidden) {
    if (!features.absorption || seen.path->media == MediaLists::empty) return Rgb(1);
  } else if (!features.transparency) {
    return Rgb(0);
  }
  return light_share(data_, shadow_ray, seen.work->media, seen.path->media, work_);
}

void Tracer::split(const Seen& seen) {
  const SurfaceHit& surface = seen.surface;
  const Vec3& normal = surface.phong.normal;
  double mirror_share = surface.material->description->reflectivity;
  if (mirror_share <= 0 && surface.transparency <= 0) return;

  const WorldRay& ray = *seen.ray;
  const MediaLists::List before = seen.path->media;
  MediaLists& media = seen.work->media;
  const std::uint32_t mirror_media_mark = media.mark();
  Passage open;
  Refraction refraction;
  Rgb through_weight(0);
  if (surface.transparency > 0) {
    pass(seen, open);
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
    const Departure mirror = depart(seen, RayKind::reflection, mirror_weight, goes_through);
    mirror.ray->direction = kept_on_side(mirrored(ray.direction, normal), surface.face_normal);
    mirror.ray->start = surface.start;
    mirror.path->media = before;
    mirror.path->media_mark = mirror_media_mark;
  }
  if (goes_through) {
    const Departure through = depart(seen, RayKind::refraction, through_weight, false);
    through.ray->direction = kept_on_side(refraction.direction, -surface.face_normal);
    through.ray->start = surface.start_behind();
    through.path->media = open.media;
    through.path->media_mark = media.mark();
    if (surface.point.solid) ++work_.stats.media_changes;
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

Tracer::Departure Tracer::depart(const Seen& seen, RayKind kind, const Rgb& weight, bool waits) {
  SampleWork& work = *seen.work;
  Departure departure{};
  if (waits || work.rays == most_rays_per_sample) {
    PathRay& pending = work.pending.emplace_back();
    departure = {&pending.ray, &pending.path};
  } else {
    work.goes_on = true;
    departure = {&next_round_->rays[next_round_->count], &next_round_->paths[next_round_->count]};
  }
  departure.ray->origin = seen.surface.point.position;
  departure.path->kind = kind;
  departure.path->bounces = seen.path->bounces + 1;
  departure.path->path_length = seen.path->path_length + seen.hit->t;
  departure.path->weight = weight;
  return departure;
}

RayHit Tracer::seen_of(const WorldRay& ray, const RayHit& hit) {
  RayHit seen = hit;
  double least = std::numeric_limits<double>::infinity();
  for (const RayHit& crossing : work_.rays.here) {
    const double transparency = crossing_filter(data_, ray, crossing, work_.stats).transparency;
    if (!(transparency < least)) continue;
    least = transparency;
    seen = crossing;
  }
  seen.has_company = true;
  return seen;
}

void Tracer::pass(const Seen& seen, Passage& passage) {
  const SurfaceHit& surface = seen.surface;
  const MediaLists::List before = seen.path->media;
  MediaLists& media = seen.work->media;
  passage.transparency = surface.transparency;
  passage.color = surface.phong.color;
  passage.media = before;
  const auto ray_behind = [&] {
    return WorldRay{
        .origin = surface.point.position, .direction = seen.ray->direction, .start = surface.start_behind()};
  };
  if (seen.hit->has_company) {
    pass_company(ray_behind(), seen, passage);
  } else if (surface.point.solid) {
    const auto exit_of = [&](std::uint32_t object) {
      return data_.stay(ray_behind(), object, work_.rays).exit;
    };
    const Medium medium{surface.point.object, surface.point.material};
    passage.media = surface.point.entering ? entered_in_order(media, before, medium, exit_of)
                                           : media.left(before, medium.object);
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

void Tracer::note(Sample& sample, std::uint64_t thing) {
  constexpr std::uint64_t factor = 0x9e3779b97f4a7c15u;  // 2^64 / the golden ratio
  const std::uint64_t mixed = (sample.identity ^ thing) * factor;
  sample.identity = mixed ^ mixed >> 29;
}

void Tracer::tick(unsigned rays) {
  ticks_ += rays;
  if (ticks_ < ticks_per_poll) return;
  ticks_ = 0;
  progress_.poll();
}

}  // namespace crt::core
