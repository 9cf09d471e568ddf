#include "core/render/tracer.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "core/math/vector.hpp"
#include "core/render/shadow.hpp"

namespace crt::core {

namespace {

/// The rays of one group of lanes.
constexpr RayMask group_mask = (RayMask{1} << lane_count) - 1;

/// Rays between two looks at the progress.
constexpr unsigned ticks_per_poll = 256;

MediaLists::List nested(MediaLists& lists, const std::vector<Medium>& outermost_first) {
  MediaLists::List list = MediaLists::empty;
  for (const Medium& medium : outermost_first) list = lists.entered(list, medium);
  return list;
}

/// How far rounding may put a lamp from surfaces that it is meant to be on.
Lanes lamp_errors(const VectorLanes& points, const LightSamples& light) {
  constexpr double roundings = 16;
  const Lanes error = roundings * unit_roundoff *
                      fma(light.distances, largest_component(light.directions), largest_component(points));
  return light.distances == std::numeric_limits<double>::infinity() ? Lanes{} : error;
}

LaneMask is_black(const VectorLanes& light) {
  return (light.x == 0.0) & (light.y == 0.0) & (light.z == 0.0);
}

/// A surface as it is met: a primitive, the triangles of a mesh all alike.
std::uint64_t met(const PreparedData& data, const RayHit& hit, RayKind kind) {
  constexpr std::uint64_t is_surface = std::uint64_t{1} << 32;
  constexpr std::uint64_t is_entered = std::uint64_t{1} << 33;
  constexpr int place_of_kind = 34;
  return (data.is_solid(hit) ? hit.leaf : is_surface | data.entity_id(hit)) |
         (hit.entering ? is_entered : 0) | static_cast<std::uint64_t>(kind) << place_of_kind;
}

/// A lamp's shadow.
std::uint64_t shaded_from(std::size_t lamp) {
  return std::uint64_t{1} << 40 | lamp;
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

  RayMask on_surface = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Seen& seen = seen_[i];
    seen.work = round_->works[i];
    seen.sample = round_->samples[i];
    seen.ray = &rays[i];
    seen.path = &round_->paths[i];
    const bool ask_alone = !together || (hits_[i].has_company && frame_.features().transparency);
    if (ask_alone) hits_[i] = data_.intersect(rays[i], work_.rays);
    on_surface |= static_cast<RayMask>(see(seen, surface(i))) << i;
  }
  look_up_each(on_surface);
  add_light(on_surface);
  next_round_->count = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Seen& seen = seen_[i];
    if ((on_surface >> i & 1u) != 0) {
      seen.sample->color += seen.weight * surface(i).light();
      if (!surface(i).hit().material->ends_paths) split(seen, surface(i));
    }
    go_on(seen);
  }
}

bool Tracer::see(Seen& seen, const SurfaceLane& surface) {
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
  const PreparedMaterial& material = data_.materials()[data_.hit_material(*seen.hit)];
  surface.hit().material = &material;
  surface.group.light.set(surface.lane, ambient_light(frame_.ambient(), material.description->reflectivity));
  surface.group.path_length[static_cast<int>(surface.lane)] = path.path_length + seen.hit->t;
  if (identifies_) note(*seen.sample, met(data_, *seen.hit, path.kind));
  return true;
}

void Tracer::look_up_each(RayMask on_surface) {
  for (std::size_t first = 0; on_surface >> first != 0; first += lane_count) {
    RayMask uniform = 0;
    RayMask others = 0;
    SurfaceGroup& group = surfaces_[first / lane_count];
    for_each_ray(on_surface >> first & group_mask, [&](std::size_t lane) {
      (group.hits[lane].material->uniform() ? uniform : others) |= RayMask{1} << lane;
    });
    const auto rays = std::span(round_->rays).subspan(first).first<lane_count>();
    const auto hits = std::span(hits_).subspan(first).first<lane_count>();
    if (uniform != 0) look_up_uniform(data_, rays, hits, uniform, group);
    for_each_ray(others, [&](std::size_t lane) {
      look_up(data_, rays[lane], hits[lane], work_, {group, lane});
    });
  }
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

void Tracer::send_to(const PreparedLight& source, RayMask on_surface) {
  shadows_.count = 0;
  for (std::size_t first = 0; on_surface >> first != 0; first += lane_count) {
    const SurfaceGroup& surfaces = surfaces_[first / lane_count];
    const PhongSurfaces& phong = surfaces.phong;
    LightSamples sample;
    LaneMask lit = (phong.diffuse > 0.0) | (phong.specular > 0.0);
    lit &= source.sample(surfaces.position, surfaces.path_length, sample);
    lit &= dot(sample.directions, surfaces.face_normal) > 0.0;
    const VectorLanes light = direct_light(phong, sample, source.color(), lit);
    lit &= ~is_black(light);
    const Lanes end_errors = lamp_errors(surfaces.position, sample);
    for_each_ray(mask_of(lit) & on_surface >> first & group_mask, [&](std::size_t lane) {
      const std::size_t index = shadows_.count++;
      shadows_.surfaces[index] = first + lane;
      shadows_.lights[index] = light[lane];
      WorldRay& ray = shadows_.rays[index];
      ray.origin = surfaces.position[lane];
      ray.direction = sample.directions[lane];
      ray.t_max = sample.distances[static_cast<int>(lane)];
      ray.start = surfaces.hits[lane].start;
      ray.end_error = end_errors[static_cast<int>(lane)];
    });
  }
}

void Tracer::add_light(RayMask on_surface) {
  std::size_t lamp = 0;
  for (const PreparedLight& source : frame_.lights()) {
    send_to(source, on_surface);
    const std::span<const WorldRay> rays = std::span(shadows_.rays).first(shadows_.count);
    work_.stats.shadow_rays += rays.size();
    tick(static_cast<unsigned>(rays.size()));
    const RayMask hidden = data_.occluded_each(rays, work_.rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Seen& seen = seen_[shadows_.surfaces[i]];
      const bool is_hidden = (hidden >> i & 1u) != 0;
      if (is_hidden && identifies_) note(*seen.sample, shaded_from(lamp));
      const SurfaceLane lit = surface(shadows_.surfaces[i]);
      const Rgb light = shadows_.lights[i] * light_share_of(rays[i], seen, is_hidden);
      lit.group.light.set(lit.lane, lit.light() + light);
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
