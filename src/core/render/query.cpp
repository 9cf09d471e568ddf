#include "crt/query.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <new>

#include "core/math/float_environment.hpp"
#include "core/render/users_rays.hpp"
#include "core/scene/hit_faces.hpp"
#include "core/scene/prepared_data.hpp"
#include "core/tasks/tasks.hpp"
#include "crt/error.hpp"

namespace crt {

namespace core {

namespace {

/// What is not finite leaves no number when it is multiplied by 0.
bool is_finite(const Vec3& v) {
  return v.x * 0 + v.y * 0 + v.z * 0 == 0;
}

/// At the user's t; where that is in the world a HitPoint says or a SurfacePoint.
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

/// One query.
class Query {
 public:
  Query(const PreparedData& data, const Ray& ray, RayWorkspace& work)
      : data_(data), work_(work), to_users_t_(follow(ray, ray_)) {}

  std::optional<Hit> nearest() const {
    const RayHit hit = data_.intersect(ray_, work_);
    if (!hit.found()) return std::nullopt;
    return described(hit);
  }

  bool occluded() const { return data_.occluded(ray_, work_); }

  void crossings(std::vector<RayHit>& found, std::vector<Hit>& out) const {
    data_.crossings(ray_, found, work_);
    out.clear();
    out.reserve(found.size());
    for (const RayHit& hit : found) out.push_back(described(hit));
  }

 private:
  Hit described(const RayHit& hit) const {
    HitPoint point;
    data_.hit_point(ray_, hit, true, point);
    return core::described(to_users_t_ * point.t, point, point.entity_id, point.entering);
  }

  const PreparedData& data_;
  RayWorkspace& work_;
  WorldRay ray_;
  PowerOfTwo to_users_t_;
};

/// Where distances are told, and of what, if anybody asks.
struct Distances {
  std::span<double> t;
  std::span<std::uint32_t> ids;

  std::size_t size() const { return t.size(); }
  Distances subspan(std::size_t first, std::size_t count) const {
    return {t.subspan(first, count), ids.empty() ? ids : ids.subspan(first, count)};
  }
};

/// Up to packet_size queries at a time, asked together if they go nearly the same way.
class QueryPacket {
 public:
  QueryPacket(const PreparedData& data, RayWorkspace& work) : data_(data), work_(work) {}

  /// `next` are to be taken after them: they come from memory meanwhile.
  void take(std::span<const Ray> rays, std::span<const Ray> next) {
    count_ = rays.size();
    rays_.with_starts = 0;
    std::size_t done = 0;
    for (; done + lane_count <= count_; done += lane_count) {
      // As many as are taken: all at once would be more than can be on their way.
      const std::size_t end = std::min(next.size(), done + lane_count);
      for (std::size_t i = done; i < end; ++i) __builtin_prefetch(&next[i]);
      const auto group = rays.subspan(done).first<lane_count>();
      if (!take_group(group, done)) take_each(group, done);
    }
    take_each(rays.subspan(done), done);
  }

  /// An answer is an std::optional<Hit> or a PlainHit.
  template <class Answer>
  void nearest(std::span<Answer> answers) {
    data_.intersect_each(rays_, all(), hits_, work_);
    data_.expect_points(hits_, all());
    for (std::size_t first = 0; first < count_; first += lane_count) {
      const std::size_t count = std::min<std::size_t>(lane_count, count_ - first);
      find_distances(first, count);
      find_sides(first);
      find_points(first);
      tell(answers.subspan(first, count));
    }
  }

  /// Answers are columns.
  void nearest(const Distances& answers) {
    FirstLeaves leaves;
    const bool are_told = data_.first_leaves(rays_, all(), leaves);
    if (!are_told) data_.intersect_each(rays_, all(), hits_, work_);
    for (std::size_t first = 0; first < count_; first += lane_count) {
      const std::size_t group = first / lane_count;
      const std::size_t count = std::min<std::size_t>(lane_count, count_ - first);
      if (are_told) {
        set_distances(group, leaves.t[group], RayPacket::lanes(leaves.found, group),
                      [&](std::size_t lane) { return leaves.leaves[first + lane]; });
      } else {
        find_distances(first, count);
      }
      tell(answers.subspan(first, count));
    }
  }

  void occluded(std::span<bool> occluded) {
    const RayMask found = data_.occluded_each(rays_, all(), work_);
    for (std::size_t i = 0; i < count_; ++i) occluded[i] = (found >> i & 1u) != 0;
  }

