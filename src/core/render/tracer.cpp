#include "core/render/tracer.hpp"

#include <cmath>
#include <limits>
#include <optional>

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
}

void Tracer::trace(std::span<const CameraRay> rays, std::span<Sample> samples) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    SampleWork& work = work_.samples[i];
    work.media.release(camera_media_mark_);
    work.pending.clear();
    work.rays = 1;
    samples[i] = {};
    Seen& seen = round_[i];
    seen.work = &work;
    seen.sample = &samples[i];
    start_path(rays[i], work.media, seen.path);
  }
  std::size_t count = rays.size();
  do {
    follow(std::span(round_).first(count));
    count = take_round(samples.first(rays.size()));
  } while (count > 0);
}

std::size_t Tracer::take_round(std::span<Sample> samples) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    SampleWork& work = work_.samples[i];
    if (work.pending.empty()) continue;
    if (work.rays++ == most_rays_per_sample) {
      ++work_.stats.samples_over_ray_bound;
      work.pending.clear();
      continue;
    }
    Seen& seen = round_[count++];
    seen.work = &work;
    seen.sample = &samples[i];
    seen.path = work.pending.back();
    work.pending.pop_back();
    work.media.release(seen.path.media_mark);
  }
  return count;
}

void Tracer::start_path(const CameraRay& camera_ray, MediaLists& media, PathRay& path) {
  path = {.ray = Frame::eye_ray(camera_ray), .media = camera_media_};
  if (frame_.features().transparency && !frame_.one_viewpoint()) {
    find_surrounding_media(data_, path.ray, work_.surrounding, work_);
    path.media = nested(media, work_.surrounding);
  }
  path.media_mark = media.mark();
}

void Tracer::follow(std::span<Seen> round) {
  std::array<WorldRay, packet_size> rays;
  std::array<RayHit, packet_size> hits;
  for (std::size_t i = 0; i < round.size(); ++i) rays[i] = round[i].path.ray;
  tick(static_cast<unsigned>(round.size()));
  const bool together = go_together(std::span(rays).first(round.size()));
  if (together) data_.intersect(std::span(rays).first(round.size()), hits, work_.rays);

  std::array<Seen*, packet_size> on_surface;
  std::size_t count = 0;
  for (std::size_t i = 0; i < round.size(); ++i) {
    Seen& seen = round[i];
    const bool ask_alone = !together || (hits[i].has_company && frame_.features().transparency);
    seen.hit = ask_alone ? data_.intersect(rays[i], work_.rays) : hits[i];
    if (see(seen)) on_surface[count++] = &seen;
  }
  add_light(std::span(on_surface).first(count));
  for (std::size_t i = 0; i < count; ++i) {
    Seen& seen = *on_surface[i];
    seen.sample->color += seen.weight * seen.light;
    split(seen);
  }
}

bool Tracer::see(Seen& seen) {
  const PathRay& path = seen.path;
  RenderStats& stats = work_.stats;
  ++(path.kind == RayKind::camera       ? stats.camera_rays
     : path.kind == RayKind::reflection ? stats.reflection_rays
                                        : stats.refraction_rays);
  if (seen.hit.has_company && frame_.features().transparency) seen.hit = seen_of(path, seen.hit);
  seen.weight = path.weight;
  if (!pass_medium(seen)) return false;
  if (!seen.hit.found()) {
    see_background(seen);
    return false;
  }
  look_up(data_, path.ray, seen.hit, work_, seen.surface);
  const SurfaceHit& surface = seen.surface;
  const Material& material = *surface.material->description;
  seen.light = ambient_light(frame_.ambient(), material.reflectivity);
  seen.phong = {.color = surface.color,
                .diffuse = surface.material->diffuse(surface.transparency),
                .specular = material.specular,
                .shininess = material.shininess,
                .normal = surface.normal,
                .view = path.ray.direction};
  seen.start.reset();
  return true;
}

