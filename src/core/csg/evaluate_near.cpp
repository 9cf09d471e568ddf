// This part of CsgEvaluation handles crossings that are near to each other: which of them are at
// one place, by the rule of one_place.hpp, and in the exact tier without rounding.
#include <algorithm>

#include "core/csg/evaluate.hpp"

namespace crt::core {

namespace {

/// A crossing looks for others of its leaf among so many before it, so that a place of very many
/// costs no more than their number.
constexpr std::size_t max_looked_at = 64;

}  // namespace

bool CsgEvaluation::is_near(const CsgCrossing& first, const CsgCrossing& other) const {
  if (first.place != 0) return other.place == first.place;
  const double tolerance = this->tolerance(first);
  return gap_between(first, other) <= std::max(tolerance, first.error + other.error) &&
         other.enter <= first.t + tolerance;
}

double CsgEvaluation::reach(CsgCrossing& crossing) const {
  if (crossing.reach < 0) {
    crossing.reach = reach_of_place(placed(leaves_[crossing.leaf]), ray_,
                                    {.t = crossing.t,
                                     .error = crossing.error,
                                     .face = crossing.face,
                                     .root = crossing.root,
                                     .entering = crossing.entering});
  }
  return crossing.reach;
}

bool CsgEvaluation::coincides(const CsgCrossing& first, CsgCrossing& next,
                              CommonPlace& place) const {
  if (first.place != 0) return true;
  // How long the line is in a leaf is known better than where.
  const auto own_reach = [&](const CsgCrossing& crossing) {
    return reach_in_leaf(crossing.t, crossing.error, crossing.reach);
  };
  next.reach = reach(next);
  const auto is_beyond_own = [&](const CsgCrossing* other) {
    return other->leaf == next.leaf &&
           gap_between(*other, next) > own_reach(*other) + own_reach(next);
  };
  const auto& cluster = work_.cluster_;
  const auto looked_at = static_cast<std::ptrdiff_t>(std::min(cluster.size(), max_looked_at));
  if (std::any_of(cluster.end() - looked_at, cluster.end(), is_beyond_own)) return false;
  return place.take(gap_between(first, next), next.reach);
}

void CsgEvaluation::order_near_crossings() {
  auto& openings = work_.openings_;
  const auto& to_come = work_.to_come_;
  while (!openings.empty() && is_near_next(openings.front().enter))
    open_up_to(openings.front().enter);
  if (next_crossing().place != 0) return;
  // The second crossing is one of the two below the first in the heap.
  const bool has_coincident = (to_come.size() > 1 && is_near_next(to_come[1].t)) ||
                              (to_come.size() > 2 && is_near_next(to_come[2].t));
  if (has_coincident) gather_near();
}

bool CsgEvaluation::is_near_next(double t) const {
  const double first = work_.to_come_.front().t;
  return t <= first + looking_distance(first);
}

void CsgEvaluation::gather_near() {
  auto& to_come = work_.to_come_;
  auto& near = work_.near_;
  auto& crossings = work_.near_crossings_;
  near.clear();
  crossings.clear();
  bool is_one = true;
  bool is_known = true;
  double end = to_come.front().t;
  // All that may be at the place of one of them is among them, too.
  while (true) {
    while (!work_.openings_.empty() && work_.openings_.front().enter <= end) {
      open_up_to(work_.openings_.front().enter);
    }
    if (to_come.empty() || to_come.front().t > end) break;
    const CsgWorkspace::ToCome next = to_come.front();
    std::pop_heap(to_come.begin(), to_come.end(), later());
    to_come.pop_back();
    end = std::max(end, next.t + looking_distance(next.t));
    near.push_back(next);
    const CsgCrossing& met = work_.met_[next.index];
    is_known = is_known && !met.moved;
    crossings.push_back(near_crossing(met, next.index));
    const NearCrossing& crossing = crossings.back();
    is_one =
        is_one && crossing.surface == crossings[0].surface && crossing.root == crossings[0].root;
  }
  const auto leaf_on_ray = [this](const NearCrossing& crossing) {
    const std::uint32_t index = work_.met_[crossing.item].leaf;
    const Leaf& leaf = leaves_[index];
    return LeafOnRay{placed(leaf),
                     start_on_leaf(leaf, first_leaf_ + index, face_surfaces_, ray_.start)};
  };
  if (!is_one && is_known && sort_exactly(crossings, leaf_on_ray, ray_, work_.escalations)) {
    near.clear();
    for (const NearCrossing& crossing : crossings) {
      CsgCrossing& met = work_.met_[crossing.item];
      met.t = crossing.t;
      met.t_low = crossing.t_low;
      met.error = crossing.error;
      met.place = work_.places_ + crossing.rank;
      near.push_back({crossing.t, crossing.item});
    }
    work_.places_ += crossings.back().rank;
  }
  for (const CsgWorkspace::ToCome& crossing : near) {
    to_come.push_back(crossing);
    std::push_heap(to_come.begin(), to_come.end(), later());
  }
}

}  // namespace crt::core
