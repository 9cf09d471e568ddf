// The parts of the tracer about rays that go on from a surface: mirrored, or through it.
#include <bit>

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
VectorLanes kept_on_side(const VectorLanes& direction, const VectorLanes& side) {
  return select(dot(direction, side) < 0.0, mirrored(direction, side), direction);
}

LaneMask is_weaker(const VectorLanes& weight, double least) {
  return (weight.x < least) & (weight.y < least) & (weight.z < least);
}

}  // namespace

void Tracer::finish(std::size_t group, RayMask on_surface) {
  const SurfaceGroup& surfaces = surfaces_[group];
  const std::size_t first = group * lane_count;
  const RayMask bright = on_surface & ~mask_of(is_black(surfaces.light));
  if (bright != 0) {
    const auto colors = by_lane(round_->weights[group] * surfaces.light);
    const auto add = [&](std::size_t lane) {
      round_->samples[first + lane]->channels += colors[lane];
    };
    if (bright ==
        RayPacket::group_mask) {  // as most are; a loop over lanes ends where nobody expects it
      add(0);
      add(1);
      add(2);
      add(3);
    } else {
      for_each_ray(bright, add);
    }
  }
  const RayMask splitting = on_surface & surfaces.sending_on;
  const RayMask gone_on = splitting != 0 ? send_on(group, splitting) : 0;
  if (waiting_ == 0) return;
  const RayMask in_group = RayPacket::lanes(RayPacket::all(round_->count), group);
  for_each_ray(in_group & ~gone_on, [&](std::size_t lane) {
    if (!round_->works[first + lane]->pending.empty()) pop(first + lane);
  });
}

std::size_t Tracer::join_next_round(std::size_t ray, RayKind kind) {
  RenderStats& stats = work_.stats;
  ++(kind == RayKind::reflection ? stats.reflection_rays : stats.refraction_rays);
  Round& next = *next_round_;
  const std::size_t place = next.count++;
  next.works[place] = round_->works[ray];
  next.samples[place] = round_->samples[ray];
  ++next.works[place]->rays;
  return place;
}

// (Calls would take as long as it does.)
[[gnu::always_inline]] inline PathState& Tracer::depart(std::size_t ray, RayKind kind, bool waits,
                                                        const Vec3& direction,
                                                        const StartPoint& start,
                                                        const Rgb& weight) {
  const SurfaceLane from = surface(ray);
  PathState* path = nullptr;
  if (waits) {
    PathRay& pending = round_->works[ray]->pending.push();
    pending.origin = from.position();
    pending.direction = direction;
    pending.start = start;
    pending.weight = weight;
    path = &pending.path;
    ++waiting_;
  } else {
    const std::size_t place = join_next_round(ray, kind);
    next_round_->rays.set(place, from.position(), direction, start);
    next_round_->weights[place / lane_count].set(place % lane_count, weight);
    path = &next_round_->paths[place];
  }
  path->kind = kind;
  path->bounces = round_->paths[ray].bounces + 1;
  path->path_length = from.group.path_length[static_cast<int>(from.lane)];
  return *path;
}

RayMask Tracer::send_on(std::size_t group, RayMask lanes) {
  Split parts;
  split(group, lanes, parts);
  // What goes through is followed first; media lists made for it are dropped before the other's
  // turn.
  RayMask gone_on = 0;
  for_each_ray(parts.mirrored | parts.refracted, [&](std::size_t lane) {
    const std::size_t ray = group * lane_count + lane;
    const SurfaceLane from = surface(ray);
    SampleWork& work = *round_->works[ray];
    const bool goes_through = (parts.refracted >> lane & 1u) != 0;
    const bool waits = work.rays == most_rays_per_sample;
    if ((parts.mirrored >> lane & 1u) != 0) {
      PathState& path = depart(ray, RayKind::reflection, waits || goes_through,
                               parts.mirrored_direction.lane(lane), from.start(),
                               parts.mirrored_weight.lane(lane));
      path.media = round_->paths[ray].media;
      path.media_mark = parts.media_marks[lane];
      if (!goes_through) work.media.release(parts.media_marks[lane]);
    }
    if (goes_through) {
      PathState& path =
          depart(ray, RayKind::refraction, waits, parts.refracted_direction.lane(lane),
                 from.start_behind(), parts.refracted_weight.lane(lane));
      path.media = parts.media_behind[lane];
      path.media_mark = work.media.mark();
    }
    gone_on |= static_cast<RayMask>(!waits) << lane;
  });
  work_.stats.media_changes +=
      static_cast<unsigned>(std::popcount(parts.refracted & parts.into_volumes));
  return gone_on;
}

