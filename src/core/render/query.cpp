#include "crt/query.hpp"

#include <algorithm>
#include <cmath>
#include <new>

#include "core/render/float_environment.hpp"
#include "core/scene/prepared_data.hpp"
#include "crt/error.hpp"

namespace crt {

namespace core {

namespace {

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check(const Ray& ray) {
  if (!is_finite(ray.origin)) {
    throw Error(ErrorCode::invalid_argument, "origin of a ray must be finite", "origin");
  }
  if (!is_finite(ray.direction) || ray.direction == Vec3(0)) {
    throw Error(ErrorCode::invalid_argument, "direction of a ray must be finite and not 0", "direction");
  }
  if (std::isnan(ray.t_min)) throw Error(ErrorCode::invalid_argument, "t_min is not a number", "t_min");
  if (std::isnan(ray.t_max)) throw Error(ErrorCode::invalid_argument, "t_max is not a number", "t_max");
}

/// One query: the user's ray with its direction brought near length 1 by a power of two, which makes
/// any length safe and changes no digit of t.
class Query {
 public:
  Query(const PreparedScene& scene, const Ray& ray) : data_(scene.data()) {
    check(ray);
    const Vec3& d = ray.direction;
    exponent_ = std::ilogb(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}));
    ray_ = {.origin = ray.origin,
            .direction = {std::scalbn(d.x, -exponent_), std::scalbn(d.y, -exponent_),
                          std::scalbn(d.z, -exponent_)},
            .t_min = std::scalbn(ray.t_min, exponent_),
            .t_max = std::scalbn(ray.t_max, exponent_)};
  }

  std::optional<Hit> nearest() {
    const RayHit hit = data_.intersect(ray_, work_);
    if (!hit.found()) return std::nullopt;
    return described(hit);
  }

  bool occluded() { return data_.occluded(ray_, work_); }

  std::vector<Hit> crossings() {
    std::vector<RayHit> found;
    data_.crossings(ray_, false, found, work_);
    std::vector<Hit> result;
    result.reserve(found.size());
    for (const RayHit& hit : found) result.push_back(described(hit));
    return result;
  }

 private:
  Hit described(const RayHit& hit) const {
    const HitPoint point = data_.hit_point(ray_, hit);
    return {.t = std::scalbn(hit.t, -exponent_),
            .position = point.position,
            .normal = point.normal,
            .u = point.u,
            .v = point.v,
            .entity_id = point.entity_id,
            .entering = point.entering};
  }

  FloatEnvironment ieee_;
  const PreparedData& data_;
  RayWorkspace work_;
  WorldRay ray_;
  int exponent_ = 0;
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

}  // namespace

}  // namespace core

std::optional<Hit> intersect(const PreparedScene& scene, const Ray& ray) {
  return core::answered([&] { return core::Query(scene, ray).nearest(); });
}

bool occluded(const PreparedScene& scene, const Ray& ray) {
  return core::answered([&] { return core::Query(scene, ray).occluded(); });
}

std::vector<Hit> crossings(const PreparedScene& scene, const Ray& ray) {
  return core::answered([&] { return core::Query(scene, ray).crossings(); });
}

}  // namespace crt
