// These functions make random trees of solids most of whose faces coincide, and rays that meet them
// where it is hardest. All numbers of the trees are small and dyadic, so that faces which coincide
// on paper coincide in doubles.
#pragma once

#include <vector>

#include "crt/entity.hpp"
#include "oracle/line_oracle.hpp"
#include "oracle/ray_maker.hpp"

namespace crt::test {

struct SolidTree {
  enum class Kind { leaf, set_union, intersection, difference };

  Kind kind = Kind::leaf;
  Primitive primitive = Sphere{};
  Transform own{};       ///< of this part, within what moves the whole
  Transform to_world{};  ///< all of them
  std::vector<SolidTree> parts;

  Entity entity() const;
};

SolidTree random_tree(std::uint64_t number);

/// A GridRay is a line through corners, edges and faces of the grid, more often than not.
struct GridRay {
  Vec3 origin;
  Vec3 direction;
};
GridRay random_ray(std::uint64_t tree, std::uint64_t number);

/// A TreeOracle finds what a line sees of a tree, by exact roots.
class TreeOracle {
 public:
  explicit TreeOracle(const SolidTree& tree);

  struct Flip {
    Ball<4> t;
    bool entering = false;
  };
  struct Flips {
    bool inside_before = false;
    std::vector<Flip> flips;
  };
  Flips flips(const GridRay& ray) const;

  /// Returns whether the point at t is inside (1) or outside (-1) of the tree, even if every leaf
  /// that it is next to, within the bounds of the standard tier, were otherwise. Else it returns 0.
  int certain_side(const GridRay& ray, double t) const;

  /// Return the number of all faces, and of those which lie on a surface that another solid has
  /// too.
  int faces() const { return faces_; }
  int coincident_faces() const { return coincident_faces_; }

 private:
  void collect(const SolidTree& tree);
  void find_coincident();

  /// An Equation is that of a surface that several equations may stand for.
  struct Equation {
    std::size_t surface = 0;
    int orientation = 1;  ///< the sign of the factor to the surface's own equation
  };
  struct Surface {
    std::size_t leaf = 0;
    std::size_t equation = 0;  ///< of the leaf
  };

  const SolidTree& tree_;
  std::vector<const SolidTree*> leaves_;
  std::vector<std::vector<Equation>> equations_;  ///< by leaf
  std::vector<Surface> surfaces_;
  int faces_ = 0;
  int coincident_faces_ = 0;
};

}  // namespace crt::test
