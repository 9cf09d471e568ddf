// The nearest of several places is found from bounds: a place that is surely there is no nearer
// than the nearest that may be there.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/math/vector.hpp"

namespace crt::core {

/// A NearestSearch keeps what is open, the nearest first. An Item has `double least`: nothing in it
/// is nearer.
template <class Item>
class NearestSearch {
 public:
  void add(Item&& item) {
    if (item.least >= best_) return;
    items_.push_back(std::move(item));
    std::push_heap(items_.begin(), items_.end(), farther);
  }
  /// Says how near something surely is. Returns whether that is nearer than all before.
  bool offer(double distance) {
    if (!(distance < best_)) return false;
    best_ = distance;
    return true;
  }
  /// Says that something may be as near, of which no more will be known.
  void leave(double least) { left_ = std::min(left_, least); }

  bool is_done(double width) const { return items_.empty() || best_ - least() <= width; }
  Item next() {
    std::pop_heap(items_.begin(), items_.end(), farther);
    Item item = std::move(items_.back());
    items_.pop_back();
    return item;
  }
  /// Returns bounds on how near the nearest is.
  double least() const {
    const double open = items_.empty() ? infinity : items_.front().least;
    return std::max(0.0, std::min({open, left_, best_}));
  }
  double most() const { return best_; }

 private:
  static bool farther(const Item& a, const Item& b) { return a.least > b.least; }

  std::vector<Item> items_;
  double best_ = infinity;
  double left_ = infinity;
};

/// An OpenPair is a node of each of two trees, or two nodes of one.
struct OpenPair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  double least = 0;
};

/// Returns the vector from a point to the nearest point of a box, which is 0 in it.
inline Vec3 way_to(const Bounds& box, const Vec3& from) {
  Vec3 way(0, 0, 0);
  for (int axis = 0; axis < 3; ++axis) {
    if (from[axis] < box.lower[axis]) way[axis] = box.lower[axis] - from[axis];
    if (from[axis] > box.upper[axis]) way[axis] = box.upper[axis] - from[axis];
  }
  return way;
}
/// Returns the shortest vector from a box to another, which is 0 if they have a common point.
inline Vec3 way_between(const Bounds& from, const Bounds& to) {
  Vec3 way(0, 0, 0);
  for (int axis = 0; axis < 3; ++axis) {
    if (to.lower[axis] > from.upper[axis]) way[axis] = to.lower[axis] - from.upper[axis];
    if (to.upper[axis] < from.lower[axis]) way[axis] = to.upper[axis] - from.lower[axis];
  }
  return way;
}

/// Searches are left after so many cells. Solids that merely touch may leave any number open.
inline constexpr std::size_t most_cells_of_search = std::size_t{1} << 16;

/// Distances are rounded by less than this, relative to the coordinates.
inline constexpr double distance_rounding = 0x1p-48;

}  // namespace crt::core
