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
  work_.media.release(0);
  camera_media_ = nested(work_.media, frame.camera_media());
  camera_media_mark_ = work_.media.mark();
}

void Tracer::trace(std::span<const CameraRay> rays, std::span<Sample> samples) {
  if (frame_.features().transparency && !frame_.one_viewpoint()) {
    for (std::size_t i = 0; i < rays.size(); ++i) trace_alone(rays[i], samples[i]);
  } else {
    trace_together(rays, samples);
  }
}

void Tracer::trace_alone(const CameraRay& camera_ray, Sample& sample) {
  sample = {};
  work_.media.release(camera_media_mark_);
  work_.pending.clear();
  work_.pending.push_back(first_path(camera_ray));
  follow_pending(0, sample);
}

void Tracer::follow_pending(int rays, Sample& sample) {
  for (; !work_.pending.empty(); ++rays) {
    if (rays == most_rays_per_sample) {
      ++work_.stats.samples_over_ray_bound;
      break;
    }
    const PathRay path = work_.pending.back();
    work_.pending.pop_back();
    work_.media.release(path.media_mark);
    follow(path, sample);
  }
}

void Tracer::trace_together(std::span<const CameraRay> rays, std::span<Sample> samples) {
  std::array<WorldRay, packet_size> eye_rays;
  std::array<RayHit, packet_size> hits;
  for (std::size_t i = 0; i < rays.size(); ++i) eye_rays[i] = Frame::eye_ray(rays[i]);
  data_.intersect(std::span(eye_rays.data(), rays.size()), hits, work_.rays);
  PathRay path;
  path.media = camera_media_;
  path.media_mark = camera_media_mark_;
  std::size_t seen_count = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    samples[i] = {};
    if (hits[i].has_company && frame_.features().transparency) {
      // All that is there is told of one ray at a time.
      trace_alone(rays[i], samples[i]);
      continue;
    }
    ++work_.stats.camera_rays;
    path.ray = eye_rays[i];
    Rgb weight = path.weight;
    if (!pass_medium(path, hits[i].t, weight)) continue;
    if (!hits[i].found()) {
      see_background(path, weight, samples[i]);
      continue;
    }
    Seen& seen = seen_[seen_count++];
    seen.weight = weight;
    seen.sample = &samples[i];
    see(path, hits[i], seen);
  }
  tick(static_cast<unsigned>(rays.size()));
  const std::span<Seen> all(seen_.data(), seen_count);
  light_together(all);
  for (const Seen& seen : all) {
    seen.sample->color += seen.weight * seen.light;
    work_.media.release(camera_media_mark_);
    work_.pending.clear();
    split(seen);
    follow_pending(1, *seen.sample);
  }
}

PathRay Tracer::first_path(const CameraRay& camera_ray) {
  PathRay path;
  path.ray = Frame::eye_ray(camera_ray);
  path.media = camera_media_;
  if (frame_.features().transparency && !frame_.one_viewpoint()) {
    find_surrounding_media(data_, path.ray, work_.surrounding, work_);
    path.media = nested(work_.media, work_.surrounding);
  }
  path.media_mark = work_.media.mark();
  return path;
}

void Tracer::follow(const PathRay& path, Sample& sample) {
  RenderStats& stats = work_.stats;
  ++(path.kind == RayKind::camera       ? stats.camera_rays
     : path.kind == RayKind::reflection ? stats.reflection_rays
                                        : stats.refraction_rays);
  tick();

  RayHit hit = data_.intersect(path.ray, work_.rays);
  if (hit.has_company && frame_.features().transparency) hit = seen_of(path, hit);
  Rgb weight = path.weight;
  if (!pass_medium(path, hit.t, weight)) return;
  if (!hit.found()) {
    see_background(path, weight, sample);
    return;
  }
  Seen seen;
  seen.weight = weight;
  see(path, hit, seen);
  light_alone(seen);
  sample.color += weight * seen.light;
  split(seen);
}

bool Tracer::pass_medium(const PathRay& path, double length, Rgb& weight) const {
  if (!frame_.features().absorption || path.media == MediaLists::empty) return true;
  weight *= transmittance(data_.materials()[work_.media.innermost(path.media).material], length);
  return !is_black(weight);
}

void Tracer::see_background(const PathRay& path, const Rgb& weight, Sample& sample) const {
  const Color background = data_.background().color(path.ray.direction);
  if (path.kind == RayKind::camera) {
    sample.alpha = background.a;
    sample.color += background.a * weight * rgb(background);
  } else {
    sample.color += weight * rgb(background);
  }
}

