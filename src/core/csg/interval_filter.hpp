// The interval filter finds where a ray first comes into a CSG object, or out of it, by plain
// formulas. That is what most rays ask, for a fraction of what following all crossings costs.
//
// A line enters and leaves each leaf somewhere in an interval (enclosed_lines.hpp): between these
// the leaf is surely inside or outside, and within them it is unknown. Where the root has one value
// at first, the search advances to the first t at which it may have the other:
//
//  - A leaf that surely does not have the wanted value at t advances to where that ends.
//  - A node that has the value if all of its children do advances to the last of what these say.
//    A node that has it if any child does advances to the first.
//
// If there is no such t, the ray misses. Else t is where the end of one leaf begins. The root
// changes there if all other leaves are certain along the interval of that end, and the root
// depends on that leaf. Then one crossing is left to be found exactly.
//
// The leaves are gathered from the object's BVH in the order in which lines come to their boxes
// (near_leaves.hpp), as far as the search goes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/geometry/placed_solid.hpp"

namespace crt::core {

struct CsgObject;
struct CsgProgram;
struct FaceSurface;
struct Leaf;
struct StartPoint;

/// IntervalFilterRays are rays as a filter takes them: one, or as many side by side as a Real has
/// lanes.
template <class Real>
struct IntervalFilterRays {
  const FilterLine<Real>& lines;
  Real limits;                         ///< nothing beyond matters
  std::uint32_t asked;                 ///< a bit each
  std::uint32_t on_surface;            ///< those of them that start on a surface
  std::span<const StartPoint> starts;  ///< of these
};

/// BoundaryTransitions are what a filter says of each of the rays.
template <class Real>
struct BoundaryTransitions {
  using Mask = MaskOf<Real>;

  Mask none{};  ///< no crossing of the object's boundary counts
  Mask one{};   ///< the first that counts is of `leaf` alone, somewhere from `from` to `to`
  // Where neither is true, nothing is sure.

  Mask into_object{};
  Mask into_leaf{};  ///< its primitive, whether or not it is complemented
  Real leaf{};       ///< its number within the object
  Real from{};
  Real to{};
};

inline BoundaryTransitions<double> lane_of(const BoundaryTransitions<Lanes>& changes,
                                           std::size_t lane) {
  return {.none = changes.none[lane],
          .one = changes.one[lane],
          .into_object = changes.into_object[lane],
          .into_leaf = changes.into_leaf[lane],
          .leaf = changes.leaf[lane],
          .from = changes.from[lane],
          .to = changes.to[lane]};
}

template <class Real>
class EnclosedLines;
class NearLeavesWorkspace;
class RaySteps;

/// An IntervalFilter is the filter of a program. Deep programs have none, and those of which more
/// than an eighth of the leaves are of shapes without a formula for where lines are in them.
class IntervalFilter {
 public:
  /// Makes an empty filter, which is what other programs have.
  IntervalFilter() = default;
  /// Makes the filter of a program, or an empty one. `leaves` are those of the program.
  IntervalFilter(const CsgProgram& program, std::span<const Leaf> leaves);

  bool empty() const { return leaves_.empty(); }
  /// Returns the bytes that it takes beside the object itself.
  std::size_t bytes() const;

  /// Finds the first crossings of the boundary with t_min < t <= limit that count, as CsgEvaluation
  /// finds them. The filter is that of the object's program.
  template <class Real>
  BoundaryTransitions<Real> first_transitions(const IntervalFilterRays<Real>& rays,
                                              const CsgObject& object,
                                              NearLeavesWorkspace& workspace,
                                              const RaySteps& steps) const;

  bool is_complemented(std::uint32_t leaf) const { return leaves_[leaf].complemented; }
  /// Returns what encloses a leaf in the world, by its number within the object.
  const PlacedSolid& solid(std::uint32_t leaf) const { return *leaves_[leaf].solid; }

 private:
  template <class Real>
  class Search;

  struct EnclosedLeaf {
    std::unique_ptr<const PlacedSolid> solid;
    bool complemented = false;
  };

  std::vector<EnclosedLeaf> leaves_;
};

}  // namespace crt::core
