#include "core/render/media_along_ray.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace crt::core {

namespace {

/// At most so many crossings or nodes are looked through one by one.
constexpr std::size_t few = 16;

/// Returns the priority of a node in the treap, which is a hash of its number.
std::uint32_t priority(std::uint32_t node) {
  constexpr std::uint32_t factor = 0x9e3779b9u;  // 2^32 / the golden ratio
  const std::uint32_t mixed = (node + 1) * factor;
  return (mixed ^ mixed >> 15) * factor;
}

}  // namespace

void MediaAlongRay::begin(std::span<const RayHit> crossings, const Line& line) {
  crossings_ = crossings;
  line_ = &line;
  node_count_ = 0;
  passings_.clear();
  root_ = innermost_ = invalid_index;
}

void MediaAlongRay::sort_passings() {
  if (!passings_.empty()) return;
  for (std::uint32_t i = 0; i < crossings_.size(); ++i)
    passings_.push_back({crossings_[i].object, i});
  std::sort(passings_.begin(), passings_.end(), [](const Passing& a, const Passing& b) {
    return std::tie(a.object, a.index) < std::tie(b.object, b.index);
  });
  for (std::uint32_t node = 0; node < node_count_; ++node) {
    Passing* const passing = passing_of(nodes_[node].medium.object);
    if (passing != nullptr) passing->node = node;
  }
}

std::size_t MediaAlongRay::first_passing(std::uint32_t object, std::size_t index) const {
  const auto found =
      std::partition_point(passings_.begin(), passings_.end(), [&](const Passing& passing) {
        return passing.object != object ? passing.object < object : passing.index < index;
      });
  return static_cast<std::size_t>(found - passings_.begin());
}

MediaAlongRay::Passing* MediaAlongRay::passing_of(std::uint32_t object) {
  const std::size_t first = first_passing(object, 0);
  return first < passings_.size() && passings_[first].object == object ? &passings_[first]
                                                                       : nullptr;
}

std::uint32_t MediaAlongRay::node_of(std::uint32_t object) {
  const auto is_its = [&](std::uint32_t node) {
    return nodes_[node].is_there && nodes_[node].medium.object == object;
  };
  if (innermost_ == invalid_index || is_its(innermost_)) return innermost_;
  if (node_count_ <= few) {
    std::uint32_t node = 0;
    while (node < node_count_ && !is_its(node)) ++node;
    return node < node_count_ ? node : invalid_index;
  }
  sort_passings();
  const Passing* const passing = passing_of(object);
  const bool is_known =
      passing != nullptr && passing->node != invalid_index && is_its(passing->node);
  return is_known ? passing->node : invalid_index;
}

RayHit MediaAlongRay::exit_of(std::uint32_t object, std::size_t index) {
  if (crossings_.size() <= few) {
    for (; index < crossings_.size(); ++index) {
      if (crossings_[index].object == object && !crossings_[index].entering)
        return crossings_[index];
    }
    return line_->exit_beyond(object);
  }
  sort_passings();
  for (std::size_t i = first_passing(object, index); i < passings_.size(); ++i) {
    if (passings_[i].object != object) break;
    const RayHit& crossing = crossings_[passings_[i].index];
    if (!crossing.entering) return crossing;
  }
  return line_->exit_beyond(object);
}

void MediaAlongRay::enter(const Medium& medium, std::size_t index) {
  leave(medium.object);
  const std::uint32_t node = new_node(medium, index);
  insert_before(first_around(root_, nodes_[node]), node);
}

void MediaAlongRay::leave(std::uint32_t object) {
  const std::uint32_t node = node_of(object);
  if (node == invalid_index) return;
  remove(node);
  nodes_[node].is_there = false;
}

const RayHit& MediaAlongRay::known_exit(Node& node) {
  if (!node.knows_exit) {
    node.exit = exit_of(node.medium.object, node.index);
    node.knows_exit = true;
  }
  return node.exit;
}

bool MediaAlongRay::is_inside_of(Node& inner, Node& outer) {
  if (inner.medium.object > outer.medium.object) return true;
  const RayHit& own = known_exit(inner);
  const RayHit& other = known_exit(outer);
  return own.t < other.t || same_end(own, other);
}

