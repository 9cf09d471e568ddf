#include "crt/query.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <new>

#include "core/math/float_environment.hpp"
#include "core/prepare/prepared_data.hpp"
#include "core/render/input_rays.hpp"
#include "core/render/query_packet.hpp"
#include "core/tasks/tasks.hpp"
#include "crt/error.hpp"

namespace crt {

namespace core {

namespace {

/// Returns whether a vector is finite. What is not finite becomes NaN when it is multiplied by 0.
bool is_finite(const Vec3& v) {
  return v.x * 0 + v.y * 0 + v.z * 0 == 0;
}

/// A Query is a single ray query.
class Query {
 public:
  Query(const PreparedData& data, const Ray& ray, RayWorkspace& work)
      : data_(data), work_(work), users_(ray) {
    follow(users_, ray_);
  }

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
    const double t = users_t(users_, hit.t, hit.t_low);
    return core::described(t, point, point.entity_id, point.entering);
  }

  const PreparedData& data_;
  RayWorkspace& work_;
  const Ray& users_;
  WorldRay ray_;
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

/// One thread answers at least so many rays at once, which is enough to outweigh handing them out.
constexpr std::size_t smallest_batch = 512;
/// Each thread gets about so many batches, so that threads which are done early find others.
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
    throw Error(ErrorCode::invalid_argument, "direction of a ray must be finite and not 0",
                "direction");
  }
  if (std::isnan(ray.t_min))
    throw Error(ErrorCode::invalid_argument, "t_min is not a number", "t_min");
  if (std::isnan(ray.t_max))
    throw Error(ErrorCode::invalid_argument, "t_max is not a number", "t_max");
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
  /// Writes answers into places of std::optional<Hit>, PlainHit, HitPart, or Distances.
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

void RayQueries::parts(std::span<const Ray> rays, std::span<HitPart> parts) {
  state_->intersect(rays, parts);
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

void query_in_parallel(const PreparedScene& scene, std::size_t count, const RayBatchWork& work,
                       int threads) {
  if (!work) throw Error(ErrorCode::invalid_argument, "there is no work to do", "work");
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
