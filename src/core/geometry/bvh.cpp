#include "core/geometry/bvh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/base/large_pages.hpp"
#include "core/geometry/compact_bvh.hpp"
#include "core/math/lanes.hpp"
#include "core/tasks/parallel.hpp"

namespace crt::core {

namespace {

/// A LaneBox is a box in vector lanes: x, y, z and one that is not used.
struct LaneBox {
  Lanes lower = infinity;
  Lanes upper = lanes_of(-infinity, -infinity, -infinity, -infinity);

  void include(const Lanes& other_lower, const Lanes& other_upper) {
    lower = min(lower, other_lower);
    upper = max(upper, other_upper);
  }
  void include(const LaneBox& other) { include(other.lower, other.upper); }

  Bounds bounds() const { return {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}}; }

  double half_area() const {
    if (!(lower[0] <= upper[0])) return 0;
    const Lanes size = upper - lower;
    return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
  }
};

/// An Item is a box to put into the tree.
struct Item {
  LaneBox box;  ///< with the leaf's number in the lane that is not used

  Item(const Bounds& bounds, std::uint32_t leaf)
      : box{.lower = lanes_of(bounds.lower.x, bounds.lower.y, bounds.lower.z, leaf),
            .upper = lanes_of(bounds.upper.x, bounds.upper.y, bounds.upper.z, leaf)} {}

  std::uint32_t leaf() const { return static_cast<std::uint32_t>(box.lower[3]); }
  Lanes middle() const { return 0.5 * box.lower + 0.5 * box.upper; }
  double middle(std::size_t axis) const { return 0.5 * box.lower[axis] + 0.5 * box.upper[axis]; }
};

/// A Part is some of the items, which lie side by side.
struct Part {
  std::span<Item> items;
  LaneBox box{};      ///< around them
  LaneBox middles{};  ///< around the middles of their boxes

  void include(const Item& item) {
    box.include(item.box);
    const Lanes middle = item.middle();
    middles.include(middle, middle);
  }
};

Part part_of(std::span<Item> items) {
  Part part{.items = items};
  for (const Item& item : items) part.include(item);
  return part;
}

struct TwoParts {
  Part left;
  Part right;
};

/// Divides a part in the middle, by the number of items.
TwoParts halves(const Part& part, std::size_t axis) {
  const std::size_t half = part.items.size() / 2;
  std::nth_element(part.items.begin(), part.items.begin() + static_cast<std::ptrdiff_t>(half),
                   part.items.end(), [&](const Item& a, const Item& b) {
                     const double a_middle = a.middle(axis);
                     const double b_middle = b.middle(axis);
                     return a_middle != b_middle ? a_middle < b_middle : a.leaf() < b.leaf();
                   });
  return {part_of(part.items.first(half)), part_of(part.items.subspan(half))};
}

/// A Bin is what of a part has its middle in one of several equal slices across an axis.
struct Bin {
  LaneBox box;
  LaneBox middles;
  std::size_t count = 0;

