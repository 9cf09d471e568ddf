// Space is divided into cells, boxes along the axes, of which each is full, empty, or crossed by
// faces of a solid. This is what all questions about a whole solid stand on: how much it is, where
// it is, how far away.
//
// Faces that coincide are known by the identity of their surface. So coincidence is decided at
// once, and not by ever smaller cells.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/compile/compile.hpp"
#include "core/measure/open_program.hpp"

namespace crt::core {

/// A Cell is a box of the world, with what is open of the solid's program in it.
struct Cell {
  Bounds box;
  std::shared_ptr<const OpenProgram> program;
};

/// A CellFrame has the middle of a cell and half of its size. |x - middle| <= half holds anywhere
/// in it.
struct CellFrame {
  Vec3 middle{0, 0, 0};
  Vec3 half{0, 0, 0};

  explicit CellFrame(const Bounds& box);
};

/// A CellFace is what a surface is in a cell that it may cross: |F - (value + slope . x)| <= error,
/// where F is its function (face_functions.hpp) and x goes from -1 to 1 across the cell.
struct CellFace {
  std::uint32_t leaf = 0;  ///< within the object: the first whose face it is
  std::uint32_t face = 0;
  std::uint64_t surface = 0;  ///< its number, or one that no other leaf has
  bool flipped = false;
  bool is_surface = true;  ///< or its function only says where others count
  double value = 0;
  Vec3 slope{0, 0, 0};
  double error = 0;
  std::array<Interval, 3> slopes{};  ///< all derivatives of F in the cell, in the world
};

/// A CellLook is what is known of a cell.
struct CellLook {
  enum class Kind : std::uint8_t {
    empty,
    full,
    crossed,  ///< by `faces`, and `inside` says which of their sides are solid
    unknown,  ///< by some of which nothing is known, or too many
  };
  static constexpr std::size_t max_faces = 5;

  Kind kind = Kind::unknown;
  std::vector<CellFace> faces;
  /// Bit m is set if the solid is where exactly the functions of those faces are below 0 whose bits
  /// are set in m.
  std::uint32_t inside = 0;
  std::shared_ptr<const OpenProgram> program;  ///< what is open, for parts of the cell
  /// No line crosses faces in the cell more often.
  double max_crossings = 0;

  /// Returns whether parts of the cell may differ.
  bool is_open() const { return kind == Kind::crossed || kind == Kind::unknown; }
  bool is_inside(std::uint32_t negative) const { return ((inside >> negative) & 1U) != 0; }
};

/// A CellSolid is an object of a compiled scene as cells see it.
class CellSolid {
 public:
  /// The scene must outlive it.
  CellSolid(const CompiledScene& scene, const SceneObject& object);

  /// Lets faces be one in a cell where only rounding tells them apart. Then a gap between parts
  /// that were meant to touch is no part of the surface.
  void unite_near_faces() { has_united_ = std::make_unique<std::atomic<bool>>(false); }
  /// Returns whether there was such a gap in a cell that was looked at.
  bool has_united_faces() const { return has_united_ != nullptr && *has_united_; }

  const Bounds& bounds() const { return bounds_; }
  /// Returns a cell of which nothing is known.
  Cell cell(const Bounds& box) const { return {box, program_}; }
  CellLook look(const Cell& cell) const;
  /// Returns the look of a crossed cell for a part of it, with the same faces, which is quicker
  /// than to look again.
  CellLook look_at_part(const CellLook& look, const Bounds& part) const;
  /// Returns whether all its leaves have face functions. What others have in a box is unknown.
  bool has_all_functions() const;

  /// Returns the triangles that the solid is made of, if it is (Shape::own_triangles()), in the
  /// world.
  std::vector<Triangle> own_triangles() const;

  const FaceFunctions& functions(std::uint32_t leaf) const { return *leaves_[leaf].functions; }
  const Placement& placement(std::uint32_t leaf) const { return *leaves_[leaf].placement; }
  /// Returns the function of a face at a place of the world, with slopes there.
  template <class Number>
  Number value(const CellFace& face, const std::array<Number, 3>& place) const {
    const Number value =
        functions(face.leaf).value(face.face, placement(face.leaf).to_object(place));
    return value;
  }

 private:
  struct CellLeaf {
    const Leaf* leaf = nullptr;
    const Placement* placement = nullptr;
    std::unique_ptr<const Placement> own_placement;  ///< of a leaf of an instance
    std::unique_ptr<const FaceFunctions> functions;
  };
  struct Workspace;

  /// UnitedFaces are two surfaces that are one in a cell.
  struct UnitedFaces {
    std::uint64_t one;
    std::uint64_t other;
  };

  /// Looks at a cell, and unites near faces if those are asked for.
  CellLook look(const Cell& cell, std::vector<UnitedFaces>* united) const;
  /// Returns whether faces are so near to each other in a cell that rounding may be all between.
  bool are_near(const CellFace& one, const CellFace& other, const Bounds& box) const;
  LeafValue look_at(const CellLeaf& leaf, const Cell& cell, const CellFrame& frame,
                    Workspace& work) const;

  std::span<const FaceSurface> surfaces_;
  std::vector<CellLeaf> leaves_;
  std::shared_ptr<const OpenProgram> program_;
  Bounds bounds_;
  std::unique_ptr<std::atomic<bool>> has_united_;
};

/// Returns the coordinates of a cell as intervals.
std::array<Interval, 3> intervals_of(const Bounds& box);
/// Returns them as jets, with slopes in the world.
std::array<Jet, 3> jets_of(const std::array<Interval, 3>& place);
/// Returns a function's range in a box from its value at the middle, its range and its slopes.
Interval narrowed(const Interval& at_middle, const Jet& in_box, const Vec3& half);

}  // namespace crt::core
