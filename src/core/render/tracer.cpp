#include "core/render/tracer.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "core/math/vector.hpp"
#include "core/render/shadow.hpp"
#include "core/render/surface_hit.hpp"

namespace crt::core {

namespace {

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
    : frame_(frame),
      data_(frame.data()),
      work_(work),
      progress_(progress),
      has_transparency_(frame.features().transparency) {
  for (SampleWork& sample : work.samples) {
    sample.media.release(0);
    camera_media_ = nested(sample.media, frame.camera_media());
    camera_media_mark_ = sample.media.mark();
    sample.pending.clear();
  }
}

void Tracer::trace(std::span<const CameraRay> rays, std::span<Sample> samples,
                   std::span<FirstHit> first_hits) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    samples[i] = {};
    round_->samples[i] = &samples[i];
    round_->works[i] = &work_.samples[i];
    round_->works[i]->rays = 1;
    Frame::eye_ray(rays[i], round_->rays[i]);
    round_->paths[i] = {};
    if (has_transparency_) start_media(i);
  }
  work_.stats.camera_rays += rays.size();
  round_->count = rays.size();
  while (round_->count > 0) {
    follow();
    if (!first_hits.empty()) tell_first_hits(std::exchange(first_hits, {}));
    std::swap(round_, next_round_);
  }
}

void Tracer::start_media(std::size_t ray) {
  SampleWork& work = *round_->works[ray];
  PathState& path = round_->paths[ray];
  work.media.release(camera_media_mark_);
  path.media = camera_media_;
  if (!frame_.one_viewpoint()) {
    find_surrounding_media(data_, round_->rays[ray], work_.surrounding, work_);
    path.media = nested(work.media, work_.surrounding);
  }
  path.media_mark = work.media.mark();
}

void Tracer::follow() {
  const std::size_t count = round_->count;
  const std::span<const WorldRay> rays = std::span(round_->rays).first(count);
  tick(static_cast<unsigned>(count));
  data_.intersect_each(rays, hits_, work_.rays);

  RayMask on_surface = 0;
  for (std::size_t i = 0; i < count; ++i) {
    on_surface |= static_cast<RayMask>(see(i)) << i;
  }
  look_up_each(on_surface);
  add_light(on_surface);
  next_round_->count = 0;
  for (std::size_t group = 0; group * lane_count < count; ++group) {
    finish(group, RayPacket::lanes(on_surface, group));
  }
}

bool Tracer::see(std::size_t ray) {
  RayHit& hit = hits_[ray];
  if (hit.has_company && has_transparency_) hit = seen_of(round_->rays[ray]);
  const bool absorbs = frame_.features().absorption && round_->paths[ray].media != MediaLists::empty;
  if (absorbs && !pass_medium(ray)) return false;
  if (!hit.found()) {
    see_background(ray);
    return false;
  }
  if (identifies_) note(*round_->samples[ray], met(data_, hit, round_->paths[ray].kind));
  return true;
}

void Tracer::look_up_each(RayMask on_surface) {
  for (std::size_t first = 0; on_surface >> first != 0; first += lane_count) {
    SurfaceGroup& group = surfaces_[first / lane_count];
    const RayMask seen = RayPacket::lanes(on_surface, first / lane_count);
    const auto rays = std::span(round_->rays).subspan(first).first<lane_count>();
    const auto hits = std::span(hits_).subspan(first).first<lane_count>();
    look_up(data_, rays, hits, seen, group, work_);
    group.light = ambient_light(frame_.ambient(), group.reflectivity);
    const PathState* const paths = &round_->paths[first];
    group.path_length = Lanes{paths[0].path_length + hits[0].t, paths[1].path_length + hits[1].t,
                              paths[2].path_length + hits[2].t, paths[3].path_length + hits[3].t};
  }
}

bool Tracer::pass_medium(std::size_t ray) {
  PathState& path = round_->paths[ray];
  const Medium& medium = round_->works[ray]->media.innermost(path.media);
  path.weight *= transmittance(data_.materials()[medium.material], hits_[ray].t);
  return !is_black(path.weight);
}

void Tracer::see_background(std::size_t ray) {
  Sample& sample = *round_->samples[ray];
  const PathState& path = round_->paths[ray];
  if (identifies_) note(sample, nothing);
  const Color background = data_.background().color(round_->rays[ray].direction);
  if (path.kind == RayKind::camera) {
    sample.alpha = background.a;
    sample.color += background.a * path.weight * rgb(background);
  } else {
    sample.color += path.weight * rgb(background);
  }
}

void Tracer::send_to(const PreparedLight& source, RayMask on_surface) {
  shadows_.count = 0;
  for (std::size_t first = 0; on_surface >> first != 0; first += lane_count) {
    const SurfaceGroup& surfaces = surfaces_[first / lane_count];
    const PhongSurfaces& phong = surfaces.phong;
    LightSamples sample;
    LaneMask lit = lanes_with(RayPacket::lanes(on_surface, first / lane_count));
    lit &= (phong.diffuse > 0.0) | (phong.specular > 0.0);
    if (!any(lit)) continue;
    lit &= source.sample(surfaces.position, surfaces.path_length, sample);
    lit &= dot(sample.directions, surfaces.face_normal) > 0.0;
    const VectorLanes light = direct_light(phong, sample, source.color(), lit);
    lit &= ~is_black(light);
    const Lanes end_errors = lamp_errors(surfaces.position, sample);
    for_each_ray(mask_of(lit), [&](std::size_t lane) {
      const std::size_t index = shadows_.count++;
      shadows_.rays_to[index] = first + lane;
      shadows_.lights[index] = light.lane(lane);
      WorldRay& ray = shadows_.rays[index];
      ray.origin = surfaces.position.lane(lane);
      ray.direction = sample.directions.lane(lane);
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
      const std::size_t ray = shadows_.rays_to[i];
      const bool is_hidden = (hidden >> i & 1u) != 0;
      if (is_hidden && identifies_) note(*round_->samples[ray], shaded_from(lamp));
      const SurfaceLane lit = surface(ray);
      const Rgb light = shadows_.lights[i] * light_share_of(rays[i], ray, is_hidden);
      lit.group.light.set(lit.lane, lit.light() + light);
    }
    ++lamp;
  }
}

Rgb Tracer::light_share_of(const WorldRay& shadow_ray, std::size_t ray, bool hidden) {
  const MediaLists::List media = round_->paths[ray].media;
  if (!hidden) {
    if (media == MediaLists::empty || !frame_.features().absorption) return Rgb(1);
  } else if (!has_transparency_) {
    return Rgb(0);
  }
  return light_share(data_, shadow_ray, round_->works[ray]->media, media, work_);
}

RayHit Tracer::seen_of(const WorldRay& ray) {
  RayHit seen = data_.intersect(ray, work_.rays);
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
