#include "core/render/tracer.hpp"

#include <bit>
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

/// How far rounding may put a light from surfaces that it is meant to be on.
Lanes light_errors(const VectorLanes& points, const LightSamples& light) {
  constexpr double roundings = 16;
  const Lanes error =
      roundings * unit_roundoff *
      fma(light.distances, largest_component(light.directions), largest_component(points));
  return select(light.distances == std::numeric_limits<double>::infinity(), Lanes{}, error);
}

/// A surface as it is met: a primitive, the triangles of a mesh all alike.
std::uint64_t met(const PreparedData& data, const RayHit& hit, RayKind kind) {
  constexpr std::uint64_t is_surface = std::uint64_t{1} << 32;
  constexpr std::uint64_t is_entered = std::uint64_t{1} << 33;
  constexpr int place_of_kind = 34;
  return (data.is_solid(hit) ? hit.leaf : is_surface | data.entity_id(hit)) |
         (hit.entering ? is_entered : 0) | static_cast<std::uint64_t>(kind) << place_of_kind;
}

/// A light's shadow.
std::uint64_t shaded_from(std::size_t light) {
  return std::uint64_t{1} << 40 | light;
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

void Tracer::trace(std::span<const RayLanes> camera_rays, std::span<Sample> samples,
                   std::span<FirstHit> first_hits) {
  round_->count = samples.size();
  Frame::set_camera_rays(camera_rays, round_->rays);
  round_->weights.fill(lanes_of(Rgb(1)));
  for (std::size_t i = 0; i < round_->count; ++i) {
    samples[i] = {};
    round_->samples[i] = &samples[i];
    round_->works[i] = &work_.samples[i];
    round_->works[i]->rays = 1;
    round_->paths[i] = {};
    if (has_transparency_) start_media(i);
  }
  work_.stats.camera_rays += round_->count;
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
    find_surrounding_media(data_, round_->rays.ray(ray), work_.surrounding, work_);
    path.media = nested(work.media, work_.surrounding);
  }
  path.media_mark = work.media.mark();
}

void Tracer::follow() {
  const std::size_t count = round_->count;
  tick(static_cast<unsigned>(count));
  data_.intersect_each(round_->rays, RayPacket::all(count), hits_, work_.rays);
  data_.prefetch_points(hits_, RayPacket::all(count));

  // Of most rays there is nothing more to see than that.
  const bool absorbs = frame_.features().absorption;
  RayMask bringing = 0;
  RayMask on_surface = 0;
  for (std::size_t i = 0; i < count; ++i) {
    bringing |= static_cast<RayMask>((!absorbs && !hits_[i].has_coincident) || see(i)) << i;
    on_surface |= static_cast<RayMask>(hits_[i].found()) << i;
  }
  const RayMask seeing_nothing = bringing & ~on_surface;
  on_surface &= bringing;
  if (seeing_nothing != 0) see_background(seeing_nothing);
  look_up_each(on_surface);
  if (identifies_) note_surfaces(on_surface);
  add_light(on_surface);
  next_round_->count = 0;
  next_round_->rays.with_starts = 0;
  for (std::size_t group = 0; group * lane_count < count; ++group) {
    finish(group, RayPacket::lanes(on_surface, group));
  }
}

bool Tracer::see(std::size_t ray) {
  RayHit& hit = hits_[ray];
  if (hit.has_coincident && has_transparency_) hit = seen_of(round_->rays.ray(ray));
  const bool absorbs =
      frame_.features().absorption && round_->paths[ray].media != MediaLists::empty;
  return !absorbs || pass_medium(ray);
}

void Tracer::look_up_each(RayMask on_surface) {
  RayPacket::for_each_group(on_surface, [&](std::size_t i, RayMask seen) {
    SurfaceGroup& group = surfaces_[i];
    const std::size_t first = i * lane_count;
    const auto hits = std::span(hits_).subspan(first).first<lane_count>();
    look_up(data_, round_->rays.lines[i], hits, seen, group, work_);
    group.light = ambient_light(frame_.ambient(), group.reflectivity);
    const PathState* const paths = &round_->paths[first];
    group.path_length = Lanes([&](auto lane) { return paths[lane].path_length + hits[lane].t; });
  });
}

bool Tracer::pass_medium(std::size_t ray) {
  const Medium& medium = round_->works[ray]->media.innermost(round_->paths[ray].media);
  const Rgb left = weight(ray) * transmittance(data_.materials()[medium.material], hits_[ray].t);
  round_->weights[ray / lane_count].set(ray % lane_count, left);
  return !is_black(left);
}

void Tracer::see_background(RayMask rays) {
  RayPacket::for_each_group(rays, [&](std::size_t group, RayMask lanes) {
    const ColorLanes seen = data_.background().colors(round_->rays.lines[group].direction, lanes);
    const std::size_t first = group * lane_count;
    // Only to the camera the background may be transparent; all rays of a round are or are not its.
    const bool are_camera_rays = round_->paths[first].kind == RayKind::camera;
    const VectorLanes& weights = round_->weights[group];
    const auto light = by_lane((are_camera_rays ? seen.alpha * weights : weights) * seen.color);
    for_each_ray(lanes, [&](std::size_t lane) {
      Sample& sample = *round_->samples[first + lane];
      if (identifies_) note(sample, nothing);
      if (are_camera_rays) sample.channels[3] = seen.alpha[lane];
      sample.channels += light[lane];
    });
  });
}

