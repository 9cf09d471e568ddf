// A profile is a region of the plane of x and y, and what extrusions need to know of it as a whole.
//
// Its pieces are the straight lines between corners. They make polygons, of which the even-odd rule
// says what is inside. An arc's piece is its chord, and the arc adds a segment: what of its disc
// lies on one side of the line through its corners. The region is the exclusive or of the polygons
// and the segments. So the boundary is closed whatever the rounding of circles. Where a circle
// passes exactly through the corners, the chord is in both, and is no boundary.
// Tests: tests/geometry/profile_test.cpp
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/invalid_index.hpp"
#include "core/geometry/bounds.hpp"
#include "core/geometry/bvh.hpp"
#include "crt/primitives.hpp"

namespace crt {

namespace core {

/// ContourCorners are the numbers of a contour's corners without those that repeat the one before.
struct ContourCorners {
  std::vector<std::size_t> kept;
  std::size_t closing = 0;  ///< the corner with the bulge of the piece back to the first
};

ContourCorners corners_of(const Contour& contour);

}  // namespace core

class Profile {
 public:
  explicit Profile(std::span<const Contour> contours);

  /// A Piece leads straight from one corner to the next. All points of a profile have z = 0.
  struct Piece {
    Vec3 from;
    Vec3 to;
    std::uint32_t arc = core::invalid_index;  ///< the arc whose chord it is
    std::uint32_t first = 0;                  ///< the first piece on the same straight line
    bool turned = false;                      ///< whether that one has the opposite direction
    double share_from = 0;                    ///< of the contour's length before the piece
    double share_to = 1;                      ///< and at its end
  };

  struct Arc {
    std::uint32_t piece = 0;  ///< its chord
    std::uint32_t first = 0;  ///< the first arc on the same circle
    Vec3 center{0, 0, 0};
    double radius = 0;
    bool is_right = false;  ///< the segment is to the right of the chord's direction
    /// The circle meets the chord's line within this share of its length from the corners.
    double margin = 0;
    core::Bounds bounds{};  ///< around all that rounding may make of it
  };

  /// A Wall is what a piece or an arc bounds the region by. First come the pieces, each of them its
  /// arc where it has one, and then the chords of the arcs.
  struct Wall {
    std::uint32_t piece = 0;
    std::uint32_t arc = core::invalid_index;  ///< none for a straight wall
  };
  std::uint32_t wall_count() const {
    return static_cast<std::uint32_t>(pieces_.size() + arcs_.size());
  }
  Wall wall(std::uint32_t number) const {
    if (number >= pieces_.size()) return {.piece = arcs_[number - pieces_.size()].piece};
    return {.piece = number, .arc = pieces_[number].arc};
  }
  std::uint32_t chord_of(std::uint32_t arc) const {
    return static_cast<std::uint32_t>(pieces_.size()) + arc;
  }

  /// Returns what it was made of.
  const std::vector<Contour>& contours() const { return contours_; }
  std::span<const Piece> pieces() const { return pieces_; }
  std::span<const Arc> arcs() const { return arcs_; }
  const core::Bounds& bounds() const { return bounds_; }
  /// Returns a box around a piece with its arc.
  core::Bounds bounds_of(std::uint32_t piece) const;
  /// Returns a tree over the pieces with their arcs. Each leaf has some that follow one another in
  /// its order().
  const core::Bvh& tree() const { return tree_; }
  std::size_t bytes() const;

 private:
  void add(const Contour& contour, std::size_t number);
  void find_lines();
  void find_circles();
  void build_tree();

  std::vector<Contour> contours_;
  std::vector<Piece> pieces_;
  std::vector<Arc> arcs_;
  core::Bounds bounds_;
  core::Bvh tree_;
};

}  // namespace crt