bool Tracer::pass_medium(Seen& seen) const {
  if (!frame_.features().absorption || seen.path.media == MediaLists::empty) return true;
  const Medium& medium = seen.work->media.innermost(seen.path.media);
  seen.weight *= transmittance(data_.materials()[medium.material], seen.hit.t);
  return !is_black(seen.weight);
}

void Tracer::see_background(Seen& seen) const {
  const Color background = data_.background().color(seen.path.ray.direction);
  if (seen.path.kind == RayKind::camera) {
    seen.sample->alpha = background.a;
    seen.sample->color += background.a * seen.weight * rgb(background);
  } else {
    seen.sample->color += seen.weight * rgb(background);
  }
}

std::optional<Tracer::Unhidden> Tracer::unhidden(const PreparedLight& source, Seen& seen) const {
  if (seen.phong.diffuse <= 0 && seen.phong.specular <= 0) return std::nullopt;
  const Vec3& position = seen.surface.point.position;
  const std::optional<LightSample> sample = source.sample(position, seen.path.path_length + seen.hit.t);
  if (!sample || glm::dot(sample->direction, seen.surface.face_normal) <= 0) return std::nullopt;
  const Rgb light = direct_light(seen.phong, *sample, source.color());
  if (is_black(light)) return std::nullopt;
  if (!seen.start) seen.start = data_.start_point(seen.path.ray, seen.hit, seen.surface.viewer_side);
  return Unhidden{.light = light,
                  .shadow_ray = {.origin = position,
                                 .direction = sample->direction,
                                 .t_max = sample->distance,
                                 .start = *seen.start,
                                 .end_error = lamp_error(position, *sample)}};
}

void Tracer::add_light(std::span<Seen*> seen) {
  std::array<WorldRay, packet_size> rays;
  std::array<Seen*, packet_size> lit;
  std::array<Rgb, packet_size> lights;
  for (const PreparedLight& source : frame_.lights()) {
    std::size_t count = 0;
    for (Seen* surface : seen) {
      const std::optional<Unhidden> reaching = unhidden(source, *surface);
      if (!reaching) continue;
      rays[count] = reaching->shadow_ray;
      lights[count] = reaching->light;
      lit[count++] = surface;
    }
    work_.stats.shadow_rays += count;
    tick(static_cast<unsigned>(count));
    const RayMask hidden = data_.occluded_each(std::span(rays).first(count), work_.rays);
    for (std::size_t i = 0; i < count; ++i)
      lit[i]->light += lights[i] * light_share_of(rays[i], *lit[i], (hidden >> i & 1u) != 0);
  }
}

Rgb Tracer::light_share_of(const WorldRay& shadow_ray, const Seen& seen, bool hidden) {
  const Features& features = frame_.features();
  if (!hidden) {
    if (!features.absorption || seen.path.media == MediaLists::empty) return Rgb(1);
  } else if (!features.transparency) {
    return Rgb(0);
  }
  return light_share(data_, shadow_ray, seen.work->media, seen.path.media, work_);
}

void Tracer::split(Seen& seen) {
  const SurfaceHit& surface = seen.surface;
  double mirror_share = surface.material->description->reflectivity;
  if (mirror_share <= 0 && surface.transparency <= 0) return;

  const PathRay& path = seen.path;
  const RayHit& hit = seen.hit;
  MediaLists& media = seen.work->media;
  PathRay next;
  next.ray.origin = surface.point.position;
  next.bounces = path.bounces + 1;
  next.path_length = path.path_length + hit.t;

  PathRay mirror = next;
  mirror.media = path.media;
  mirror.media_mark = media.mark();

  PathRay through = next;
  through.weight = Rgb(0);
  if (surface.transparency > 0) {
    const Side far_side = surface.viewer_side == Side::outside ? Side::inside : Side::outside;
    through.ray.start = data_.start_point(path.ray, hit, far_side);
    const Passage open = passage(seen, through.ray.start);
    through.media = open.media;
    through.media_mark = media.mark();
    const Refraction refraction =
        refract(path.ray.direction, surface.normal, refractive_index(media, path.media),
                refractive_index(media, through.media));
    mirror_share += open.transparency * refraction.reflectance;
    through.weight = open.transparency * (1 - refraction.reflectance) * seen.weight * open.color;
    through.ray.direction = kept_on_side(refraction.direction, -surface.face_normal);
  }

  // The last one pushed is followed first; media lists made for it are dropped before the other's turn.
  if (mirror_share > 0) {
    mirror.kind = RayKind::reflection;
    mirror.weight = mirror_share * seen.weight;
    mirror.ray.direction = kept_on_side(mirrored(path.ray.direction, surface.normal), surface.face_normal);
    mirror.ray.start = data_.start_point(path.ray, hit, surface.viewer_side);
    push(*seen.work, mirror);
  }
  if (!is_black(through.weight)) {
    through.kind = RayKind::refraction;
    if (push(*seen.work, through) && surface.point.solid) ++work_.stats.media_changes;
  }
}

