// A PointOracle says whether points are in a tree of solids, in arithmetic of any precision.
#pragma once

#include <vector>

#include "crt/measure.hpp"
#include "oracle/solid_tree.hpp"

namespace crt::truth {

using test::SolidTree;

class PointOracle {
 public:
  /// The tree must outlive it, and have leaves of tests/oracle alone.
  explicit PointOracle(const SolidTree& tree) : tree_(tree) {}

  /// Returns where a point is. If it is exactly on the surface of a leaf, it is on the surface of
  /// the tree if some points infinitely near it are inside, and others are not.
  PointSide side(const Vec3& point) const;
  /// Returns whether it is inside as seen from a point infinitely near, in that direction.
  bool is_inside(const Vec3& point, const Vec3& direction) const;
  /// Returns whether a side is that of any of the points that are so far away.
  bool is_near(const Vec3& point, PointSide side, double distance) const;

 private:
  const SolidTree& tree_;
};

}  // namespace crt::truth
