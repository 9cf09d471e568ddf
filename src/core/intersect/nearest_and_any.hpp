// What the two queries keep that most rays ask: the nearest crossing, and whether there is any.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/intersect/object_query.hpp"
#include "core/ray/coincidence_tolerance.hpp"

namespace crt::core {

class Nearest final : public ObjectQuery<Nearest> {
 public:
  static constexpr bool takes_one = true;
  static constexpr bool any_will_do = false;

  Nearest(const Accelerator& accelerator, const WorldRay& ray, RayWorkspace& work, RayHit& best)
      : ObjectQuery(accelerator, ray, work), best_(best) {}

  bool take(const RayHit& hit) {
    take(hit.t, hit.t_low, hit.object, hit.t + coincidence_tolerance(ray(), hit.t, hit.error),
         [&](RayHit& best) { best = hit; });
    return false;
  }

  /// `reach` is up to where it may have company.
  template <class Write>
  void take(double t, double t_low, std::uint32_t object, double reach, const Write& write) {
    if (!(t < ray().t_max)) return;
    if (take(best_, t, t_low, object, reach, write)) set_limit(std::min(limit(), reach));
  }

  /// Of a crossing before the ray's end: whether it becomes the best. write(hit) writes it where it
  /// stays: a copy of what has just been written waits until that has reached the cache.
  template <class Write>
  static bool take(RayHit& best, double t, double t_low, std::uint32_t object, double reach,
                   const Write& write) {
    if (!(std::tie(t, t_low, object) < std::tie(best.t, best.t_low, best.object))) {
      best.has_coincident = true;
      return false;
    }
    const bool has_coincident = best.t <= reach;
    write(best);
    best.has_coincident = has_coincident;
    return true;
  }

 private:
  RayHit& best_;
};

class Any final : public ObjectQuery<Any> {
 public:
  using ObjectQuery::ObjectQuery;
  static constexpr bool takes_one = true;
  static constexpr bool any_will_do = true;
  bool found = false;

  bool take(const RayHit& hit) {
    if (is_before_end(hit)) settle();
    return false;
  }
  template <class Write>
  void take(double /*t*/, double /*t_low*/, std::uint32_t /*object*/, double /*reach*/,
            const Write& write) {
    RayHit hit;
    write(hit);
    take(hit);
  }

  void settle() {
    found = true;
    set_limit(-std::numeric_limits<double>::infinity());
  }
};

}  // namespace crt::core