RayMask Tracer::taking_light(RayMask on_surface) const {
  RayMask taking = 0;
  RayPacket::for_each_group(on_surface, [&](std::size_t i, RayMask lanes) {
    const PhongSurfaces& phong = surfaces_[i].phong;
    taking |= (lanes & mask_of((phong.diffuse > 0.0) | (phong.specular > 0.0))) << (i * lane_count);
  });
  return taking;
}

RayMask Tracer::send_to(const PreparedLight& source, RayMask surfaces_lit) {
  RayMask sent = 0;
  LightSamples& sample = light_sample_;
  RayPacket::for_each_group(surfaces_lit, [&](std::size_t i, RayMask lanes) {
    const SurfaceGroup& surfaces = surfaces_[i];
    LaneMask lit = lanes_with(lanes);
    lit &= source.sample(surfaces.position, surfaces.path_length, sample);
    lit &= dot(sample.directions, surfaces.face_normal) > 0.0;
    direct_light(surfaces.phong, sample, source.color(), lit, lights_[i]);
    lit &= !is_black(lights_[i]);
    sent |= mask_of(lit) << (i * lane_count);
    shadow_rays_.lines[i] = {surfaces.position, sample.directions};
    shadow_rays_.t_max[i] = sample.distances;
    shadow_rays_.end_errors[i] = light_errors(surfaces.position, sample);
  });
  return sent;
}

void Tracer::add_light(RayMask on_surface) {
  const RayMask taking = taking_light(on_surface);
  if (taking == 0) return;
  RayPacket::for_each_group(taking, [&](std::size_t i, RayMask) {
    shadow_rays_.start_errors[i] = surfaces_[i].start_errors;
  });
  for_each_ray(taking, [&](std::size_t i) {
    shadow_rays_.starts[i] = surfaces_[i / lane_count].starts[i % lane_count];
  });
  shadow_rays_.with_starts = taking;
  const PacketStarts starts = data_.noted_starts(shadow_rays_, taking);
  std::size_t light_index = 0;
  for (const PreparedLight& source : frame_.lights()) {
    const RayMask sent = send_to(source, taking);
    const auto count = static_cast<unsigned>(std::popcount(sent));
    work_.stats.shadow_rays += count;
    tick(count);
    const LightPaths paths = paths_to_light(starts, sent);
    if (identifies_) {
      for_each_ray(paths.blocked | paths.filtered,
                   [&](std::size_t i) { note(*round_->samples[i], shaded_from(light_index)); });
    }
    const RayMask filtered = paths.filtered | absorbing(sent & ~paths.blocked);
    const RayMask reached = sent & ~paths.blocked & ~filtered;
    RayPacket::for_each_group(reached, [&](std::size_t i, RayMask lanes) {
      VectorLanes& light = surfaces_[i].light;
      light = select(lanes_with(lanes), light + lights_[i], light);
    });
    for_each_ray(filtered, [&](std::size_t i) {
      const Rgb share = light_share(data_, shadow_rays_.ray(i), work_.rays.on_paths[i],
                                    round_->works[i]->media, round_->paths[i].media, work_);
      const SurfaceLane lit = surface(i);
      lit.group.light.set(lit.lane, lit.light() + lights_[i / lane_count].lane(lit.lane) * share);
    });
    ++light_index;
  }
}

LightPaths Tracer::paths_to_light(const PacketStarts& starts, RayMask sent) {
  if (has_transparency_) return data_.paths_to_light(shadow_rays_, starts, sent, work_.rays);
  return {.blocked = data_.occluded_each(shadow_rays_, starts, sent, work_.rays)};
}

RayMask Tracer::absorbing(RayMask sent) const {
  RayMask absorbing = 0;
  if (frame_.features().absorption) {
    for_each_ray(sent, [&](std::size_t i) {
      absorbing |= static_cast<RayMask>(round_->paths[i].media != MediaLists::empty) << i;
    });
  }
  return absorbing;
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
  seen.has_coincident = true;
  return seen;
}

void Tracer::note_surfaces(RayMask on_surface) {
  const auto note_one = [&](std::size_t ray) {
    note(*round_->samples[ray], met(data_, hits_[ray], round_->paths[ray].kind));
  };
  // Either all rays of a round come from the camera or none does. If they do, nothing was noted of
  // their samples before, these follow each other, and most groups meet what others do.
  const bool are_first = round_->paths[0].kind == RayKind::camera;
  Sample* const first_samples = round_->samples[0];
  std::uint32_t leaf = nothing;
  bool entering = false;
  std::uint64_t identity = 0;
  RayPacket::for_each_group(on_surface, [&](std::size_t group, RayMask lanes) {
    const std::size_t first = group * lane_count;
    if (!are_first || surfaces_[group].like_first != RayPacket::group_mask) {
      for_each_ray(lanes, [&](std::size_t lane) { note_one(first + lane); });
      return;
    }
    const RayHit& hit = hits_[first];
    Sample* const samples = first_samples + first;
    if (hit.leaf != leaf || hit.entering != entering) {
      note_one(first);
      leaf = hit.leaf;
      entering = hit.entering;
      identity = samples->identity;
    }
    for (std::size_t lane = 0; lane < lane_count; ++lane) samples[lane].identity = identity;
  });
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