bool Tracer::push(SampleWork& work, const PathRay& path) {
  const double least = frame_.settings().min_weight;
  if (path.weight.x < least && path.weight.y < least && path.weight.z < least) {
    ++work_.stats.rays_below_min_weight;
    return false;
  }
  if (path.bounces > frame_.settings().recursion_depth) {
    ++work_.stats.rays_beyond_depth;
    return false;
  }
  work.pending.push_back(path);
  return true;
}

RayHit Tracer::seen_of(const PathRay& path, const RayHit& hit) {
  RayHit seen = hit;
  double least = std::numeric_limits<double>::infinity();
  for (const RayHit& crossing : work_.rays.here) {
    const double transparency = crossing_filter(data_, path.ray, crossing, work_.stats).transparency;
    if (!(transparency < least)) continue;
    least = transparency;
    seen = crossing;
  }
  seen.has_company = true;
  return seen;
}

Tracer::Passage Tracer::passage(const Seen& seen, const StartPoint& behind) {
  const SurfaceHit& surface = seen.surface;
  const PathRay& path = seen.path;
  MediaLists& media = seen.work->media;
  Passage passage{.transparency = surface.transparency, .color = surface.color, .media = path.media};
  const WorldRay ray = {.origin = surface.point.position, .direction = path.ray.direction, .start = behind};
  if (seen.hit.has_company) {
    pass_company(ray, seen, passage);
  } else if (surface.point.solid) {
    const auto exit_of = [&](std::uint32_t object) { return data_.stay(ray, object, work_.rays).exit; };
    const Medium medium{surface.point.object, surface.point.material};
    passage.media = surface.point.entering ? entered_in_order(media, path.media, medium, exit_of)
                                           : media.left(path.media, medium.object);
  }
  return passage;
}

// A ray that starts at the hit finds some crossings next to it behind itself, whatever rounding makes of
// their order: which of them it has passed is told by what it starts inside of.
void Tracer::pass_company(const WorldRay& behind, const Seen& seen, Passage& passage) {
  const PathRay& path = seen.path;
  const RayHit& hit = seen.hit;
  MediaLists& media = seen.work->media;
  data_.intersect(path.ray, work_.rays);  // once more: others have been asked for since then
  std::vector<RayHit>& entered = work_.entered;
  entered.clear();
  const auto pass = [&](const RayHit& crossing, bool at_place) {
    const bool solid = data_.is_solid(crossing);
    const bool passed = solid ? data_.stay(behind, crossing.object, work_.rays).inside == crossing.entering
                              : at_place || crossing.t - hit.t <= behind.start.t_error;
    if (!passed) return;
    if (crossing.leaf != hit.leaf || crossing.face != hit.face || crossing.root != hit.root) {
      const CrossingFilter filter = crossing_filter(data_, path.ray, crossing, work_.stats);
      passage.transparency *= filter.transparency;
      passage.color *= filter.color;
    }
    if (!solid) return;
    if (crossing.entering) {
      const bool is_new = !media.holds(path.media, crossing.object);
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

void Tracer::tick(unsigned rays) {
  ticks_ += rays;
  if (ticks_ < ticks_per_poll) return;
  ticks_ = 0;
  progress_.poll();
}

}  // namespace crt::core
