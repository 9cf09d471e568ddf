#include "core/scene/shaft_tree.hpp"

#include <limits>

#include "core/tasks/parallel.hpp"

namespace crt::core {

namespace {

BoxLanes no_boxes() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Lanes lower = lanes_of(infinity);
  const Lanes upper = lanes_of(-infinity);
  return {.lower = {lower, lower, lower}, .upper = {upper, upper, upper}};
}

void set(BoxLanes& boxes, std::size_t lane, const Bounds& box) {
  const int i = static_cast<int>(lane);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    boxes.lower[axis][i] = box.lower[static_cast<int>(axis)];
    boxes.upper[axis][i] = box.upper[static_cast<int>(axis)];
  }
}

/// Around all of them.
Bounds box_around(const BoxLanes& boxes) {
  Bounds result;
  for (int lane = 0; lane < lane_count; ++lane) {
    Bounds box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.lower[static_cast<int>(axis)] = boxes.lower[axis][lane];
      box.upper[static_cast<int>(axis)] = boxes.upper[axis][lane];
    }
    result.include(box);
  }
  return result;
}

/// Makes nodes of children, whose boxes box_of(index) says.
template <class BoxOf>
void make_level(std::span<BoxLanes> nodes, std::size_t children, const BoxOf& box_of) {
  for_ranges(nodes.size(), items_for_a_thread, 0, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      nodes[i] = no_boxes();
      for (std::size_t lane = 0; lane < lane_count && i * lane_count + lane < children; ++lane) {
        set(nodes[i], lane, box_of(i * lane_count + lane));
      }
    }
  });
}

std::size_t nodes_over(std::size_t children) {
  return (children + lane_count - 1) / lane_count;
}

}  // namespace

ShaftTree::ShaftTree(std::span<const Bounds> boxes) {
  std::size_t total = 0;
  for (std::size_t count = nodes_over(boxes.size()); count > 0; count = count == 1 ? 0 : nodes_over(count)) {
    level_begin_[level_count_++] = static_cast<std::uint32_t>(total);
    total += count;
  }
  nodes_.resize(total);
  std::span<BoxLanes> below;
  for (std::uint32_t level = 0; level < level_count_; ++level) {
    const std::size_t children = level == 0 ? boxes.size() : below.size();
    const std::span<BoxLanes> nodes = std::span(nodes_).subspan(level_begin_[level], nodes_over(children));
    make_level(nodes, children, [&](std::size_t i) { return level == 0 ? boxes[i] : box_around(below[i]); });
    below = nodes;
  }
}

}  // namespace crt::core
