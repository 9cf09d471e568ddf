// Where a ray first comes into a small CSG object, or out of it, by plain formulas: what most rays ask, for a
// fraction of what following all crossings costs.
//
// Of each leaf it is told where a line enters and leaves it, each end as an interval that surely holds it. A
// leaf is surely inside or outside between these intervals and unknown within them. Where the root has one
// value at first, the first place where it may have the other is found by leaps: from a place t a leaf that
// surely does not have the value wanted goes on to where that ends, a node that has it if all of its children
// do goes on to the last of what they say, and one that has it if any does to the first. Where there is no
// such place the ray misses. Else the place is the end of one leaf; and if, all along the interval of that
// end, all other leaves are certain and the root hangs on that one, it is there that the root changes, and
// there is but one crossing to be found exactly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/lanes.hpp"

namespace crt::core {

struct CsgProgram;
struct FaceSurface;
struct Leaf;
struct StartPoint;
struct WorldRay;

/// What a sketch says of a ray.
struct SketchedChange {
  enum class Kind : std::uint8_t {
    open,  ///< nothing is sure
    none,  ///< no crossing of the object's boundary counts
    one    ///< the first that counts is of `leaf` alone, somewhere from `from` to `to`
  };

  Kind kind = Kind::open;
  bool into_object = false;
  bool into_leaf = false;  ///< its primitive, whether or not it is complemented
  std::uint32_t leaf = 0;  ///< within the object
  double from = 0;
  double to = 0;
};

/// Of programs with few leaves, which all are spheres or boxes that are not turned.
class CsgSketch {
 public:
  /// None, for other programs.
  CsgSketch() = default;
  /// `leaves` are those of the program.
  CsgSketch(const CsgProgram& program, std::span<const Leaf> leaves, std::span<const FaceSurface> faces);

  bool empty() const { return nodes_.empty(); }
  /// Of memory, beside the object itself.
  std::size_t bytes() const;

  /// What counts are crossings with t_min < t <= limit, by what CsgEvaluation says of the ray. `leaves` are
  /// those of the program.
  SketchedChange first_change(const WorldRay& ray, double limit, std::span<const Leaf> leaves,
                              std::span<const FaceSurface> faces) const;

 private:
  static constexpr std::size_t most_places = 32;
  /// A bit for each place. Places are numbered through all groups of spheres and then those of boxes; those
  /// at the end of a group may be of no leaf.
  using Places = std::uint32_t;
  static constexpr std::uint32_t bit_of(std::size_t index) { return std::uint32_t{1} << index; }
  static constexpr Places places_of(std::size_t group) {
    return (bit_of(lane_count) - 1) << (group * lane_count);
  }

  /// As many as there are lanes, in the world.
  struct Spheres {
    std::array<Lanes, 3> center;
    Lanes radius;

    /// Puts it into this lane and those after it, so that none holds nonsense. False if the leaf is no
    /// sphere, or not where doubles tell exactly.
    bool set_from(std::size_t first_lane, const Leaf& leaf);
  };
  struct Boxes {
    std::array<Lanes, 3> lower;
    std::array<Lanes, 3> upper;

    bool set_from(std::size_t first_lane, const Leaf& leaf);
  };
  struct Node {
    bool all = false;         ///< true if all of its children are; else if any is
    Places leaves = 0;        ///< that are its children
    std::uint32_t nodes = 0;  ///< likewise, a bit each
  };

  class Line;
  class Ends;

  bool place_leaves(std::span<const Leaf> leaves);
  void put(std::uint32_t index, const Leaf& leaf, std::size_t place);
  void place_nodes(const CsgProgram& program);

  bool set_start(const StartPoint& start, const Line& line, std::span<const Leaf> leaves,
                 std::span<const FaceSurface> faces, Ends& ends) const;
  bool goes_into(std::size_t place, std::uint32_t face, const Line& line, const Ends& ends) const;
  SketchedChange change_at(double from, bool value, const Line& line, const Ends& ends) const;
  double possible_from(const Ends& ends, std::uint32_t node_index, double t, bool value) const;
  bool holds(Places values, std::uint32_t node_index) const;
  bool hangs_on(std::size_t place, const Ends& ends, double from, double to) const;
  /// The leaves whose being outside makes for a value of the root, if others' being inside does.
  Places turned_for(bool value) const { return value ? complemented_ : ~complemented_; }

  std::vector<Spheres> spheres_;
  std::vector<Boxes> boxes_;
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
