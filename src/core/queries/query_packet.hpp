// Queries of several rays are answered together.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>

#include "core/prepare/hit_faces.hpp"
#include "core/prepare/prepared_data.hpp"
#include "core/queries/input_rays.hpp"
#include "core/queries/ray_start.hpp"
#include "crt/query.hpp"

namespace crt::core {

/// Makes a Hit at the input ray's t. `point` is a HitPoint or a SurfacePoint in the world.
template <class Point>
Hit described(double t, const Point& point, std::uint32_t entity_id, bool entering) {
  return {.t = t,
          .position = point.position,
          .normal = point.normal,
          .u = point.u,
          .v = point.v,
          .entity_id = entity_id,
          .entering = entering};
}

/// Returns what a hit is on. `point` is a SurfacePoint.
inline HitPart part_of(const Ids& ids, std::uint32_t face, const SurfacePoint& point) {
  return {.entity_id = ids.entity, .part_id = ids.part, .face = face, .u = point.u, .v = point.v};
}

/// Returns all that is known of a hit. `point` is a HitPoint or a SurfacePoint in the world.
template <class Point>
FullHit full_hit(double t, const Point& point, const Ids& ids, const RayHit& hit) {
  return {.t = t,
          .position = point.position,
          .normal = point.normal,
          .u = point.u,
          .v = point.v,
          .entity_id = ids.entity,
          .part_id = ids.part,
          .face = hit.face,
          .side = hit.entering ? HitSide::entering : HitSide::leaving,
          .user = ids.user,
          .start = start_of(hit)};
}

/// Distances are where distances are written, and the ids of what was hit, if anybody asks.
struct Distances {
  std::span<double> t;
  std::span<std::uint32_t> ids;

  std::size_t size() const { return t.size(); }
  Distances subspan(std::size_t first, std::size_t count) const {
    return {t.subspan(first, count), ids.empty() ? ids : ids.subspan(first, count)};
  }
};

/// A QueryPacket has up to packet_size queries at a time. They are answered together if their
/// directions are nearly the same.
class QueryPacket {
 public:
  QueryPacket(const PreparedData& data, RayWorkspace& work) : data_(data), work_(work) {
    rays_.max_size_error = data.input_tolerance().max_size_error;
    rays_.is_input = data.input_tolerance().rounding > 0;
  }

  /// Takes rays. `next` are to be taken after them, and are prefetched meanwhile.
  void take(std::span<const Ray> rays, std::span<const Ray> next) {
    users_ = rays;
    count_ = rays.size();
    rays_.with_starts = 0;
    rays_.with_ends = 0;
    std::size_t done = 0;
    for (; done + lane_count <= count_; done += lane_count) {
      // As many are prefetched as are taken, as all at once would be more than can be under way.
      const std::size_t end = std::min(next.size(), done + lane_count);
      for (std::size_t i = done; i < end; ++i) __builtin_prefetch(&next[i]);
      const auto group = rays.subspan(done).first<lane_count>();
      if (!take_group(group, done)) take_each(group, done);
    }
    take_each(rays.subspan(done), done);
  }

  /// Lets the rays begin on the surfaces of hits, where they have a start.
  void begin_on(std::span<const RayStart> starts) {
    change_rays(starts, "start", [&](const RayHit& surface, WorldRay& ray) {
      core::begin_on(data_, surface, ray, work_);
    });
  }
  /// Lets the rays end on the surfaces of hits, where they have an end.
  void end_on(std::span<const RayStart> ends) {
    change_rays(ends, "end",
                [&](const RayHit& surface, WorldRay& ray) { core::end_on(data_, surface, ray); });
  }

  /// Finds nearest hits. An answer is an std::optional<Hit>, a PlainHit, a HitPart or a FullHit.
  template <class Answer>
  void nearest(std::span<Answer> answers) {
    data_.intersect_each(rays_, all(), hits_, work_);
    data_.prefetch_points(hits_, all());
    for (std::size_t first = 0; first < count_; first += lane_count) {
      const std::size_t count = std::min<std::size_t>(lane_count, count_ - first);
      find_distances(first, count);
      find_sides(first);
      find_points(first);
      if constexpr (std::is_same_v<Answer, HitPart> || std::is_same_v<Answer, FullHit>) {
        write(first, answers.subspan(first, count));
      } else {
        write(answers.subspan(first, count));
      }
    }
  }

