// Rays ask for the nearest crossing, any crossing, or all of them. Here are the exact queries of
// one ray, and what the rays of a packet may ask.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "core/intersect/object_query.hpp"
#include "core/ray/coincidence_tolerance.hpp"

namespace crt::core {

class Nearest final : public ObjectQuery<Nearest> {
 public:
  static constexpr bool takes_one = true;

  Nearest(const Accelerator& accelerator, const WorldRay& ray, RayWorkspace& work, RayHit& best)
      : ObjectQuery(accelerator, ray, work), best_(best) {}

  bool take(const RayHit& hit) {
    if (!is_before_end(hit)) return false;
    const double reach = hit.t + coincidence_tolerance(ray(), hit.t, hit.error);
    if (commit(best_, hit.t, hit.t_low, hit.object, reach, [&](RayHit& best) { best = hit; }))
      set_limit(std::min(limit(), reach));
    return false;
  }

  /// Returns whether a crossing before the ray's end becomes the best. Others may coincide with it
  /// up to `reach`. write(hit) writes it where it stays: a copy of what has just been written would
  /// wait until that has reached the cache.
  template <class Write>
  static bool commit(RayHit& best, double t, double t_low, std::uint32_t object, double reach,
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

  bool take(const RayHit& hit) {
    if (is_before_end(hit)) set_limit(-std::numeric_limits<double>::infinity());
    return false;
  }
};

class All final : public ObjectQuery<All> {
 public:
  /// If `opacity` is given, the query stops at the first crossing of an opaque material.
  All(const Accelerator& accelerator, const WorldRay& ray, RayWorkspace& work,
      const Opacity* opacity, std::vector<RayHit>& hits)
      : ObjectQuery(accelerator, ray, work),
        accelerator_(accelerator),
        opacity_(opacity),
        hits_(hits) {}
  static constexpr bool takes_one = false;
  bool stopped = false;

  bool take(const RayHit& hit) {
    if (!is_before_end(hit)) return false;
    stopped = opacity_ != nullptr &&
              opacity_->of_materials[opacity_->materials->of(accelerator_.compiled(), hit)];
    if (!stopped) hits_.push_back(hit);
    return !stopped;
  }

 private:
  const Accelerator& accelerator_;
  const Opacity* opacity_;
  std::vector<RayHit>& hits_;
};

/// A ExitQuery finds whether a ray starts inside of an object, and where it leaves that.
class ExitQuery final : public ObjectQuery<ExitQuery> {
 public:
  using ObjectQuery::ObjectQuery;
  static constexpr bool takes_one = false;
  SolidExit result;

  bool begin(bool starts_inside) {
    result.inside = starts_inside;
    return starts_inside;
  }
  bool take(const RayHit& hit) {
    result.exit = hit;
    return false;
  }
};

/// A Located finds whether a ray starts inside of an object, in which leaf, and where it leaves it.
class Located final : public ObjectQuery<Located> {
 public:
  using ObjectQuery::ObjectQuery;
  static constexpr bool takes_one = false;
  static constexpr bool asks_for_leaf = true;
  std::uint32_t leaf = invalid_index;
  double leaves_at = std::numeric_limits<double>::infinity();

  bool begin(bool starts_inside) { return starts_inside; }
  void set_leaf(std::uint32_t first_leaf) { leaf = first_leaf; }
  bool take(const RayHit& hit) {
    leaves_at = hit.t;
    return false;
  }
};

/// Asks of each ray the nearest crossing, by the ray's number in the packet.
struct AskNearest {
  static constexpr bool any_will_do = false;
  static constexpr bool gathers = false;

  std::span<RayHit> hits;
  PassingRays kind = passing_none;  ///< objects that these pass are not there

  Nearest query(const Accelerator& accelerator, const WorldRay& ray, std::size_t number,
                RayWorkspace& work) const {
    return {accelerator, ray, work, hits[number]};
  }
};

/// Asks of each ray whether there is any crossing.
struct AskAny {
  static constexpr bool any_will_do = true;
  static constexpr bool gathers = false;

  PassingRays kind = passing_none;

  Any query(const Accelerator& accelerator, const WorldRay& ray, std::size_t /*number*/,
            RayWorkspace& work) const {
    return {accelerator, ray, work};
  }
};

/// Asks of each ray whether there is anything opaque, and gathers what else there is.
struct AskLight : AskAny {
  static constexpr bool gathers = true;

  const Opacity& opacity;
  std::span<std::vector<RayHit>> found;

  bool is_gathered(std::uint32_t object) const { return !opacity.of_objects[object]; }
};

}  // namespace crt::core
