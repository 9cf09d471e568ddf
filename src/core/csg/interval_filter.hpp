// Where a ray first comes into a small CSG object, or out of it, by plain formulas: what most rays
// ask, for a fraction of what following all crossings costs.
//
// Of each leaf it is told where a line enters and leaves it, each end as an interval that surely
// holds it. A leaf is surely inside or outside between these intervals and unknown within them.
// Where the root has one value at first, the first place where it may have the other is found by
// advances: from a place t a leaf that surely does not have the value wanted goes on to where that
// ends, a node that has it if all of its children do goes on to the last of what they say, and one
// that has it if any does to the first. Where there is no such place the ray misses. Else the place
// is the end of one leaf; and if, all along the interval of that end, all other leaves are certain
// and the root hangs on that one, it is there that the root changes, and there is but one crossing
// to be found exactly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/ray/filter_line.hpp"

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
  const auto i = static_cast<int>(lane);
  return {.none = changes.none[i] != 0,
          .one = changes.one[i] != 0,
          .into_object = changes.into_object[i] != 0,
          .into_leaf = changes.into_leaf[i] != 0,
          .leaf = changes.leaf[i],
          .from = changes.from[i],
          .to = changes.to[i]};
}

/// Of programs with few leaves, which all are spheres or boxes that are not turned.
class IntervalFilter {
 public:
  struct Sphere {
    Vec3 center;
    double radius;
  };
  struct Box {
    Vec3 lower;
    Vec3 upper;
  };

  /// None, for other programs.
  IntervalFilter() = default;
  /// `leaves` are those of the program.
  IntervalFilter(const CsgProgram& program, std::span<const Leaf> leaves,
                 std::span<const FaceSurface> faces);

  bool empty() const { return nodes_.empty(); }
  /// Of memory, beside the object itself.
  std::size_t bytes() const;

  /// What counts are crossings with t_min < t <= limit, by what CsgEvaluation says of the ray.
  /// `leaves` are those of the program.
  template <class Real>
  BoundaryChanges<Real> first_changes(const IntervalFilterRays<Real>& rays,
                                      std::span<const Leaf> leaves,
                                      std::span<const FaceSurface> faces) const;

  /// A leaf in the world, by its number within the object; none if it is of the other kind.
  const Sphere* sphere(std::uint32_t leaf) const;
  const Box* box(std::uint32_t leaf) const;

 private:
  static constexpr std::size_t most_places = 32;
  /// A bit for each place. Spheres have the first places, and boxes those after them.
  using Places = std::uint32_t;
  static constexpr std::uint32_t bit_of(std::size_t index) { return std::uint32_t{1} << index; }

  struct Node {
    bool all = false;         ///< true if all of its children are; else if any is
    Places leaves = 0;        ///< that are its children
    std::uint32_t nodes = 0;  ///< likewise, a bit each
  };

  template <class Real>
  class Ends;
  template <class Real>
  struct Values;

  bool place_leaves(std::span<const Leaf> leaves);
  void put(std::uint32_t index, const Leaf& leaf, std::size_t place);
  void place_nodes(const CsgProgram& program);

  template <class Real>
  bool set_start(const StartPoint& start, std::size_t lane, std::span<const Leaf> leaves,
                 std::span<const FaceSurface> faces, Ends<Real>& ends) const;
  template <class Real>
  bool goes_into(std::size_t place, std::uint32_t face, std::size_t lane,
                 const Ends<Real>& ends) const;
  template <class Real>
  void advance(const Ends<Real>& ends, bool value, Real from, MaskOf<Real> going,
               BoundaryChanges<Real>& changes) const;
  template <class Real>
  void set_change(const Ends<Real>& ends, bool value, const Real& from, MaskOf<Real> rays,
                  BoundaryChanges<Real>& changes) const;
  template <class Real>
  Real possible_from(const Ends<Real>& ends, std::uint32_t node_index, Real t, bool value) const;
  template <class Real>
  MaskOf<Real> depends_on(std::size_t place, const Ends<Real>& ends, const Real& from,
                          const Real& to) const;
  template <class Real>
  MaskOf<Real> holds(const Values<Real>& values, std::uint32_t node_index) const;
  /// The leaves whose being outside makes for a value of the root, if others' being inside does.
  Places turned_for(bool value) const { return value ? complemented_ : ~complemented_; }

  std::vector<Sphere> spheres_;
  std::vector<Box> boxes_;
  std::vector<Node> nodes_;  ///< 0 is the root
  std::array<std::uint8_t, most_places> leaf_at_{};
  std::array<std::uint8_t, most_places> place_of_{};  ///< of a leaf
  Places used_ = 0;
  Places complemented_ = 0;
  std::uint32_t first_leaf_ = 0;  ///< in the scene
  std::uint32_t first_face_ = 0;
  std::uint32_t end_face_ = 0;
  bool shares_surfaces_ = false;  ///< with what was written before
};

}  // namespace crt::core