 private:
  RayMask all() const { return RayPacket::all(count_); }

  /// Those from `first` on side by side; false if that does not do for some.
  bool take_group(std::span<const Ray, lane_count> rays, std::size_t first) {
    const UserRays users(rays);
    Lanes factors;
    if (!core::all(users.plainly_valid()) || !follow(users, first / lane_count, rays_, factors)) return false;
    to_users_t_[first / lane_count] = factors;
    return true;
  }
  void take_each(std::span<const Ray> rays, std::size_t first) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      validate(rays[i]);
      const std::size_t index = first + i;
      WorldRay ray;
      powers_[index] = follow(rays[i], ray);
      to_users_t_[index / lane_count][static_cast<int>(index % lane_count)] = powers_[index].factor();
      rays_.set(index, ray);
    }
  }

  /// How far `count` rays from `first` on are from what they have found, and what that is.
  void find_distances(std::size_t first, std::size_t count) {
    const std::span<const RayHit, lane_count> group(&hits_[first], lane_count);
    const Lanes t = {group[0].t, group[1].t, group[2].t, group[3].t};
    // What has found nothing is nowhere.
    const RayMask found = mask_of(t < std::numeric_limits<double>::infinity()) & RayPacket::all(count);
    set_distances(first / lane_count, t, found, [&](std::size_t lane) { return group[lane].leaf; });
  }
  /// The same of the crossings of a group with leaf_of(lane), at the followed rays' t.
  template <class LeafOf>
  void set_distances(std::size_t group, const Lanes& t, RayMask found, const LeafOf& leaf_of) {
    found_ = found;
    if (found == 0) return;
    const Lanes& factors = to_users_t_[group];
    t_ = factors * t;
    for_each_ray(found & mask_of(factors == 0.0), [&](std::size_t lane) {
      const auto i = static_cast<int>(lane);
      t_[i] = powers_[group * lane_count + lane] * t[i];
    });
    const auto id = [&](std::size_t lane) {
      return static_cast<std::int32_t>(data_.entity_id_or_any(leaf_of(lane)));
    };
    ids_ = IntLanes{id(0), id(1), id(2), id(3)};
  }
  void find_sides(std::size_t first) {
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const HitSide side = hits_[first + lane].entering ? HitSide::entering : HitSide::leaving;
      sides_[static_cast<int>(lane)] = static_cast<std::int32_t>(side);
    }
  }

  /// Where that is, of hits that are alike side by side.
  void find_points(std::size_t first) {
    if (found_ == 0) return;
    const std::span<const RayHit, lane_count> group(&hits_[first], lane_count);
    const RayLanes& lines = rays_.lines[first / lane_count];
    const Lanes t = {group[0].t, group[1].t, group[2].t, group[3].t};
    const HitFaces faces(data_, group);
    for (RayMask to_come = found_; to_come != 0;) {
      const AlikeRays alike = faces.alike(to_come);
      SurfacePointLanes& points = to_come == found_ ? points_ : others_;
      faces.object_points(alike, lines, t, true, points);
      data_.take_to_world(group[first_ray(to_come)], points);
      to_come &= ~alike.all();
      if (&points == &points_) continue;
      const LaneMask lanes = lanes_with(alike.all());
      points_.position = chosen(lanes, points.position, points_.position);
      points_.normal = chosen(lanes, points.normal, points_.normal);
      points_.u = lanes ? points.u : points_.u;
      points_.v = lanes ? points.v : points_.v;
    }
  }

  void tell(std::span<std::optional<Hit>> answers) const {
    for (std::size_t lane = 0; lane < answers.size(); ++lane) {
      const auto i = static_cast<int>(lane);
      if ((found_ >> lane & 1u) == 0) {
        answers[lane].reset();
      } else {
        const bool entering = sides_[i] == static_cast<std::int32_t>(HitSide::entering);
        answers[lane] =
            described(t_[i], lane_of(points_, lane), static_cast<std::uint32_t>(ids_[i]), entering);
      }
    }
  }

