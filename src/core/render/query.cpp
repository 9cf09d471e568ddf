#include "crt/query.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <new>

#include "core/math/float_environment.hpp"
#include "core/math/vector.hpp"
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

/// Whether rays are valid, where that is seen at a glance. (What has too large a sum is not.)
template <class Real>
MaskOf<Real> are_plainly_valid(const Vec3Of<Real>& origin, const Vec3Of<Real>& direction, const Real& t_min,
                               const Real& t_max) {
  const auto sum_of = [](const auto& v) { return size_of(v.x) + size_of(v.y) + size_of(v.z); };
  const Real extent = sum_of(direction);
  const auto finite = sum_of(origin) + extent <= std::numeric_limits<double>::max();
  return both(both(extent > 0.0, finite), either(t_min <= t_max, t_min > t_max));
}

bool is_plainly_valid(const Ray& ray) {
  return are_plainly_valid<double>(ray.origin, ray.direction, ray.t_min, ray.t_max);
}

/// Users' rays side by side.
struct UserRays {
  VectorLanes origin;
  VectorLanes direction;
  Lanes t_min;
  Lanes t_max;

  explicit UserRays(std::span<const Ray, lane_count> rays) {
    const auto gathered = [&](const auto& number) {
      return Lanes{number(rays[0]), number(rays[1]), number(rays[2]), number(rays[3])};
    };
    for (int axis = 0; axis < 3; ++axis) {
      origin[axis] = gathered([=](const Ray& ray) { return ray.origin[axis]; });
      direction[axis] = gathered([=](const Ray& ray) { return ray.direction[axis]; });
    }
    t_min = gathered([](const Ray& ray) { return ray.t_min; });
    t_max = gathered([](const Ray& ray) { return ray.t_max; });
  }

  LaneMask plainly_valid() const { return are_plainly_valid<Lanes>(origin, direction, t_min, t_max); }
};

/// Multiplies by a power of two, exactly wherever the result is a normal number.
class PowerOfTwo {
 public:
  explicit PowerOfTwo(int exponent) : exponent_(exponent) {
    constexpr int bias = 1023;
    constexpr int fraction_bits = 52;
    if (std::abs(exponent) < bias) {
      factor_ = std::bit_cast<double>(static_cast<std::uint64_t>(bias + exponent) << fraction_bits);
    }
  }

  /// One that is a normal number, and so is its inverse.
  explicit PowerOfTwo(double factor = 1) : factor_(factor), exponent_(0) {}

  double operator*(double value) const {
    return factor_ != 0 ? factor_ * value : std::scalbn(value, exponent_);
  }
  Vec3 operator*(const Vec3& v) const {
    return factor_ != 0 ? factor_ * v : Vec3(*this * v.x, *this * v.y, *this * v.z);
  }

 private:
  double factor_ = 0;  ///< 0 where no normal number holds it
  int exponent_;       ///< means nothing otherwise
};

/// That of a number's highest digit; x > 0.
int exponent_of(double x) {
  constexpr int bias = 1023;
  constexpr int fraction_bits = 52;
  const auto biased = static_cast<int>(std::bit_cast<std::uint64_t>(x) >> fraction_bits);
  return biased > 0 ? biased - bias : std::ilogb(x);
}

/// Makes of the user's ray one that can be followed: its direction is brought near length 1 by a power of
/// two, which makes any length safe and changes no digit of t. Returns what turns a t of that ray into one of
/// the user's.
PowerOfTwo follow(const Ray& users, WorldRay& ray) {
  // Beyond the largest number there is no t to tell of, and so no hit.
  constexpr double largest = std::numeric_limits<double>::max();
  const int exponent = exponent_of(largest_component(users.direction));
  const PowerOfTwo shorten(-exponent);
  const PowerOfTwo lengthen(exponent);
  ray.origin = users.origin;
  ray.direction = shorten * users.direction;
  ray.t_min = lengthen * std::max(users.t_min, -largest);
  ray.t_max = lengthen * std::min(users.t_max, largest);
  return shorten;
}

