#include "core/scene/grouping.hpp"

#include <algorithm>
#include <numeric>

#include "core/csg/placement.hpp"
#include "core/geometry/shape.hpp"

namespace crt::core {

namespace {

using Indices = std::vector<std::size_t>;

/// Cuts `indices` wherever there is a gap between boxes along `axis`.
std::vector<Indices> split_at_gaps(Indices indices, const std::vector<Bounds>& bounds, int axis) {
  std::sort(indices.begin(), indices.end(),
            [&](std::size_t a, std::size_t b) { return bounds[a].lower[axis] < bounds[b].lower[axis]; });
  std::vector<Indices> pieces;
  double reach = 0;
  for (const std::size_t index : indices) {
    if (pieces.empty() || bounds[index].lower[axis] > reach) {
      pieces.emplace_back();
      reach = bounds[index].upper[axis];
    }
    pieces.back().push_back(index);
    reach = std::max(reach, bounds[index].upper[axis]);
  }
  return pieces;
}

}  // namespace

Bounds part_bounds(const Part& part) {
  Bounds total;
  std::vector<Part> open{part};
  while (!open.empty()) {
    const Part next = open.back();
    open.pop_back();
    if (const auto* primitive = std::get_if<Primitive>(&next.node->content)) {
      total.include(Placement(next.to_world).bounds_to_world(make_shape(*primitive)->bounds()));
      continue;
    }
    // A difference lies within its first part, and so does an intersection.
    const auto& operation = std::get<CsgOperation>(next.node->content);
    const std::size_t count = operation.op == CsgOperator::set_union ? operation.parts.size() : 1;
    for (std::size_t i = 0; i < count; ++i) open.push_back(next.child(operation.parts[i]));
  }
  return total;
}

std::vector<std::vector<Part>> group_apart(std::vector<Part> parts) {
  if (parts.empty()) return {};
  if (parts.size() == 1) return {std::move(parts)};
  std::vector<Bounds> bounds;
  bounds.reserve(parts.size());
  for (const Part& part : parts) bounds.push_back(part_bounds(part));

  // Each set is cut along one axis after the other until no axis has cut it.
  struct Open {
    Indices indices;
    int axis = 0;
    int axes_without_gap = 0;
  };
  Indices all(parts.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<Open> open{{std::move(all), 0, 0}};
  std::vector<Indices> groups;
  while (!open.empty()) {
    Open set = std::move(open.back());
    open.pop_back();
    if (set.indices.size() == 1 || set.axes_without_gap == 3) {
      std::sort(set.indices.begin(), set.indices.end());
      groups.push_back(std::move(set.indices));
      continue;
    }
    std::vector<Indices> pieces = split_at_gaps(std::move(set.indices), bounds, set.axis);
    const int without_gap = pieces.size() == 1 ? set.axes_without_gap + 1 : 1;
    for (Indices& piece : pieces) open.push_back({std::move(piece), (set.axis + 1) % 3, without_gap});
  }
  std::sort(groups.begin(), groups.end(),
            [](const Indices& a, const Indices& b) { return a.front() < b.front(); });

  std::vector<std::vector<Part>> result(groups.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (const std::size_t index : groups[i]) result[i].push_back(parts[index]);
  }
  return result;
}

}  // namespace crt::core