void Tracer::see(const PathRay& path, const RayHit& hit, Seen& seen) {
  seen.path = path;
  seen.hit = hit;
  look_up(data_, path.ray, hit, work_, seen.surface);
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

void Tracer::light_alone(Seen& seen) {
  for (const PreparedLight& source : frame_.lights()) {
    const std::optional<Unhidden> reaching = unhidden(source, seen);
    if (!reaching) continue;
    tick();
    seen.light += reaching->light * light_share(data_, reaching->shadow_ray, seen.path.media, work_);
  }
}

void Tracer::light_together(std::span<Seen> all) {
  if (frame_.features().transparency) {
    for (Seen& seen : all) light_alone(seen);
    return;
  }
  std::array<WorldRay, packet_size> shadow_rays;
  std::array<Seen*, packet_size> seen_from;
  std::array<Rgb, packet_size> lights;
  for (const PreparedLight& source : frame_.lights()) {
    std::size_t count = 0;
    for (Seen& seen : all) {
      const std::optional<Unhidden> reaching = unhidden(source, seen);
      if (!reaching) continue;
      shadow_rays[count] = reaching->shadow_ray;
      lights[count] = reaching->light;
      seen_from[count++] = &seen;
    }
    work_.stats.shadow_rays += count;
    tick(static_cast<unsigned>(count));
    const RayMask hidden = data_.occluded(std::span(shadow_rays.data(), count), work_.rays);
    for (std::size_t i = 0; i < count; ++i) {
      if ((hidden >> i & 1u) == 0) seen_from[i]->light += lights[i];
    }
  }
}

void Tracer::split(const Seen& seen) {
  const SurfaceHit& surface = seen.surface;
  double mirror_share = surface.material->description->reflectivity;
  if (mirror_share <= 0 && surface.transparency <= 0) return;

  const PathRay& path = seen.path;
  const RayHit& hit = seen.hit;
  const Rgb& weight = seen.weight;
  PathRay next;
  next.ray.origin = surface.point.position;
  next.bounces = path.bounces + 1;
  next.path_length = path.path_length + hit.t;

  PathRay mirror = next;
  mirror.media = path.media;
  mirror.media_mark = work_.media.mark();

  PathRay through = next;
  through.weight = Rgb(0);
  if (surface.transparency > 0) {
    const Side far_side = surface.viewer_side == Side::outside ? Side::inside : Side::outside;
    through.ray.start = data_.start_point(path.ray, hit, far_side);
    const Passage open = passage(surface, path, hit, through.ray.start);
    through.media = open.media;
    through.media_mark = work_.media.mark();
    const Refraction refraction = refract(path.ray.direction, surface.normal, refractive_index(path.media),
                                          refractive_index(through.media));
    mirror_share += open.transparency * refraction.reflectance;
    through.weight = open.transparency * (1 - refraction.reflectance) * weight * open.color;
    through.ray.direction = kept_on_side(refraction.direction, -surface.face_normal);
  }

  // The last one pushed is followed first; media lists made for it are dropped before the other's turn.
  if (mirror_share > 0) {
    mirror.kind = RayKind::reflection;
    mirror.weight = mirror_share * weight;
    mirror.ray.direction = kept_on_side(mirrored(path.ray.direction, surface.normal), surface.face_normal);
    mirror.ray.start = data_.start_point(path.ray, hit, surface.viewer_side);
    push(mirror);
  }
  if (!is_black(through.weight)) {
    through.kind = RayKind::refraction;
    if (push(through) && surface.point.solid) ++work_.stats.media_changes;
  }
}

bool Tracer::push(const PathRay& path) {
  const double least = frame_.settings().min_weight;
  if (path.weight.x < least && path.weight.y < least && path.weight.z < least) {
    ++work_.stats.rays_below_min_weight;
    return false;
  }
  if (path.bounces > frame_.settings().recursion_depth) {
    ++work_.stats.rays_beyond_depth;
    return false;
  }
  work_.pending.push_back(path);
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

Tracer::Passage Tracer::passage(const SurfaceHit& surface, const PathRay& path, const RayHit& hit,
                                const StartPoint& behind) {
  Passage passage{.transparency = surface.transparency, .color = surface.color, .media = path.media};
  const WorldRay ray = {.origin = surface.point.position, .direction = path.ray.direction, .start = behind};
  if (hit.has_company) {
    pass_company(ray, path, hit, passage);
  } else if (surface.point.solid) {
    const auto exit_of = [&](std::uint32_t object) { return data_.stay(ray, object, work_.rays).exit; };
    const Medium medium{surface.point.object, surface.point.material};
    passage.media = surface.point.entering ? entered_in_order(work_.media, path.media, medium, exit_of)
                                           : work_.media.left(path.media, medium.object);
  }
  return passage;
}

// A ray that starts at the hit finds some crossings next to it behind itself, whatever rounding makes of
// their order: which of them it has passed is told by what it starts inside of.
void Tracer::pass_company(const WorldRay& behind, const PathRay& path, const RayHit& hit, Passage& passage) {
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
      const bool is_new = !work_.media.holds(path.media, crossing.object);
      if (is_new && entered.size() < most_media_at_once) entered.push_back(crossing);
    } else {
      passage.media = work_.media.left(passage.media, crossing.object);
    }
  };
  for (const RayHit& crossing : work_.rays.here) pass(crossing, true);
  for (const RayHit& crossing : work_.rays.near) pass(crossing, false);

  const auto exit_of = [&](std::uint32_t object) { return data_.stay(behind, object, work_.rays).exit; };
  sort_outermost_first(entered, exit_of);
  for (const RayHit& crossing : entered) {
    const Medium medium{crossing.object, data_.hit_material(crossing)};
    passage.media = entered_in_order(work_.media, passage.media, medium, exit_of);
  }
}

double Tracer::refractive_index(MediaLists::List media) const {
  constexpr double vacuum = 1;
  if (media == MediaLists::empty) return vacuum;
  return data_.materials()[work_.media.innermost(media).material].description->refractive_index;
}

void Tracer::tick(unsigned rays) {
  ticks_ += rays;
  if (ticks_ < ticks_per_poll) return;
  ticks_ = 0;
  progress_.poll();
}

}  // namespace crt::core
