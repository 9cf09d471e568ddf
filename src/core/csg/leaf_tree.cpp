#include "core/csg/leaf_tree.hpp"

#include <algorithm>

namespace crt::core {
namespace {

double half_area(const Bounds& box) {
  if (box.empty()) return 0;
  const Vec3 size = box.upper - box.lower;
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

}  // namespace

LeafTree::LeafTree(std::span<const Bounds> boxes) {
  std::vector<Item> items;
  items.reserve(boxes.size());
  for (std::uint32_t leaf = 0; leaf < boxes.size(); ++leaf) {
    const Bounds& box = boxes[leaf];
    if (box.empty()) continue;
    if (box.finite()) {
      items.push_back({box, 0.5 * box.lower + 0.5 * box.upper, leaf});
    } else {
      unbounded_.push_back(leaf);
    }
  }
  if (items.empty()) return;

  struct Pending {
    std::uint32_t node;
    std::span<Item> items;
  };
  const auto box_of = [](std::span<const Item> part) {
    Bounds box;
    for (const Item& item : part) box.include(item.box);
    return box;
  };
  nodes_.emplace_back();
  std::vector<Pending> stack{{0, items}};
  while (!stack.empty()) {
    const Pending pending = stack.back();
    stack.pop_back();
    // The largest part is divided until there are as many as a node has room for.
    std::vector<std::span<Item>> parts{pending.items};
    while (parts.size() < width) {
      const auto largest = std::max_element(parts.begin(), parts.end(),
                                            [](const auto& a, const auto& b) { return a.size() < b.size(); });
      if (largest->size() < 2) break;
      const std::span<Item> part = *largest;
      const std::size_t middle = split(part);
      *largest = part.first(middle);
      parts.push_back(part.subspan(middle));
    }
    for (const std::span<Item>& part : parts) {
      if (part.size() == 1) {
        add_child(pending.node, part[0].box, Child::leaf(part[0].leaf));
        continue;
      }
      const auto child = static_cast<std::uint32_t>(nodes_.size());
      nodes_.emplace_back();
      add_child(pending.node, box_of(part), Child::node(child));
      stack.push_back({child, part});
    }
  }
}

void LeafTree::add_child(std::uint32_t node_index, const Bounds& box, Child child) {
  Node& node = nodes_[node_index];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    node.lower[axis][node.count] = box.lower[static_cast<int>(axis)];
    node.upper[axis][node.count] = box.upper[static_cast<int>(axis)];
  }
  node.children[node.count++] = child;
}

std::size_t LeafTree::split(std::span<Item> items) {
  Bounds middles;
  for (const Item& item : items) middles.include(item.middle);
  const Vec3 size = middles.upper - middles.lower;
  int axis = size.y > size.x ? 1 : 0;
  if (size.z > size[axis]) axis = 2;

  constexpr std::size_t bin_count = 16;
  constexpr std::size_t fewest_for_bins = 8;
  const double low = middles.lower[axis];
  const double scale = static_cast<double>(bin_count) / size[axis];
  if (items.size() >= fewest_for_bins && size[axis] > 0 && std::isfinite(scale)) {
    const auto bin_of = [&](const Item& item) {
      return std::min(static_cast<std::size_t>((item.middle[axis] - low) * scale), bin_count - 1);
    };
    struct Bin {
      Bounds box;
      std::size_t count = 0;
    };
    std::array<Bin, bin_count> bins;
    for (const Item& item : items) {
      Bin& bin = bins[bin_of(item)];
      bin.box.include(item.box);
      ++bin.count;
    }
    // What of the cost is to the right of each boundary, then the sum with what is to the left.
    std::array<double, bin_count> right_cost{};
    Bin right;
    for (std::size_t i = bin_count; i-- > 1;) {
      right.box.include(bins[i].box);
      right.count += bins[i].count;
      right_cost[i] = half_area(right.box) * static_cast<double>(right.count);
    }
    Bin left;
    double best_cost = std::numeric_limits<double>::infinity();
    std::size_t best = 0;
    for (std::size_t i = 1; i < bin_count; ++i) {
      left.box.include(bins[i - 1].box);
      left.count += bins[i - 1].count;
      if (left.count == 0 || left.count == items.size()) continue;
      const double cost = half_area(left.box) * static_cast<double>(left.count) + right_cost[i];
      if (cost < best_cost) {
        best_cost = cost;
        best = i;
      }
    }
    if (best > 0) {
      const auto middle = std::stable_partition(items.begin(), items.end(),
                                                [&](const Item& item) { return bin_of(item) < best; });
      return static_cast<std::size_t>(middle - items.begin());
    }
  }
  const std::size_t half = items.size() / 2;
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                   [&](const Item& a, const Item& b) {
                     return a.middle[axis] != b.middle[axis] ? a.middle[axis] < b.middle[axis]
                                                             : a.leaf < b.leaf;
                   });
  return half;
}

}  // namespace crt::core
