#include "core/csg/exact_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>

#include "core/csg/evaluate.hpp"
#include "core/math/real_root.hpp"
#include "core/math/stable_sort.hpp"

namespace crt::core {
namespace {

constexpr auto is_before = [](const NearCrossing& a, const NearCrossing& b) {
  return std::tie(a.t, a.t_low) < std::tie(b.t, b.t_low);
};

/// Returns a number below 0, 0 or above it, if their bounds or surfaces decide the order. Returns
/// nothing if only the roots do.
std::optional<int> order_by_bounds(const NearCrossing& a, const NearCrossing& b) {
  if (a.surface == b.surface && a.surface != invalid_index && a.root == b.root) return 0;
  const double distance = (a.t - b.t) + (a.t_low - b.t_low);
  // The rounding of the distance is far less than the margin in the errors.
  if (std::abs(distance) > a.error + b.error) return distance > 0 ? 1 : -1;
  return std::nullopt;
}

/// Gives crossings that are sorted by t their ranks. Returns false if this takes roots.
bool rank_by_bounds(std::span<NearCrossing> crossings) {
  crossings[0].rank = 1;
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    const std::optional<int> order = order_by_bounds(crossings[i - 1], crossings[i]);
    if (!order) return false;
    crossings[i].rank = crossings[i - 1].rank + (*order < 0 ? 1 : 0);
  }
  return true;
}

class ExactOrder {
 public:
  ExactOrder(std::span<const NearCrossing> crossings, const FindLeaf& find_leaf,
             const WorldRay& ray, std::uint64_t& escalations)
      : crossings_(crossings),
        find_leaf_(find_leaf),
        ray_(ray),
        escalations_(escalations),
        places_(crossings.size()) {}

  /// Returns the numbers of the crossings, sorted.
  std::vector<std::size_t> sorted() {
    std::vector<std::size_t> numbers(crossings_.size());
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    std::stable_sort(numbers.begin(), numbers.end(),
                     [&](std::size_t a, std::size_t b) { return compare(a, b) < 0; });
    return numbers;
  }

  int compare(std::size_t a, std::size_t b) {
    if (const std::optional<int> order = order_by_bounds(crossings_[a], crossings_[b]))
      return *order;
    std::optional<RealRoot>& first = place(a);
    std::optional<RealRoot>& second = place(b);
    return first && second ? order(*first, *second) : 0;
  }

  /// Returns whether all places that were asked for are known.
  bool all_known() const { return all_known_; }

 private:
  struct Place {
    bool is_found = false;
    std::optional<RealRoot> root;
  };

  std::optional<RealRoot>& place(std::size_t number) {
    Place& place = places_[number];
    if (place.is_found) return place.root;
    const NearCrossing& crossing = crossings_[number];
    const auto [leaf, start] = find_leaf_(crossing);
    ObjectRay object_ray = leaf.placement.to_object(ray_.origin, ray_.direction);
    object_ray.start = start;
    place = {true, leaf.leaf.exact->place(exact_ray(leaf.placement, ray_, object_ray, escalations_),
                                          {.t = crossing.t,
                                           .error = crossing.error,
                                           .t_low = crossing.t_low,
                                           .face = crossing.face,
                                           .root = crossing.root})};
    all_known_ = all_known_ && place.root;
    return place.root;
  }

  std::span<const NearCrossing> crossings_;
  const FindLeaf& find_leaf_;
  const WorldRay& ray_;
  std::uint64_t& escalations_;
  std::vector<Place> places_;
  bool all_known_ = true;
};

/// Moves a crossing beyond those of lower ranks, if it is not there already. `last` is the farthest
/// of these.
void move_beyond(const NearCrossing& last, NearCrossing& crossing) {
  if (is_before(last, crossing)) return;
  const double t_low = std::nextafter(last.t_low, std::numeric_limits<double>::infinity());
  crossing.error += std::abs((last.t - crossing.t) + (t_low - crossing.t_low));
  crossing.t = last.t;
  crossing.t_low = t_low;
}

}  // namespace

bool sort_exactly(std::vector<NearCrossing>& crossings, const FindLeaf& find_leaf,
                  const WorldRay& ray, std::uint64_t& escalations) {
  sort_stably(crossings, is_before);
  if (rank_by_bounds(crossings)) return true;
  ExactOrder order(crossings, find_leaf, ray, escalations);
  const std::vector<std::size_t> numbers = order.sorted();
  std::vector<NearCrossing> result;
  result.reserve(crossings.size());
  NearCrossing last;      // of lower ranks
  NearCrossing farthest;  // of all so far
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    NearCrossing& crossing = result.emplace_back(crossings[numbers[i]]);
    crossing.rank = i == 0 ? 1 : result[i - 1].rank;
    if (i > 0 && order.compare(numbers[i - 1], numbers[i]) < 0) {
      ++crossing.rank;
      last = farthest;
    }
    if (crossing.rank > 1) move_beyond(last, crossing);
    if (i == 0 || is_before(farthest, crossing)) farthest = crossing;
  }
  if (!order.all_known()) return false;
  crossings = std::move(result);
  return true;
}

}  // namespace crt::core
