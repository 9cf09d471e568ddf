#include "core/compile/grouping.hpp"

#include <algorithm>
#include <tuple>

#include "core/geometry/placement.hpp"
#include "core/geometry/shape.hpp"
#include "core/math/vector.hpp"
#include "core/ray/coincidence_tolerance.hpp"
#include "core/tasks/parallel.hpp"

namespace crt::core {

namespace {

/// An Extent is a part, by its number, with its extent along the axis to be cut.
struct Extent {
  double lower = 0;
  double upper = 0;
  std::size_t part = 0;
};

/// A PartSet is a set of parts side by side in a list of extents, and how it is to be cut next.
struct PartSet {
  std::size_t begin = 0;
  std::size_t end = 0;
  int axis = 0;
  int axes_without_gap = 0;
  int cuts = 0;  ///< that led to it

  std::size_t size() const { return end - begin; }
};

/// This many cuts into a set are enough. Each is O(n log n), and some sets lose but one part by
/// each.
constexpr int max_cuts = 64;

class Grouping {
 public:
  Grouping(const std::vector<Bounds>& bounds, const Workers& workers)
      : bounds_(bounds), workers_(workers), extents_(bounds.size()) {
    for (std::size_t i = 0; i < extents_.size(); ++i) extents_[i].part = i;
  }

  /// Returns the groups, each a list of parts, in the order of their first parts.
  std::vector<std::span<const Extent>> groups() {
    std::vector<std::span<const Extent>> result;
    std::vector<PartSet> open{{.end = extents_.size()}};
    while (!open.empty()) {
      const PartSet set = open.back();
      open.pop_back();
      // Each set is cut along one axis after the other until no axis has cut it.
      if (set.size() == 1 || set.axes_without_gap == 3 || set.cuts == max_cuts) {
        const std::span<Extent> group = extents_of(set);
        sort_in_parallel(group, workers_,
                         [](const Extent& a, const Extent& b) { return a.part < b.part; });
        result.emplace_back(group);
      } else {
        cut_at_gaps(set, open);
      }
    }
    sort_in_parallel(std::span(result), workers_,
                     [](const auto& a, const auto& b) { return a.front().part < b.front().part; });
    return result;
  }

 private:
  std::span<Extent> extents_of(const PartSet& set) {
    return std::span(extents_).subspan(set.begin, set.size());
  }

  /// Cuts a set wherever there is a gap between boxes along its axis.
  void cut_at_gaps(const PartSet& set, std::vector<PartSet>& pieces) {
    const std::span<Extent> extents = extents_of(set);
    for_ranges(extents.size(), items_for_a_thread, workers_,
               [&](std::size_t begin, std::size_t end) {
                 for (Extent& extent : extents.subspan(begin, end - begin)) {
                   extent.lower = bounds_[extent.part].lower[set.axis];
                   extent.upper = bounds_[extent.part].upper[set.axis];
                 }
               });
    sort_in_parallel(extents, workers_, [](const Extent& a, const Extent& b) {
      return std::tie(a.lower, a.part) < std::tie(b.lower, b.part);
    });
    const std::size_t first_piece = pieces.size();
    std::size_t begin = 0;
    double reach = extents[0].upper;
    const auto add_piece = [&](std::size_t end) {
      pieces.push_back({.begin = set.begin + begin,
                        .end = set.begin + end,
                        .axis = (set.axis + 1) % 3,
                        .axes_without_gap = 1,
                        .cuts = set.cuts + 1});
      begin = end;
    };
    for (std::size_t i = 1; i < extents.size(); ++i) {
      if (extents[i].lower > reach) add_piece(i);
      reach = std::max(reach, extents[i].upper);
    }
    add_piece(extents.size());
    if (pieces.size() == first_piece + 1) pieces.back().axes_without_gap = set.axes_without_gap + 1;
  }

  const std::vector<Bounds>& bounds_;
  Workers workers_;
  std::vector<Extent> extents_;
};

/// Returns a box that holds all that may be at one place with something in a box.
Bounds with_place(const Bounds& box) {
  if (!box.finite()) return box;
  const double size = largest_component(box.upper - box.lower) + box.farthest();
  return box.grown(2 * roundings_of_place * unit_roundoff * size);
}

}  // namespace

Bounds part_bounds(const Part& part) {
  TransformPool pool;
  Bounds total;
  std::vector<Part> open{part};
  while (!open.empty()) {
    const Part next = open.back();
    open.pop_back();
    if (const auto* primitive = std::get_if<Primitive>(&next.node->content)) {
      const Bounds bounds = make_shape(*primitive)->bounds();
      total.include(next.to_world == nullptr
                        ? bounds
                        : Placement(next.to_world->product).bounds_to_world(bounds));
      continue;
    }
    // A difference lies within its first part, and so does an intersection.
    const CsgOperation& operation = *next.operation();
    const std::size_t count = operation.op == CsgOperator::set_union ? operation.parts.size() : 1;
    for (std::size_t i = 0; i < count; ++i) open.push_back(next.child(operation.parts[i], pool));
  }
  return total;
}

std::vector<std::size_t> disjoint_groups(std::vector<Part>& parts,
                                         const std::function<Bounds(const Part&)>& bounds_of,
                                         const Workers& workers) {
  if (parts.size() < 2) return std::vector<std::size_t>(parts.size(), parts.size());
  std::vector<Bounds> bounds(parts.size());
  for_ranges(parts.size(), items_for_a_thread / 4, workers,
             [&](std::size_t begin, std::size_t end) {
               for (std::size_t i = begin; i < end; ++i)
                 bounds[i] = with_place(bounds_of(parts[i]));
             });
  Grouping grouping(bounds, workers);
  std::vector<Part> grouped;
  grouped.reserve(parts.size());
  std::vector<std::size_t> ends;
  for (const std::span<const Extent> group : grouping.groups()) {
    for (const Extent& extent : group) grouped.push_back(parts[extent.part]);
    ends.push_back(grouped.size());
  }
  parts = std::move(grouped);
  return ends;
}

}  // namespace crt::core