  void include(const Bin& other) {
    box.include(other.box);
    middles.include(other.middles);
    count += other.count;
  }
  double cost() const { return count == 0 ? 0 : box.half_area() * static_cast<double>(count); }
};

TwoParts split(const Part& part) {
  const Lanes size = part.middles.upper - part.middles.lower;
  std::size_t axis = size[1] > size[0] ? 1 : 0;
  if (size[2] > size[axis]) axis = 2;

  constexpr std::size_t bin_count = 16;
  constexpr std::size_t fewest_for_bins = 8;
  const double low = part.middles.lower[axis];
  const double scale = static_cast<double>(bin_count) / size[axis];
  if (part.items.size() < fewest_for_bins || !(size[axis] > 0) || !std::isfinite(scale))
    return halves(part, axis);

  const auto bin_of = [&](double middle) {
    return std::min(static_cast<std::size_t>((middle - low) * scale), bin_count - 1);
  };
  std::array<Bin, bin_count> bins;
  for (const Item& item : part.items) {
    const Lanes middle = item.middle();
    Bin& bin = bins[bin_of(middle[axis])];
    bin.box.include(item.box);
    bin.middles.include(middle, middle);
    ++bin.count;
  }
  // `right` is what is to the right of each boundary, then `left` is what is to the left.
  std::array<Bin, bin_count> right;
  right[bin_count - 1] = bins[bin_count - 1];
  for (std::size_t i = bin_count - 1; i-- > 1;) {
    right[i] = right[i + 1];
    right[i].include(bins[i]);
  }
  Bin left;
  Bin best_left;
  double best_cost = infinity;
  std::size_t best = 0;
  for (std::size_t i = 1; i < bin_count; ++i) {
    left.include(bins[i - 1]);
    if (left.count == 0 || left.count == part.items.size()) continue;
    const double cost = left.cost() + right[i].cost();
    if (cost < best_cost) {
      best_cost = cost;
      best_left = left;
      best = i;
    }
  }
  if (best == 0) return halves(part, axis);
  std::partition(part.items.begin(), part.items.end(),
                 [&](const Item& item) { return bin_of(item.middle(axis)) < best; });
  const std::size_t count = best_left.count;
  return {{part.items.first(count), best_left.box, best_left.middles},
          {part.items.subspan(count), right[best].box, right[best].middles}};
}

/// A Division is what becomes the children of one node, up to `width` of them.
template <std::size_t width>
struct Division {
  std::array<Part, width> parts;
  std::size_t count = 1;

  /// Divides the largest part until there are as many as a node has places for, or all are small
  /// enough for a leaf.
  Division(const Part& whole, std::size_t items_a_leaf) : parts{whole} {
    while (count < parts.size()) {
      const auto largest = std::max_element(
          parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(count),
          [](const Part& a, const Part& b) { return a.items.size() < b.items.size(); });
      if (largest->items.size() <= items_a_leaf) break;
      const TwoParts two = split(*largest);
      *largest = two.left;
      parts[count++] = two.right;
    }
  }
};

}  // namespace

/// A Builder divides the upper nodes level by level, a task a node. What is below them is divided
/// in pieces of their own, a task a piece. Neither depends on the number of threads.
template <class Node>
class BvhOf<Node>::Builder {
 public:
  Builder(std::vector<Node>& nodes, std::uint32_t items_a_leaf, const Workers& workers)
      : nodes_(nodes), items_a_leaf_(items_a_leaf), workers_(workers) {}

  void build(std::span<Item> items) {
    items_ = items;
    nodes_.emplace_back();
    std::vector<Pending> level{{0, part_of(items)}};
    while (!level.empty()) level = divide_level(level);
    build_lower_parts();
  }

 private:
  using Parts = Division<Node::width>;
  struct Pending {
    std::uint32_t node;
    Part part;
  };

  static std::uint32_t add_node(std::vector<Node>& nodes) {
    nodes.emplace_back();
    return static_cast<std::uint32_t>(nodes.size() - 1);
  }