  /// By whole vectors.
  void tell(std::span<PlainHit> answers) const {
    static_assert(sizeof(PlainHit) == 56 && offsetof(PlainHit, normal) == 8 && offsetof(PlainHit, u) == 32);
    static_assert(offsetof(PlainHit, v) == 40 && offsetof(PlainHit, entity_id) == 48 &&
                  offsetof(PlainHit, side) == 52);
    const LaneMask found = lanes_with(found_);
    const auto told = [&](const Lanes& value) { return found ? value : Lanes{}; };
    const auto heads =
        transposed({told_t(), told(points_.normal.x), told(points_.normal.y), told(points_.normal.z)});
    // Each with its side behind it.
    using Pairs = std::int32_t __attribute__((vector_size(32)));
    const Pairs ids_and_sides = __builtin_shufflevector(ids_, sides_, 0, 4, 1, 5, 2, 6, 3, 7);
    const auto tails =
        transposed({told(points_.u), told(points_.v), told(reinterpret_cast<Lanes>(ids_and_sides)), Lanes{}});
    constexpr std::size_t head = offsetof(PlainHit, u);
    for (std::size_t lane = 0; lane < answers.size(); ++lane) {
      auto* place = reinterpret_cast<std::byte*>(&answers[lane]);
      std::memcpy(place, &heads[lane], head);
      std::memcpy(place + head, &tails[lane], sizeof(PlainHit) - head);
    }
  }

  void tell(const Distances& answers) const {
    const Lanes t = told_t();
    const IntLanes ids = ids_ & int_lanes_with(found_);
    if (answers.size() == lane_count) {
      std::memcpy(answers.t.data(), &t, sizeof t);
      if (!answers.ids.empty()) std::memcpy(answers.ids.data(), &ids, sizeof ids);
    } else {
      std::memcpy(answers.t.data(), &t, answers.t.size_bytes());
      std::memcpy(answers.ids.data(), &ids, answers.ids.size_bytes());
    }
  }

  Lanes told_t() const { return lanes_with(found_) ? t_ : lanes_of(std::numeric_limits<double>::infinity()); }

  const PreparedData& data_;
  RayWorkspace& work_;
  std::size_t count_ = 0;
  RayBatch rays_;
  /// Turns a t of the rays into the user's; 0 for those that no such number does it for but their power.
  std::array<Lanes, packet_size / lane_count> to_users_t_{};
  std::array<PowerOfTwo, packet_size> powers_;
  std::array<RayHit, packet_size> hits_;
  // Of a group of rays, by lane, those that have found something:
  RayMask found_ = 0;
  Lanes t_{};  ///< the user's
  SurfacePointLanes points_;
  SurfacePointLanes others_;  ///< of hits that are not alike
  IntLanes ids_{};
  IntLanes sides_{};
};

/// Throws if there are fewer places than rays.
void check_places(std::size_t places, std::span<const Ray> rays) {
  if (places >= rays.size()) return;
  throw Error(ErrorCode::invalid_argument, "there are fewer places for answers than rays", "rays");
}

/// Calls ask(packet, answers) for packet after packet.
template <class Answers, class Ask>
void ask_in_packets(const PreparedData& data, std::span<const Ray> rays, const Answers& answers,
                    RayWorkspace& work, const Ask& ask) {
  check_places(answers.size(), rays);
  QueryPacket packet(data, work);
  for (std::size_t first = 0; first < rays.size(); first += packet_size) {
    const std::size_t count = std::min(packet_size, rays.size() - first);
    packet.take(rays.subspan(first, count), rays.subspan(first + count));
    ask(packet, answers.subspan(first, count));
  }
}

/// Calls `ask`, with failures to allocate as the library's own errors.
template <class Ask>
auto answered(const Ask& ask) {
  try {
    return ask();
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::out_of_memory, "there is not enough memory for a ray query");
  }
}

/// Rays that one thread answers at a stretch: enough to outweigh handing them out.
constexpr std::size_t smallest_batch = 512;
/// And so few that threads which are done early find others.
constexpr std::size_t batches_per_thread = 16;

std::size_t batch_size(std::size_t count, int threads) {
  const std::size_t batches = batches_per_thread * static_cast<std::size_t>(threads);
  return std::max(smallest_batch, (count + batches - 1) / batches);
}

}  // namespace

}  // namespace core

void validate(const Ray& ray) {
  using core::is_finite;
  if (core::is_plainly_valid(ray)) return;
  if (!is_finite(ray.origin)) {
    throw Error(ErrorCode::invalid_argument, "origin of a ray must be finite", "origin");
  }
  if (!is_finite(ray.direction) || ray.direction == Vec3(0)) {
    throw Error(ErrorCode::invalid_argument, "direction of a ray must be finite and not 0", "direction");
  }
  if (std::isnan(ray.t_min)) throw Error(ErrorCode::invalid_argument, "t_min is not a number", "t_min");
  if (std::isnan(ray.t_max)) throw Error(ErrorCode::invalid_argument, "t_max is not a number", "t_max");
}