  /// Finds nearest hits, with answers in columns.
  void nearest(const Distances& answers) {
    data_.intersect_each(rays_, all(), hits_, work_);
    for (std::size_t first = 0; first < count_; first += lane_count) {
      const std::size_t count = std::min<std::size_t>(lane_count, count_ - first);
      find_distances(first, count);
      write(answers.subspan(first, count));
    }
  }

  void occluded(std::span<bool> occluded) {
    const RayMask found = data_.occluded_each(rays_, all(), work_);
    for (std::size_t i = 0; i < count_; ++i) occluded[i] = (found >> i & 1u) != 0;
  }

 private:
  RayMask all() const { return RayPacket::all(count_); }

  /// Calls change(surface, ray) for each ray that has a start or end.
  template <class Change>
  void change_rays(std::span<const RayStart> starts, const char* argument, const Change& change) {
    for (std::size_t i = 0; i < count_; ++i) {
      const std::optional<RayHit> surface = read_start(data_, starts[i], argument);
      if (!surface) continue;
      WorldRay ray = rays_.ray(i);
      change(*surface, ray);
      rays_.set(i, ray);
    }
  }

  /// Takes rays from `first` on side by side. Returns false if that is not possible for some.
  bool take_group(std::span<const Ray, lane_count> rays, std::size_t first) {
    const UserRays users(rays);
    Lanes factors;
    if (!core::all(users.plainly_valid()) ||
        !follow(users, data_.input_tolerance(), first / lane_count, rays_, factors))
      return false;
    to_users_t_[first / lane_count] = factors;
    return true;
  }
  void take_each(std::span<const Ray> rays, std::size_t first) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      validate(rays[i]);
      const std::size_t index = first + i;
      WorldRay ray;
      follow(rays[i], data_.input_tolerance(), ray);
      const PowerOfTwo shorten(-exponent_of(largest_component(rays[i].direction)));
      to_users_t_[index / lane_count][index % lane_count] = shorten.factor();
      rays_.set(index, ray);
    }
  }

  /// Finds the distances of the hits of `count` rays from `first` on, and what was hit.
  void find_distances(std::size_t first, std::size_t count) {
    const std::span<const RayHit, lane_count> group(&hits_[first], lane_count);
    const Lanes t = lanes_of(group[0].t, group[1].t, group[2].t, group[3].t);
    // A ray that has found nothing has an infinite t.
    const RayMask found =
        mask_of(t < std::numeric_limits<double>::infinity()) & RayPacket::all(count);
    if (data_.has_instances()) {
      set_distances(first / lane_count, t, found, [&](std::size_t lane) {
        return (found >> lane & 1u) != 0 ? data_.entity_id(group[lane]) : no_entity_id;
      });
    } else {
      set_distances(first / lane_count, t, found,
                    [&](std::size_t lane) { return data_.entity_id_or_any(group[lane].leaf); });
    }
  }
  /// Sets the distances of a group's hits, at the traced rays' t. id_of(lane) is the user's number
  /// of the entity that was hit, or any for rays that have found nothing.
  template <class IdOf>
  void set_distances(std::size_t group, const Lanes& t, RayMask found, const IdOf& id_of) {
    found_ = found;
    if (found == 0) return;
    const Lanes& factors = to_users_t_[group];
    t_ = factors * t;
    for_each_ray(found & ~mask_of(has_all_digits(t_)), [&](std::size_t lane) {
      const std::size_t index = group * lane_count + lane;
      t_[lane] = users_t(users_[index], t[lane], hits_[index].t_low);
    });
    const auto id = [&](std::size_t lane) { return static_cast<std::int32_t>(id_of(lane)); };
    ids_ = lanes_of<IntLanes>(id(0), id(1), id(2), id(3));
  }
  void find_sides(std::size_t first) {
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const HitSide side = hits_[first + lane].entering ? HitSide::entering : HitSide::leaving;
      sides_[lane] = static_cast<std::int32_t>(side);
    }
  }

  /// Finds the points of the hits. Those of hits that are alike are found side by side.
  void find_points(std::size_t first) {
    if (found_ == 0) return;
    const std::span<const RayHit, lane_count> group(&hits_[first], lane_count);
    const RayLanes& lines = rays_.lines[first / lane_count];
    const Lanes t = lanes_of(group[0].t, group[1].t, group[2].t, group[3].t);
    const HitFaces faces(data_, group);
    for (RayMask to_come = found_; to_come != 0;) {
      const SameSideRays same = faces.on_same_side(to_come);
      SurfacePointLanes& points = to_come == found_ ? points_ : others_;
      faces.object_points(same, lines, t, true, points);
      data_.take_to_world(group[first_ray(to_come)], points);
      to_come &= ~same.all();
      if (&points == &points_) continue;
      const LaneMask lanes = lanes_with(same.all());
      points_.position = select(lanes, points.position, points_.position);
      points_.normal = select(lanes, points.normal, points_.normal);
      points_.u = select(lanes, points.u, points_.u);
      points_.v = select(lanes, points.v, points_.v);
    }
  }

  void write(std::span<std::optional<Hit>> answers) const {
    for (std::size_t lane = 0; lane < answers.size(); ++lane) {
      if ((found_ >> lane & 1u) == 0) {
        answers[lane].reset();
      } else {
        const bool entering = sides_[lane] == static_cast<std::int32_t>(HitSide::entering);
        answers[lane] = described(t_[lane], lane_of(points_, lane),
                                  static_cast<std::uint32_t>(ids_[lane]), entering);
      }
    }
  }

  /// Writes answers that say on what part a hit is.
  template <class Answer>
  void write(std::size_t first, std::span<Answer> answers) const {
    for (std::size_t lane = 0; lane < answers.size(); ++lane) {
      answers[lane] = {};
      if ((found_ >> lane & 1u) == 0) continue;
      const RayHit& hit = hits_[first + lane];
      const SurfacePoint point = lane_of(points_, lane);
      if constexpr (std::is_same_v<Answer, FullHit>) {
        answers[lane] = full_hit(t_[lane], point, data_.ids(hit), hit);
      } else {
        answers[lane] = part_of(data_.ids(hit), hit.face, point);
      }
    }
  }

  /// Writes answers by whole vectors.
  void write(std::span<PlainHit> answers) const {
    static_assert(sizeof(PlainHit) == 56 && offsetof(PlainHit, normal) == 8 &&
                  offsetof(PlainHit, u) == 32);
    static_assert(offsetof(PlainHit, v) == 40 && offsetof(PlainHit, entity_id) == 48 &&
                  offsetof(PlainHit, side) == 52);
    const LaneMask found = lanes_with(found_);
    const auto or_zero = [&](const Lanes& value) { return select(found, value, Lanes{}); };
    const auto heads = transposed({found_t(), or_zero(points_.normal.x), or_zero(points_.normal.y),
                                   or_zero(points_.normal.z)});
    // Each id has its side behind it.
    constexpr std::uint64_t lower_half = 0xffffffffu;
    const WordLanes ids_and_sides = (stdx::static_simd_cast<WordLanes>(ids_) & lower_half) |
                                    stdx::static_simd_cast<WordLanes>(sides_) << 32;
    const auto tails = transposed(
        {or_zero(points_.u), or_zero(points_.v), or_zero(bits_as<Lanes>(ids_and_sides)), Lanes{}});
    constexpr std::size_t head = offsetof(PlainHit, u);
    for (std::size_t lane = 0; lane < answers.size(); ++lane) {
      auto* place = reinterpret_cast<std::byte*>(&answers[lane]);
      std::memcpy(place, &heads[lane], head);
      std::memcpy(place + head, &tails[lane], sizeof(PlainHit) - head);
    }
  }

  void write(const Distances& answers) const {
    const Lanes t = found_t();
    const IntLanes ids = ids_ & int_lanes_with(found_);
    put(t, answers.t);
    if (!answers.ids.empty()) put(ids, answers.ids);
  }
  /// Writes a number for each lane, or for the first of them. The first case is the usual one.
  template <class Numbers, class Number>
  static void put(const Numbers& lanes, std::span<Number> places) {
    if (places.size() == lane_count) {
      std::memcpy(places.data(), &lanes, sizeof lanes);
    } else {
      std::memcpy(places.data(), &lanes, places.size_bytes());
    }
  }

  Lanes found_t() const {
    return select(lanes_with(found_), t_, lanes_of(std::numeric_limits<double>::infinity()));
  }

  const PreparedData& data_;
  RayWorkspace& work_;
  std::span<const Ray> users_;
  std::size_t count_ = 0;
  RayBatch rays_;
  /// These turn a t of the rays into the input rays' t if that has all its digits. A factor is 0
  /// where no number holds it.
  std::array<Lanes, packet_size / lane_count> to_users_t_{};
  std::array<RayHit, packet_size> hits_;
  // These are of a group of rays, by lane, for those that have found something:
  RayMask found_ = 0;
  Lanes t_{};  ///< the input rays'
  SurfacePointLanes points_;
  SurfacePointLanes others_;  ///< of hits that are not alike
  IntLanes ids_{};
  IntLanes sides_{};
};

}  // namespace crt::core