void Tracer::split(std::size_t group, RayMask lanes, Split& split) {
  const SurfaceGroup& surfaces = surfaces_[group];
  const VectorLanes& normal = surfaces.phong.normal;
  Lanes mirrored_share = surfaces.reflectivity;
  RayMask transparent = lanes & mask_of(surfaces.transparency > 0.0);
  RayMask deep = 0;
  const VectorLanes& weight = round_->weights[group];
  for_each_ray(lanes, [&](std::size_t lane) {
    const PathState& path = round_->paths[group * lane_count + lane];
    deep |= static_cast<RayMask>(path.bounces >= frame_.settings().recursion_depth) << lane;
    split.media_marks[lane] = round_->works[group * lane_count + lane]->media.mark();
  });

  if (transparent != 0) {
    Behind behind;
    look_behind(group, transparent, behind, split);
    const auto refraction =
        refract(surfaces.phong.view, normal, behind.index_before, behind.index_behind);
    mirrored_share += behind.transparency * refraction.reflectance;
    split.refracted_weight =
        bounded_share(behind.transparency * (1.0 - refraction.reflectance) * weight * behind.color);
    split.refracted_direction = kept_on_side(refraction.direction, -surfaces.face_normal);
  }
  split.mirrored_weight = mirrored_share * weight;
  split.mirrored_direction =
      kept_on_side(mirrored(surfaces.phong.view, normal), surfaces.face_normal);
  split.mirrored =
      worth_it(group, lanes & mask_of(mirrored_share > 0.0), deep, split.mirrored_weight);
  transparent &= ~mask_of(is_black(split.refracted_weight));
  split.refracted = worth_it(group, transparent, deep, split.refracted_weight);
}

void Tracer::look_behind(std::size_t group, RayMask lanes, Behind& behind, Split& split) {
  const SurfaceGroup& surfaces = surfaces_[group];
  behind.color = surfaces.phong.color;
  for_each_ray(lanes, [&](std::size_t lane) {
    const std::size_t ray = group * lane_count + lane;
    const bool solid = data_.is_solid(hits_[ray]);
    Passage passage{.transparency = surfaces.transparency[lane], .media = round_->paths[ray].media};
    const MediaLists& media = round_->works[ray]->media;
    if (hits_[ray].has_coincident) {
      passage.color = surface(ray).color();
      pass_coincident(ray, passage);
      behind.color.set(lane, passage.color);
    } else if (solid) {
      passage.media = media_behind(ray);
    }
    behind.transparency[lane] = passage.transparency;
    behind.index_before[lane] = refractive_index(media, round_->paths[ray].media);
    behind.index_behind[lane] = refractive_index(media, passage.media);
    split.media_behind[lane] = passage.media;
    split.into_volumes |= static_cast<RayMask>(solid) << lane;
  });
}

RayMask Tracer::worth_it(std::size_t group, RayMask lanes, RayMask deep,
                         const VectorLanes& weights) {
  if (frame_.features().gain == 1) return heavy_enough(group, lanes, deep, weights);
  return heavy_enough(group, lanes, deep, most_weights(group, weights));
}