std::size_t first_invalid(std::span<const Ray> rays) {
  using core::lane_count;
  const auto is_valid = [](const Ray& ray) {
    try {
      validate(ray);
      return true;
    } catch (const Error&) {
      return false;
    }
  };
  for (std::size_t first = 0; first < rays.size(); first += lane_count) {
    const std::size_t count = std::min<std::size_t>(lane_count, rays.size() - first);
    if (count == lane_count) {
      const core::UserRays group(rays.subspan(first).first<lane_count>());
      if (core::all(group.plainly_valid())) continue;
    }
    for (std::size_t i = first; i < first + count; ++i) {
      if (!is_valid(rays[i])) return i;
    }
  }
  return rays.size();
}

class RayQueries::State {
 public:
  explicit State(const PreparedScene& scene) : scene_(scene) {}

  core::Query query(const Ray& ray) {
    validate(ray);
    return {scene_.data(), ray, work_};
  }
  /// Into the places of std::optional<Hit>, PlainHit, or Distances.
  template <class Answers>
  void intersect(std::span<const Ray> rays, const Answers& answers) {
    const core::FloatEnvironment ieee;
    core::answered([&] {
      core::ask_in_packets(data(), rays, answers, work_,
                           [](core::QueryPacket& packet, auto some) { packet.nearest(some); });
    });
  }
  std::vector<core::RayHit>& found() { return found_; }
  const core::PreparedData& data() const { return scene_.data(); }
  core::RayWorkspace& work() { return work_; }

 private:
  PreparedScene scene_;
  core::RayWorkspace work_;
  std::vector<core::RayHit> found_;
};

RayQueries::RayQueries(const PreparedScene& scene)
    : state_(core::answered([&] { return std::make_unique<State>(scene); })) {}
RayQueries::~RayQueries() = default;
RayQueries::RayQueries(RayQueries&&) noexcept = default;
RayQueries& RayQueries::operator=(RayQueries&&) noexcept = default;

std::optional<Hit> RayQueries::intersect(const Ray& ray) {
  const core::FloatEnvironment ieee;
  return core::answered([&] { return state_->query(ray).nearest(); });
}

bool RayQueries::occluded(const Ray& ray) {
  const core::FloatEnvironment ieee;
  return core::answered([&] { return state_->query(ray).occluded(); });
}

void RayQueries::intersect(std::span<const Ray> rays, std::span<std::optional<Hit>> hits) {
  state_->intersect(rays, hits);
}

void RayQueries::intersect(std::span<const Ray> rays, std::span<PlainHit> hits) {
  state_->intersect(rays, hits);
}

void RayQueries::distances(std::span<const Ray> rays, std::span<double> distances,
                           std::span<std::uint32_t> entity_ids) {
  if (!entity_ids.empty()) core::check_places(entity_ids.size(), rays);
  state_->intersect(rays, core::Distances{distances, entity_ids});
}

void RayQueries::occluded(std::span<const Ray> rays, std::span<bool> occluded) {
  const core::FloatEnvironment ieee;
  core::answered([&] {
    core::ask_in_packets(state_->data(), rays, occluded, state_->work(),
                         [](core::QueryPacket& packet, auto answers) { packet.occluded(answers); });
  });
}

void RayQueries::crossings(const Ray& ray, std::vector<Hit>& out) {
  const core::FloatEnvironment ieee;
  core::answered([&] { state_->query(ray).crossings(state_->found(), out); });
}

std::optional<Hit> intersect(const PreparedScene& scene, const Ray& ray) {
  return RayQueries(scene).intersect(ray);
}

bool occluded(const PreparedScene& scene, const Ray& ray) {
  return RayQueries(scene).occluded(ray);
}

std::vector<Hit> crossings(const PreparedScene& scene, const Ray& ray) {
  std::vector<Hit> hits;
  RayQueries(scene).crossings(ray, hits);
  return hits;
}

void query_in_parallel(const PreparedScene& scene, std::size_t count, const RayBatchWork& work, int threads) {
  const std::size_t size = core::batch_size(count, core::allowed_threads(threads));
  const std::size_t batches = count / size + (count % size != 0 ? 1 : 0);
  core::answered([&] {
    core::run_tasks(batches, threads, [&](std::size_t index) {
      RayQueries queries(scene);
      const std::size_t first = index * size;
      work(queries, first, first + std::min(size, count - first));
    });
  });
}

}  // namespace crt