  /// Divides what is large and leaves what is not for later. Returns the next level.
  std::vector<Pending> divide_level(const std::vector<Pending>& level) {
    std::vector<std::size_t> large;
    for (std::size_t i = 0; i < level.size(); ++i) {
      if (level[i].part.items.size() > items_for_a_thread) {
        large.push_back(i);
      } else {
        lower_parts_.push_back(level[i]);
      }
    }
    std::vector<std::optional<Parts>> divisions(large.size());
    for_ranges(large.size(), 1, workers_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        divisions[i].emplace(level[large[i]].part, items_a_leaf_);
    });
    std::vector<Pending> next;
    for (std::size_t i = 0; i < large.size(); ++i) {
      add_children(nodes_, level[large[i]].node, *divisions[i], next);
    }
    return next;
  }

  /// Returns the leaf that has all of a part.
  Child leaf_of(const Part& part) const {
    if (items_a_leaf_ == 1) return Child::leaf(part.items[0].leaf());
    return Child::leaf(static_cast<std::uint32_t>(part.items.data() - items_.data()),
                       static_cast<std::uint32_t>(part.items.size()));
  }

  void add_children(std::vector<Node>& nodes, std::uint32_t node, const Parts& division,
                    std::vector<Pending>& pending) const {
    std::array<Bounds, Node::width> boxes;
    std::array<Child, Node::width> children{};
    for (std::size_t i = 0; i < division.count; ++i) {
      const Part& part = division.parts[i];
      boxes[i] = part.box.bounds();
      if (part.items.size() <= items_a_leaf_) {
        children[i] = leaf_of(part);
      } else {
        pending.push_back({add_node(nodes), part});
        children[i] = Child::node(pending.back().node);
      }
    }
    nodes[node] = Node(std::span(boxes).first(division.count),
                       std::span<const Child>(children).first(division.count));
  }

  /// Returns the tree over one part, its root first.
  std::vector<Node> tree_over(const Part& part) const {
    std::vector<Node> nodes;
    std::vector<Pending> open{{add_node(nodes), part}};
    while (!open.empty()) {
      const Pending pending = open.back();
      open.pop_back();
      add_children(nodes, pending.node, Parts(pending.part, items_a_leaf_), open);
    }
    return nodes;
  }

  /// Builds the trees over the lower parts. The root of each is there already, and its other nodes
  /// go behind all there are.
  void build_lower_parts() {
    std::vector<std::vector<Node>> trees(lower_parts_.size());
    for_ranges(trees.size(), 1, workers_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) trees[i] = tree_over(lower_parts_[i].part);
    });
    std::vector<std::size_t> places;
    std::size_t count = nodes_.size();
    for (const std::vector<Node>& tree : trees) {
      places.push_back(count);
      count += tree.size() - 1;
    }
    nodes_.reserve(count);
    const std::size_t more = (nodes_.capacity() - nodes_.size()) * sizeof(Node);
    ask_for_large_pages(nodes_.data() + nodes_.size(), more);
    nodes_.resize(count);
    for_ranges(trees.size(), 1, workers_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) put(trees[i], lower_parts_[i].node, places[i]);
    });
  }

  void put(std::span<Node> tree, std::uint32_t root, std::size_t place) {
    for (Node& node : tree) {
      for (Child& child : node.children) {
        if (!child.is_leaf() && child != Child())
          child = Child::node(child.index() - 1 + static_cast<std::uint32_t>(place));
      }
    }
    nodes_[root] = tree[0];
    std::copy(tree.begin() + 1, tree.end(), nodes_.begin() + static_cast<std::ptrdiff_t>(place));
  }

  std::vector<Node>& nodes_;
  std::size_t items_a_leaf_;
  Workers workers_;
  std::span<Item> items_;
  std::vector<Pending> lower_parts_;
};

PlainNode::PlainNode(std::span<const Bounds> boxes, std::span<const BvhChild> of_boxes)
    : count(static_cast<std::uint32_t>(boxes.size())) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      lower[static_cast<std::size_t>(axis)][i] = boxes[i].lower[axis];
      upper[static_cast<std::size_t>(axis)][i] = boxes[i].upper[axis];
    }
    children[i] = of_boxes[i];
  }
}

CompactNode::CompactNode(std::span<const Bounds> some, std::span<const BvhChild> of_boxes)
    : boxes(some) {
  std::copy(of_boxes.begin(), of_boxes.end(), children.begin());
}

template <class Node>
BvhOf<Node>::BvhOf(std::span<const Bounds> boxes, std::uint32_t items_a_leaf,
                   const Workers& workers) {
  std::vector<Item> items;
  items.reserve(boxes.size());
  for (std::uint32_t leaf = 0; leaf < boxes.size(); ++leaf) {
    const Bounds& box = boxes[leaf];
    if (box.empty()) continue;
    if (box.finite()) {
      items.emplace_back(box, leaf);
    } else {
      unbounded_.push_back(leaf);
    }
  }
  if (!items.empty()) Builder(nodes_, items_a_leaf, workers).build(items);
  if (items_a_leaf == 1) return;
  order_.reserve(items.size());
  for (const Item& item : items) order_.push_back(item.leaf());
}

template class BvhOf<PlainNode>;
template class BvhOf<CompactNode>;

}  // namespace crt::core