std::uint32_t MediaAlongRay::first_around(std::uint32_t subtree, Node& entering) {
  if (subtree == invalid_index) return invalid_index;
  Node& node = nodes_[subtree];
  const bool may_be =
      entering.medium.object > node.least_object || !entering.knows_exit ||
      std::nextafter(entering.exit.t - 2 * entering.exit.error, -infinity) <= node.farthest;
  if (!may_be) return invalid_index;
  const std::uint32_t inner = first_around(node.left, entering);
  if (inner != invalid_index) return inner;
  const bool knew_exit = node.knows_exit;
  const bool is_around = is_inside_of(entering, node);
  if (node.knows_exit != knew_exit) update_up(subtree);
  return is_around ? subtree : first_around(node.right, entering);
}

// ---- the tree ----

double MediaAlongRay::farthest_of(const Node& node) {
  return node.knows_exit ? std::nextafter(node.exit.t + 2 * node.exit.error, infinity) : infinity;
}

std::uint32_t& MediaAlongRay::link_to(std::uint32_t node) {
  const std::uint32_t above = nodes_[node].above;
  if (above == invalid_index) return root_;
  return nodes_[above].left == node ? nodes_[above].left : nodes_[above].right;
}

void MediaAlongRay::update(std::uint32_t index) {
  Node& node = nodes_[index];
  node.least_object = node.medium.object;
  node.farthest = farthest_of(node);
  for (const std::uint32_t child : {node.left, node.right}) {
    if (child == invalid_index) continue;
    node.least_object = std::min(node.least_object, nodes_[child].least_object);
    node.farthest = std::max(node.farthest, nodes_[child].farthest);
  }
}

void MediaAlongRay::update_up(std::uint32_t node) {
  for (; node != invalid_index; node = nodes_[node].above) update(node);
}

/// Moves a node to where the one above it is, which goes below it.
void MediaAlongRay::lift(std::uint32_t node) {
  const std::uint32_t above = nodes_[node].above;
  link_to(above) = node;
  nodes_[node].above = nodes_[above].above;
  nodes_[above].above = node;
  const bool was_left = nodes_[above].left == node;
  std::uint32_t& down = was_left ? nodes_[node].right : nodes_[node].left;
  (was_left ? nodes_[above].left : nodes_[above].right) = down;
  if (down != invalid_index) nodes_[down].above = above;
  down = above;
  update(above);
  update(node);
}

std::uint32_t MediaAlongRay::new_node(const Medium& medium, std::size_t index) {
  if (node_count_ == nodes_.size()) nodes_.emplace_back();
  Node& node = nodes_[node_count_];
  node.medium = medium;
  node.index = index;
  node.knows_exit = false;
  node.is_there = true;
  node.left = node.right = node.above = invalid_index;
  node.least_object = medium.object;
  node.farthest = infinity;
  return node_count_++;
}

void MediaAlongRay::insert_before(std::uint32_t place, std::uint32_t node) {
  if (!passings_.empty()) {
    Passing* const passing = passing_of(nodes_[node].medium.object);
    if (passing != nullptr) passing->node = node;
  }
  if (place == innermost_) innermost_ = node;
  if (root_ == invalid_index) {
    root_ = node;
    return;
  }
  std::uint32_t above = place == invalid_index ? root_ : place;
  if (place != invalid_index && nodes_[place].left == invalid_index) {
    nodes_[place].left = node;
  } else {
    if (place != invalid_index) above = nodes_[place].left;
    while (nodes_[above].right != invalid_index) above = nodes_[above].right;
    nodes_[above].right = node;
  }
  nodes_[node].above = above;
  update_up(node);
  while (nodes_[node].above != invalid_index && priority(nodes_[node].above) < priority(node))
    lift(node);
}

void MediaAlongRay::remove(std::uint32_t node) {
  if (node == root_ && nodes_[node].left == invalid_index && nodes_[node].right == invalid_index) {
    root_ = innermost_ = invalid_index;  // the usual case
    return;
  }
  if (node == innermost_) {
    if (nodes_[node].right != invalid_index) {
      for (innermost_ = nodes_[node].right; nodes_[innermost_].left != invalid_index;) {
        innermost_ = nodes_[innermost_].left;
      }
    } else {
      innermost_ = nodes_[node].above;
    }
  }
  while (nodes_[node].left != invalid_index || nodes_[node].right != invalid_index) {
    const std::uint32_t left = nodes_[node].left;
    const std::uint32_t right = nodes_[node].right;
    const bool takes_left =
        right == invalid_index || (left != invalid_index && priority(left) > priority(right));
    lift(takes_left ? left : right);
  }
  const std::uint32_t above = nodes_[node].above;
  link_to(node) = invalid_index;
  update_up(above);
}

}  // namespace crt::core
