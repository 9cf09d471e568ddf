#include "crt/query.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <new>

#include "core/math/float_environment.hpp"
#include "core/scene/prepared_data.hpp"
#include "core/tasks/tasks.hpp"
#include "crt/error.hpp"

namespace crt {

namespace core {

namespace {

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

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

  double operator*(double value) const {
    return factor_ != 0 ? factor_ * value : std::scalbn(value, exponent_);
  }

 private:
  double factor_ = 0;  ///< 0 where no normal number holds it
  int exponent_;
};

int exponent_of(const Vec3& direction) {
  return std::ilogb(std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)}));
}

/// One query: the user's ray with its direction brought near length 1 by a power of two, which makes
/// any length safe and changes no digit of t.
class Query {
 public:
  Query(const PreparedData& data, const Ray& ray, RayWorkspace& work)
      : data_(data), work_(work), exponent_(exponent_of(ray.direction)) {
    // Beyond the largest number there is no t to tell of, and so no hit.
    constexpr double largest = std::numeric_limits<double>::max();
    const PowerOfTwo shorten(-exponent_);
    const PowerOfTwo lengthen(exponent_);
    const Vec3& d = ray.direction;
    ray_ = {.origin = ray.origin,
            .direction = {shorten * d.x, shorten * d.y, shorten * d.z},
            .t_min = lengthen * std::max(ray.t_min, -largest),
            .t_max = lengthen * std::min(ray.t_max, largest)};
  }

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
    const HitPoint point = data_.hit_point(ray_, hit, true);
    return {.t = PowerOfTwo(-exponent_) * hit.t,
            .position = point.position,
            .normal = point.normal,
            .u = point.u,
            .v = point.v,
            .entity_id = point.entity_id,
            .entering = point.entering};
  }

  const PreparedData& data_;
  RayWorkspace& work_;
  int exponent_;
  WorldRay ray_;
};

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
  if (!is_finite(ray.origin)) {
    throw Error(ErrorCode::invalid_argument, "origin of a ray must be finite", "origin");
  }
  if (!is_finite(ray.direction) || ray.direction == Vec3(0)) {
    throw Error(ErrorCode::invalid_argument, "direction of a ray must be finite and not 0", "direction");
  }
  if (std::isnan(ray.t_min)) throw Error(ErrorCode::invalid_argument, "t_min is not a number", "t_min");
  if (std::isnan(ray.t_max)) throw Error(ErrorCode::invalid_argument, "t_max is not a number", "t_max");
}

class RayQueries::State {
 public:
  explicit State(const PreparedScene& scene) : scene_(scene) {}

  core::Query query(const Ray& ray) {
    validate(ray);
    return {scene_.data(), ray, work_};
  }
  std::vector<core::RayHit>& found() { return found_; }

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