/// The same side by side, of valid rays that are not too long or short for that; else false. What shortens them
/// is put into `to_users_t`.
bool follow(const UserRays& users, std::size_t group, RayBatch& rays, Lanes& to_users_t) {
  constexpr double largest = std::numeric_limits<double>::max();
  constexpr double longest = 0x1p1022;
  const Lanes extent = largest_component(users.direction);
  const Lanes lengthen = power_of_two_below(extent);
  if (!all((extent >= 1 / longest) & (lengthen <= longest))) return false;
  to_users_t = 1.0 / lengthen;
  rays.lines[group] = {users.origin, to_users_t * users.direction};
  rays.t_min[group] = lengthen * max(users.t_min, lanes_of(-largest));
  rays.t_max[group] = lengthen * min(users.t_max, lanes_of(largest));
  rays.start_errors[group] = Lanes{};
  return true;
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
    data_.crossings(ray_, false, found, work_);
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

/// Up to packet_size queries at a time, asked together if they go nearly the same way.
class QueryPacket {
 public:
  QueryPacket(const PreparedData& data, RayWorkspace& work) : data_(data), work_(work) {}

  void take(std::span<const Ray> rays) {
    count_ = rays.size();
    rays_.with_starts = 0;
    std::size_t done = 0;
    for (; done + lane_count <= count_; done += lane_count) {
      const auto group = rays.subspan(done).first<lane_count>();
      if (!take_group(group, done)) take_each(group, done);
    }
    take_each(rays.subspan(done), done);
  }

  void nearest(std::span<std::optional<Hit>> hits) {
    data_.intersect_each(rays_, all(), hits_, work_);
    for (std::size_t first = 0; first < count_; first += lane_count) {
      const std::size_t count = std::min<std::size_t>(lane_count, count_ - first);
      RayMask found = 0;
      for (std::size_t i = 0; i < count; ++i) {
        if (hits_[first + i].found()) {
          found |= 1u << i;
        } else {
          hits[first + i].reset();
        }
      }
      if (found != 0) describe(first, found, hits.subspan(first, count));
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
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      to_users_t_[first + lane] = PowerOfTwo(factors[static_cast<int>(lane)]);
    }
    return true;
  }
  void take_each(std::span<const Ray> rays, std::size_t first) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      validate(rays[i]);
      WorldRay ray;
      to_users_t_[first + i] = follow(rays[i], ray);
      rays_.set(first + i, ray);
    }
  }

  /// Tells of those of the rays from `first` on that have found something: those on one face side by side.
  void describe(std::size_t first, RayMask found, std::span<std::optional<Hit>> hits) {
    const std::span<const RayHit, lane_count> group(&hits_[first], lane_count);
    const RayLanes& lines = rays_.lines[first / lane_count];
    const Lanes t = {group[0].t, group[1].t, group[2].t, group[3].t};
    const HitFaces faces(group);
    for (RayMask to_come = found; to_come != 0;) {
      const RayHit& hit = group[first_ray(to_come)];
      const RayMask alike = mask_of(faces.like(hit)) & to_come;
      to_come &= ~alike;
      data_.object_points(hit, lines, t, true, points_);
      data_.take_to_world(hit, points_);
      for_each_ray(alike, [&](std::size_t lane) {
        hits[lane] = described(to_users_t_[first + lane] * group[lane].t, lane_of(points_, lane),
                               data_.entity_id(hit), hit.entering);
      });
    }
  }

  const PreparedData& data_;
  RayWorkspace& work_;
  std::size_t count_ = 0;
  RayBatch rays_;
  std::array<PowerOfTwo, packet_size> to_users_t_;
  std::array<RayHit, packet_size> hits_;
  SurfacePointLanes points_;  ///< of those that are told of
};

/// Calls ask(packet, answers) for packet after packet.
template <class Answer, class Ask>
void ask_in_packets(const PreparedData& data, std::span<const Ray> rays, std::span<Answer> answers,
                    RayWorkspace& work, const Ask& ask) {
  if (answers.size() < rays.size()) {
    throw Error(ErrorCode::invalid_argument, "there are fewer places for answers than rays", "rays");
  }
  QueryPacket packet(data, work);
  for (std::size_t first = 0; first < rays.size(); first += packet_size) {
    const std::size_t count = std::min(packet_size, rays.size() - first);
    packet.take(rays.subspan(first, count));
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
  const core::FloatEnvironment ieee;
  core::answered([&] {
    core::ask_in_packets(state_->data(), rays, hits, state_->work(),
                         [](core::QueryPacket& packet, auto answers) { packet.nearest(answers); });
  });
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
