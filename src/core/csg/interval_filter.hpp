// The interval filter finds where a ray first comes into a CSG object, or out of it, by plain
// formulas. That is what most rays ask, for a fraction of what following all crossings costs.
//
// A line enters and leaves each leaf somewhere in an interval (enclosed_lines.hpp): between these
// the leaf is surely inside or outside, and within them it is unknown. Where the root has one value
// at first, the search advances to the first t at which it may have the other:
//
//  - A leaf that surely does not have the wanted value at t advances to where that ends.
//  - A node that has the value if all of its children do advances to the last of what these say,
//    and one that has it if any child does to the first.
//
// If there is no such t, the ray misses. Else t is where the end of one leaf begins. If all other
// leaves are certain along the interval of that end, and the root depends on that leaf, the root
// changes there, and one crossing is left to be found exactly.
//
// The leaves are gathered from the object's BVH in the order in which lines come to their boxes
// (near_leaves.hpp), as far as the search goes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/box/enclose.hpp"
#include "core/geometry/sphere/enclose.hpp"

namespace crt::core {

struct CsgProgram;
struct FaceSurface;
struct Leaf;
struct StartPoint;

/// Rays as a filter takes them: one, or as many side by side as a Real has lanes.
template <class Real>
struct IntervalFilterRays {
  const FilterLine<Real>& lines;
  Real limits;                         ///< nothing beyond matters
  std::uint32_t asked;                 ///< a bit each
  std::uint32_t on_surface;            ///< those of them that start on a surface
  std::span<const StartPoint> starts;  ///< of these
};

/// What a filter says of each of them.
template <class Real>
struct BoundaryChanges {
  using Mask = MaskOf<Real>;

  Mask none{};  ///< no crossing of the object's boundary counts
  Mask one{};   ///< the first that counts is of `leaf` alone, somewhere from `from` to `to`
  // Where neither is so nothing is sure.

  Mask into_object{};
  Mask into_leaf{};  ///< its primitive, whether or not it is complemented
  Real leaf{};       ///< its number within the object
  Real from{};
  Real to{};
};

inline BoundaryChanges<double> lane_of(const BoundaryChanges<Lanes>& changes, std::size_t lane) {
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

/// The filter of a program whose leaves all are spheres or boxes that are not turned. Deep programs
/// have none.
class IntervalFilter {
 public:
  struct Sphere : EnclosedSphere {
    std::uint32_t leaf = 0;  ///< its number within the object
  };
  struct Box : EnclosedBox {
    std::uint32_t leaf = 0;
  };

  /// Makes one that is empty, as other programs have it.
  IntervalFilter() = default;
  /// `leaves` are those of the program.
  IntervalFilter(const CsgProgram& program, std::span<const Leaf> leaves,
                 std::span<const FaceSurface> faces);

  bool empty() const { return places_.empty(); }
  /// Returns the bytes that it takes beside the object itself.
  std::size_t bytes() const;

  /// Finds the first crossings of the boundary with t_min < t <= limit that count, by what
  /// CsgEvaluation says of the ray. `leaves` are those of `program`, the filter's own.
  template <class Real>
  BoundaryChanges<Real> first_changes(const IntervalFilterRays<Real>& rays,
                                      const CsgProgram& program, std::span<const Leaf> leaves,
                                      std::span<const FaceSurface> faces,
                                      NearLeavesWorkspace& workspace, const RaySteps& steps) const;

  /// Returns a leaf in the world, by its number within the object; null if it is of the other kind.
  const Sphere* sphere(std::uint32_t leaf) const;
  const Box* box(std::uint32_t leaf) const;
  bool is_complemented(std::uint32_t leaf) const { return places_[leaf].complemented; }

  /// Calls use(leaf) for each leaf, as a Sphere or a Box.
  template <class Use>
  void for_each_leaf(const Use& use) const {
    for (const Sphere& sphere : spheres_) use(sphere);
    for (const Box& box : boxes_) use(box);
  }

  /// Encloses the part of lines in a leaf, as EnclosedLines has it.
  template <class Real>
  bool enclose(std::uint32_t leaf, const EnclosedLines<Real>& lines,
               Enclosure<Real>& interval) const;

 private:
  template <class Real>
  class Search;

  /// Where a leaf is among those of its kind.
  struct Place {
    std::uint32_t index = 0;
    bool is_box = false;
    bool complemented = false;
  };

  std::vector<Sphere> spheres_;
  std::vector<Box> boxes_;
  std::vector<Place> places_;     ///< by leaf
  std::uint32_t first_face_ = 0;  ///< in the scene
  std::uint32_t end_face_ = 0;
  bool shares_surfaces_ = false;  ///< with what was written before
};

}  // namespace crt::core
