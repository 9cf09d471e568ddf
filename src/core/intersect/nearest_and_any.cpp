// The two queries that most rays ask, for one ray: the nearest crossing, and whether there is any.
// Cheap tests come first, exact ones where these leave something open.
#include "core/intersect/nearest_and_any.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/intersect/filter_rays.hpp"
#include "core/intersect/first_crossing.hpp"

namespace crt::core {

namespace {

/// Whether the proxy alone could tell what the exact test of an object would.
template <class Kind>
bool test_resolved(Kind& query, const FilterRay& filter, const BoundingProxy& proxy,
                   const BoundingProxies& proxies) {
  if (proxies.resolved_leaf(proxy) == nothing) return false;
  const FirstCrossing<double> first = filter.first_crossing(proxy, proxies);
  if (first.unknown) return false;
  ++query.work().intersection_tests;
  if (!first.found || !(first.t <= query.limit())) return true;
  const double reach =
      first.t + coincidence_tolerance(plain_ray(filter.line()), first.t, first.error);
  query.take(first.t, 0, proxy.object, reach,
             [&](RayHit& hit) { write_first(proxy, proxies, first, hit); });
  return true;
}

}  // namespace

template <class Kind>
void Accelerator::traverse_filtered(Kind& query) const {
  const WorldRay& ray = query.ray();
  const FilterRay filter(*this, ray);
  const auto is_done = [&] { return query.limit() <= ray.t_min; };
  const auto test = [&](const BoundingProxy& proxy, const BoundingProxies& proxies) {
    query.step();
    const Answer answer = filter.decide(proxy, proxies, query.limit(), Kind::any_will_do);
    if (answer == Answer::rejected) return;
    if constexpr (Kind::any_will_do) {
      if (answer == Answer::accepted) {
        query.settle();
        return;
      }
    }
    if (!test_resolved(query, filter, proxy, proxies)) query.test(proxy.object);
  };

  // A plane that is met bounds what else matters; where exactly is only asked if nothing is before
  // it.
  constexpr bool planes_last = !Kind::any_will_do;
  for (const BoundingProxy& proxy : unbounded_.list) {
    if (is_done()) break;
    if (planes_last && proxy.kind == BoundingProxy::Kind::plane) {
      query.step();
      double last = 0;
      const Answer answer = filter.decide(proxy, unbounded_, query.limit(), false, last);
      if (answer != Answer::accepted) continue;
      // As a hit there would have it.
      query.set_limit(std::min(query.limit(), last + coincidence_tolerance(ray, last, 0)));
    } else {
      test(proxy, unbounded_);
    }
  }
  if (!is_done()) {
    visit_boxes<!Kind::any_will_do>(ray, query.limit(), [&](std::uint32_t box) {
      test(bounded_.list[box], bounded_);
      return query.limit();
    });
  }
  if (!planes_last) return;
  for (const BoundingProxy& proxy : unbounded_.list) {
    if (proxy.kind == BoundingProxy::Kind::plane) test(proxy, unbounded_);
  }
}

RayHit Accelerator::nearest(const WorldRay& ray, RayWorkspace& work) const {
  RayHit hit;
  if (leaves_isolated(ray, work, hit)) return hit;
  return nearest_elsewhere(ray, work);
}

RayHit Accelerator::nearest_elsewhere(const WorldRay& ray, RayWorkspace& work) const {
  RayHit best;
  Nearest query(*this, ray, work, best);
  traverse_filtered(query);
  if (best.has_coincident) best = gather_coincident(ray, best, work);
  return best;
}

bool Accelerator::any(const WorldRay& ray, RayWorkspace& work) const {
  Any query(*this, ray, work);
  traverse_filtered(query);
  return query.found;
}

RayHit Accelerator::gather_coincident(const WorldRay& ray, const RayHit& nearest,
                                      RayWorkspace& work) const {
  WorldRay piece = ray;
  piece.t_max = std::min(
      ray.t_max, std::nextafter(nearest.t + coincidence_tolerance(ray, nearest.t, nearest.error),
                                std::numeric_limits<double>::infinity()));
  std::vector<RayHit>& here = work.here;
  std::vector<RayHit>& near = work.near;
  here.clear();
  near.clear();
  all(piece, nullptr, near, work);
  const bool exact = compiled_.leaves[nearest.leaf].exact != nullptr;
  if (exact) sort(ray, near, work);
  RayHit first = exact && !near.empty() ? near.front() : nearest;
  const auto is_there = [&](const RayHit& crossing) {
    return exact ? crossing.t == first.t && crossing.t_low == first.t_low
                 : same_place(crossing, first);
  };
  std::sort(near.begin(), near.end(), [](const RayHit& a, const RayHit& b) {
    return std::tie(a.object, a.t, a.t_low) < std::tie(b.object, b.t, b.t_low);
  });
  const auto split = std::stable_partition(near.begin(), near.end(), is_there);
  here.assign(near.begin(), split);
  near.erase(near.begin(), split);
  if (here.empty()) return nearest;
  first = here.front();
  first.has_coincident = here.size() + near.size() > 1;
  return first;
}

}  // namespace crt::core