/// Its place on the stack is of no use to most scenes.
[[gnu::noinline]] VectorLanes Tracer::most_weights(std::size_t group,
                                                   const VectorLanes& weights) const {
  Lanes gains{};
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    gains[lane] = frame_.gain_behind(round_->paths[group * lane_count + lane].bounces);
  }
  return gains * weights;
}

inline RayMask Tracer::heavy_enough(std::size_t group, RayMask lanes, RayMask deep,
                                    const VectorLanes& most) {
  const RayMask weak = lanes & mask_of(is_weaker(most, frame_.settings().min_weight));
  deep &= lanes & ~weak;
  const RayMask dropped = weak | deep;
  if (dropped == 0) return lanes;
  work_.stats.rays_below_min_weight += static_cast<unsigned>(std::popcount(weak));
  work_.stats.rays_beyond_depth += static_cast<unsigned>(std::popcount(deep));
  for_each_ray(dropped, [&](std::size_t lane) {
    round_->samples[group * lane_count + lane]->dropped += largest_component(most.lane(lane));
  });
  return lanes & ~dropped;
}

WorldRay Tracer::ray_behind(std::size_t ray) {
  const SurfaceLane lit = surface(ray);
  return {.origin = lit.position(),
          .direction = round_->rays.direction(ray),
          .start = lit.start_behind()};
}

MediaLists::List Tracer::media_behind(std::size_t ray) {
  const RayHit& hit = hits_[ray];
  const MediaLists::List before = round_->paths[ray].media;
  MediaLists& media = round_->works[ray]->media;
  if (!hit.entering) return media.left(before, hit.object);
  return entered_in_order(
      media, before, {hit.object, data_.hit_material(hit)},
      [&](std::uint32_t object) { return data_.stay(ray_behind(ray), object, work_.rays).exit; });
}

// A ray that starts at the hit finds some crossings next to it behind itself, whatever rounding
// makes of their order: which of them it has passed is told by what it starts inside of.
void Tracer::pass_coincident(std::size_t ray, Passage& passage) {
  const WorldRay behind = ray_behind(ray);
  const RayHit& hit = hits_[ray];
  const WorldRay before = round_->rays.ray(ray);
  MediaLists& media = round_->works[ray]->media;
  data_.intersect(before, work_.rays);  // once more: others have been asked for since then
  std::vector<RayHit>& entered = work_.entered;
  entered.clear();
  const auto pass = [&](const RayHit& crossing, bool at_place) {
    tick();
    const bool solid = data_.is_solid(crossing);
    const bool passed =
        solid ? data_.stay(behind, crossing.object, work_.rays).inside == crossing.entering
              : at_place || crossing.t - hit.t <= behind.start.t_error;
    if (!passed) return;
    if (crossing.leaf != hit.leaf || crossing.face != hit.face || crossing.root != hit.root) {
      const CrossingFilter filter = crossing_filter(data_, before, crossing, work_.stats);
      passage.transparency *= filter.transparency;
      passage.color = bounded_share(passage.color * filter.color);
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

  const auto exit_of = [&](std::uint32_t object) {
    return data_.stay(behind, object, work_.rays).exit;
  };
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

void Tracer::pop(std::size_t ray) {
  SampleWork& work = *round_->works[ray];
  if (work.rays == most_rays_per_sample) {
    ++work_.stats.samples_over_ray_bound;
    for (const PathRay& dropped : work.pending.all()) {
      round_->samples[ray]->dropped += largest_component(dropped.weight);
    }
    waiting_ -= work.pending.all().size();
    work.pending.clear();
    return;
  }
  const PathRay& last = work.pending.top();
  const std::size_t place = join_next_round(ray, last.path.kind);
  next_round_->rays.set(place, last.origin, last.direction, last.start);
  next_round_->weights[place / lane_count].set(place % lane_count, last.weight);
  next_round_->paths[place] = last.path;
  work.media.release(last.path.media_mark);
  work.pending.pop();
  --waiting_;
}

}  // namespace crt::core
