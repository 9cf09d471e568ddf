#include "core/intersect/crossing_order.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "core/compile/leaf_of_hit.hpp"
#include "core/csg/one_place.hpp"
#include "core/math/stable_sort.hpp"

namespace crt::core {
namespace {

constexpr auto is_before = [](const RayHit& a, const RayHit& b) {
  return std::tie(a.t, a.t_low) < std::tie(b.t, b.t_low);
};

void take_place(RayHit& hit, const RayHit& from) {
  hit.t = from.t;
  hit.error = from.error;
  hit.t_low = from.t_low;
}

/// Gives crossings of one surface one t, whichever objects they belong to.
void unify_coincident(std::vector<RayHit>& crossings, std::vector<std::uint32_t>& numbers) {
  numbers.resize(crossings.size());
  std::iota(numbers.begin(), numbers.end(), 0u);
  std::sort(numbers.begin(), numbers.end(), [&](std::uint32_t i, std::uint32_t k) {
    const RayHit& a = crossings[i];
    const RayHit& b = crossings[k];
    return std::tie(a.surface, a.root, a.object) < std::tie(b.surface, b.root, b.object);
  });
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    const RayHit& first = crossings[numbers[i - 1]];
    RayHit& next = crossings[numbers[i]];
    const bool is_one = next.surface == first.surface && next.surface != invalid_index;
    if (is_one && next.root == first.root) take_place(next, first);
  }
  // An object's own crossings stay in order.
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    const bool of_one = crossings[i].object == crossings[i - 1].object;
    if (of_one && is_before(crossings[i], crossings[i - 1]))
      take_place(crossings[i], crossings[i - 1]);
  }
}

/// A crossing looks for others of its object among so many before it, so that a place of very many
/// costs no more than their number.
constexpr std::size_t max_looked_at = 64;

/// Gives crossings of the standard tier that are at one place one t. Those of one object stay
/// apart.
void unify_places(const CompiledScene& scene, const WorldRay& ray, std::span<RayHit> crossings) {
  for (std::size_t begin = 0; begin + 1 < crossings.size();) {
    const RayHit& first = crossings[begin];
    const double tolerance = coincidence_tolerance(ray, first.t, first.error);
    std::optional<CommonPlace> place;
    std::size_t end = begin + 1;
    for (; end < crossings.size(); ++end) {
      const RayHit& next = crossings[end];
      const double gap = gap_between(first, next);
      if (gap > tolerance) break;
      if (gap == 0) continue;
      const auto some = crossings.subspan(begin, end - begin);
      const auto last = some.last(std::min(some.size(), max_looked_at));
      const auto is_its_own = [&](const RayHit& other) { return other.object == next.object; };
      if (std::any_of(last.begin(), last.end(), is_its_own)) break;
      if (!place) place.emplace(reach_of_place(scene, ray, first));
      if (!place->take(gap, reach_of_place(scene, ray, next))) break;
    }
    const std::span<RayHit> some = crossings.subspan(begin, end - begin);
    begin = end;
    if (some.size() == 1) continue;
    const RayHit best =
        *std::min_element(some.begin(), some.end(),
                          [](const RayHit& a, const RayHit& b) { return a.error < b.error; });
    for (RayHit& crossing : some) take_place(crossing, best);
  }
}

/// Sorts crossings at one place, where those of one object are side by side: what is left comes
/// before what is entered. An object with several crossings takes turns with the others.
void sort_one_place(std::span<RayHit> crossings,
                    std::vector<std::pair<std::uint32_t, RayHit>>& turns) {
  turns.clear();
  for (const RayHit& crossing : crossings) {
    const bool goes_on = !turns.empty() && turns.back().second.object == crossing.object;
    const std::uint32_t first_turn = crossing.entering ? 1 : 0;
    turns.emplace_back(goes_on ? turns.back().first + 1 : first_turn, crossing);
  }
  std::sort(turns.begin(), turns.end(), [](const auto& a, const auto& b) {
    return std::tie(a.first, a.second.object) < std::tie(b.first, b.second.object);
  });
  for (std::size_t i = 0; i < crossings.size(); ++i) crossings[i] = turns[i].second;
}

