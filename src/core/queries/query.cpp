#include "crt/query.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <utility>

#include "core/math/float_environment.hpp"
#include "core/prepare/prepared_data.hpp"
#include "core/queries/input_rays.hpp"
#include "core/queries/query_packet.hpp"
#include "core/queries/ray_start.hpp"
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
    follow(users_, data.input_tolerance(), ray_);
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

  /// Appends every crossing of a ray that begins on the surface of a hit, or of any ray.
  void crossings(const std::optional<RayHit>& start, std::vector<RayHit>& found,
                 std::vector<FullHit>& out) {
    if (start) begin_on(data_, *start, ray_, work_);
    data_.crossings(ray_, found, work_);
    for (const RayHit& hit : found) {
      HitPoint point;
      data_.hit_point(ray_, hit, true, point);
      out.push_back(full_hit(users_t(users_, hit.t, hit.t_low), point, data_.ids(hit), hit));
    }
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

/// Returns a hit as batches have it.
PlainHit plain(const std::optional<Hit>& hit) {
  if (!hit) return {};
  return {.t = hit->t,
          .normal = hit->normal,
          .u = hit->u,
          .v = hit->v,
          .entity_id = hit->entity_id,
          .side = hit->entering ? HitSide::entering : HitSide::leaving};
}

/// Throws if there are fewer places than rays.
void check_places(std::size_t places, std::span<const Ray> rays) {
  if (places >= rays.size()) return;
  throw Error(ErrorCode::invalid_argument, "there are fewer places for answers than rays", "rays");
}

/// GivenRays are those of a query, with what they begin and end on.
struct GivenRays {
  std::span<const Ray> rays;
  std::span<const RayStart> starts{};  ///< as many as rays, or none
  std::span<const RayStart> ends{};    ///< as many as rays, or none

  void check() const {
    const auto are_complete = [&](std::span<const RayStart> some) {
      return some.empty() || some.size() == rays.size();
    };
    if (are_complete(starts) && are_complete(ends)) return;
    throw Error(ErrorCode::invalid_argument,
                "there must be as many starts and ends as rays, or none", "starts");
  }
};

/// Calls ask(packet, answers) for packet after packet.
template <class Answers, class Ask>
void ask_in_packets(const PreparedData& data, const GivenRays& given, const Answers& answers,
                    RayWorkspace& work, const Ask& ask) {
  const std::span<const Ray> rays = given.rays;
  check_places(answers.size(), rays);
  given.check();
  QueryPacket packet(data, work);
  for (std::size_t first = 0; first < rays.size(); first += packet_size) {
    const std::size_t count = std::min(packet_size, rays.size() - first);
    packet.take(rays.subspan(first, count), rays.subspan(first + count));
    if (!given.starts.empty()) packet.begin_on(given.starts.subspan(first, count));
    if (!given.ends.empty()) packet.end_on(given.ends.subspan(first, count));
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

std::size_t first_invalid(const PreparedScene& scene, std::span<const RayStart> starts) {
  const auto is_invalid = [&](const RayStart& start) {
    return !core::is_of_scene(scene.data(), start);
  };
  return static_cast<std::size_t>(std::find_if(starts.begin(), starts.end(), is_invalid) -
                                  starts.begin());
}

class RayQueries::State {
 public:
  explicit State(const PreparedScene& scene)
      : scene_(scene), work_(data().spare_workspace().take()) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { data().spare_workspace().keep(std::move(work_)); }

  core::Query query(const Ray& ray) {
    validate(ray);
    return {scene_.data(), ray, *work_};
  }
  /// Writes answers into places of std::optional<Hit>, PlainHit, HitPart, FullHit, or Distances.
  template <class Answers>
  void intersect(const core::GivenRays& rays, const Answers& answers) {
    const core::FloatEnvironment ieee;
    core::answered([&] {
      core::ask_in_packets(data(), rays, answers, *work_,
                           [](core::QueryPacket& packet, auto some) { packet.nearest(some); });
    });
  }
  void occluded(const core::GivenRays& rays, std::span<bool> occluded) {
    const core::FloatEnvironment ieee;
    core::answered([&] {
      core::ask_in_packets(
          data(), rays, occluded, *work_,
          [](core::QueryPacket& packet, auto answers) { packet.occluded(answers); });
    });
  }
  std::vector<core::RayHit>& found() { return found_; }
  const core::PreparedData& data() const { return scene_.data(); }
  core::RayWorkspace& work() { return *work_; }

 private:
  PreparedScene scene_;
  std::unique_ptr<core::RayWorkspace> work_;
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
  state_->intersect({rays}, hits);
}

void RayQueries::intersect(std::span<const Ray> rays, std::span<PlainHit> hits) {
  if (rays.size() == 1 && !hits.empty()) {
    hits[0] = core::plain(intersect(rays[0]));
  } else {
    state_->intersect({rays}, hits);
  }
}

void RayQueries::parts(std::span<const Ray> rays, std::span<HitPart> parts) {
  state_->intersect({rays}, parts);
}

void RayQueries::distances(std::span<const Ray> rays, std::span<double> distances,
                           std::span<std::uint32_t> entity_ids) {
  if (!entity_ids.empty()) core::check_places(entity_ids.size(), rays);
  state_->intersect({rays}, core::Distances{distances, entity_ids});
}

void RayQueries::occluded(std::span<const Ray> rays, std::span<bool> occluded) {
  state_->occluded({rays}, occluded);
}

FullHit RayQueries::trace(const Ray& ray, const RayStart& start) {
  FullHit hit;
  trace(std::span(&ray, 1), std::span(&start, 1), std::span(&hit, 1));
  return hit;
}

void RayQueries::trace(std::span<const Ray> rays, std::span<const RayStart> starts,
                       std::span<FullHit> hits) {
  state_->intersect({rays, starts}, hits);
}

bool RayQueries::blocked(const Ray& ray, const RayStart& start, const RayStart& end) {
  bool answer = false;
  blocked(std::span(&ray, 1), std::span(&start, 1), std::span(&end, 1), std::span(&answer, 1));
  return answer;
}

void RayQueries::blocked(std::span<const Ray> rays, std::span<const RayStart> starts,
                         std::span<const RayStart> ends, std::span<bool> blocked) {
  state_->occluded({rays, starts, ends}, blocked);
}

void RayQueries::trace_all(const Ray& ray, const RayStart& start, std::vector<FullHit>& out) {
  const core::FloatEnvironment ieee;
  core::answered([&] {
    core::Query query = state_->query(ray);
    query.crossings(core::read_start(state_->data(), start, "start"), state_->found(), out);
  });
}

void RayQueries::locate(std::span<const Vec3> points, std::span<Location> locations) {
  if (locations.size() < points.size()) {
    throw Error(ErrorCode::invalid_argument, "there are fewer places for answers than points",
                "points");
  }
  const core::FloatEnvironment ieee;
  core::answered([&] {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!core::is_finite(points[i]))
        throw Error(ErrorCode::invalid_argument, "points must be finite", "points");
      const core::ContainingSolid in = state_->data().innermost(points[i], state_->work());
      locations[i] = {};
      if (in.object == core::invalid_index) continue;
      const core::Ids ids = state_->data().ids({.object = in.object, .leaf = in.leaf});
      locations[i] = {.entity_id = ids.entity, .part_id = ids.part, .user = ids.user};
    }
  });
}

void RayQueries::crossings(const Ray& ray, std::vector<Hit>& out) {
  const core::FloatEnvironment ieee;
  core::answered([&] { state_->query(ray).crossings(state_->found(), out); });
}

FullHit trace(const PreparedScene& scene, const Ray& ray, const RayStart& start) {
  return RayQueries(scene).trace(ray, start);
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
  if (count > 0 && count <= core::smallest_batch) {
    RayQueries queries(scene);
    return work(queries, 0, count);
  }
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