/// Calls take(run) for each run of two or more crossings in which belong(previous, next) holds for
/// all neighbours.
template <class Belong, class Take>
void each_run(std::span<RayHit> crossings, const Belong& belong, const Take& take) {
  std::size_t begin = 0;
  for (std::size_t end = 1; end <= crossings.size(); ++end) {
    if (end < crossings.size() && belong(crossings[end - 1], crossings[end])) continue;
    if (end - begin > 1) take(crossings.subspan(begin, end - begin));
    begin = end;
  }
}

void sort_places(std::span<RayHit> crossings, RayWorkspace& work) {
  const auto are_at_one = [](const RayHit& a, const RayHit& b) { return !is_before(a, b); };
  each_run(crossings, are_at_one,
           [&](std::span<RayHit> some) { sort_one_place(some, work.turns); });
}

/// Sorts crossings of the exact tier that t alone cannot separate, and unifies those at one place.
void sort_near(const CompiledScene& scene, const WorldRay& ray, std::span<RayHit> crossings,
               RayWorkspace& work) {
  std::vector<NearCrossing>& near = work.near_crossings;
  near.clear();
  for (const RayHit& hit : crossings) {
    near.push_back(near_crossing(hit, static_cast<std::uint32_t>(near.size())));
  }
  const auto leaf_on_ray = [&](const NearCrossing& crossing) -> LeafOnRay {
    const RayHit& hit = crossings[crossing.item];
    const Leaf& leaf = scene.leaf_of(hit);
    const SceneObject& object = scene.objects[hit.object];
    if (!object.is_instance())
      return {leaf, start_on_leaf(leaf, hit.leaf, scene.face_surfaces, ray.start)};
    const CompiledScene& prototype = scene.prototype_of(object);
    return {PlacedLeaf(leaf, scene.frame_of(object, work.placements).placement_of(leaf)),
            start_on_leaf(leaf, hit.leaf - object.first_leaf, prototype.face_surfaces,
                          start_in_prototype(scene, object, ray.start))};
  };
  // By reference the function takes no memory.
  if (!sort_exactly(near, std::ref(leaf_on_ray), ray, work.leaf_escalations)) return;
  std::vector<RayHit>& before = work.unsorted;
  before.assign(crossings.begin(), crossings.end());
  const NearCrossing* best = nullptr;
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    if (i == 0 || near[i].rank != near[i - 1].rank) {
      best = &near[i];
      for (std::size_t k = i + 1; k < near.size() && near[k].rank == near[i].rank; ++k) {
        if (near[k].error < best->error) best = &near[k];
      }
    }
    crossings[i] = before[near[i].item];
    crossings[i].t = best->t;
    crossings[i].error = best->error;
    crossings[i].t_low = best->t_low;
  }
}

}  // namespace

double reach_of_place(const CompiledScene& scene, const WorldRay& ray, const RayHit& hit) {
  const LeafOfHit in_place(scene, hit);
  return reach_of_place({in_place.leaf(), in_place.placement()}, ray,
                        {.t = hit.t,
                         .error = hit.error,
                         .face = hit.face,
                         .root = hit.root,
                         .entering = hit.entering});
}

void sort_crossings(const CompiledScene& scene, const WorldRay& ray, bool share_surfaces,
                    std::vector<RayHit>& crossings, RayWorkspace& work) {
  if (crossings.size() < 2) return;
  if (share_surfaces) unify_coincident(crossings, work.numbers);
  sort_stably(crossings, is_before);
  if (scene.leaf_of(crossings[0]).exact) {
    const auto are_near = [](const RayHit& a, const RayHit& b) {
      return b.t <= a.t + looking_distance(a.t);
    };
    each_run(crossings, are_near,
             [&](std::span<RayHit> some) { sort_near(scene, ray, some, work); });
  } else {
    unify_places(scene, ray, crossings);
  }
  sort_places(crossings, work);
}

}  // namespace crt::core
