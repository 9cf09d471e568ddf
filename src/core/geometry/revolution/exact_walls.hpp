// Which walls of a revolution a line crosses, and in what order, is decided without rounding here.
// It is asked only where a bound on rounding leaves it open (turned_walls.hpp).
//
// In the half-plane of the profile a line is a curve: at the height y it is at the distance sqrt q
// from the axis. A line exactly through the circle that a corner makes, or along a wall, is two
// lines: q is a little more for one and a little less for the other. A line across the axis has one
// height all along. It is two lines, too, a little higher and a little lower. Either line passes no
// corner, so that it crosses an even number of walls. A line is inside where both are.
//
// A straight piece is crossed where g = dy^2 q - (dy x(y))^2 changes its sign, between its corners.
// How often that is follows from the signs of g at the corners, which neighbours share, and from
// where g is lowest. Where only one of both lines crosses a piece, that is at a corner, whose place
// and order need no root. An arc bounds the part of a disc beyond the straight line through its
// corners. Whether a line is in it is asked of points between all roots of both equations.
#pragma once

#include <vector>

#include "core/geometry/exact_quadratic.hpp"
#include "core/geometry/exact_ray.hpp"
#include "core/geometry/profile/plane_line.hpp"
#include "core/math/real_root.hpp"

namespace crt::core {

/// A PassedCorner is where a line passes exactly through a corner. `order` is the corner's height,
/// or its distance from the axis if the line is level: with the sign that makes it ascend with t.
struct PassedCorner {
  bool is_known = false;
  double order = 0;
};

/// An ExactWall is a crossing of the line with a wall.
struct ExactWall {
  DoubleDouble t{};  ///< to about 100 bits
  std::uint32_t wall = 0;
  std::uint8_t root = 0;  ///< as in Crossing
  ShiftMask shifts = 0;   ///< the lines that cross it
  bool along_normal = false;
  PassedCorner corner{};
};

class ExactWalls {
 public:
  ExactWalls(const Profile& profile, const ExactLine& line);

  /// Appends the crossings with a piece of the profile and its arc.
  void meet(std::uint32_t number, std::vector<ExactWall>& walls) const;

 private:
  /// A PieceCut says where the line crosses a straight piece.
  struct PieceCut {
    ExactQuadratic equation;            ///< its roots are the places
    std::array<ShiftMask, 2> shifts{};  ///< by the number of the root
    std::array<bool, 2> along_normal{};
    const Vec3* apex = nullptr;  ///< where a line along a cone crosses the piece, if anywhere
  };
  /// A Segment is what of an arc's disc is beyond the line through its corners.
  struct Segment;

  /// Returns the lines that are farther from the axis than a corner, or below it if they have one
  /// height.
  ShiftMask beyond(const Vec3& corner) const;
  /// Returns the distance from the axis that the line of a piece has at the heights of the line. It
  /// is times the piece's height, and as a polynomial.
  std::array<Dyadic, 2> radius_times_height(const Profile::Piece& piece) const;
  PieceCut cut(const Profile::Piece& piece) const;
  PieceCut level_cut(const Profile::Piece& piece) const;
  /// Returns the corner of a piece where the line, and not both of its neighbours, crosses it.
  const Vec3& crossed_corner(const Profile::Piece& piece, const PieceCut& cut,
                             std::size_t root) const;
  /// Returns the roots of a cut's equation. Those at corners have equations of degree 1, if the
  /// line is not level.
  std::vector<RealRoot> roots_of(const Profile::Piece& piece, const PieceCut& cut) const;
  /// Says where the line is at a corner that it passes.
  void place_at(const Vec3& corner, std::size_t root, ExactWall& wall) const;
  /// Returns the sign of g' where the line is at the height of a corner.
  int slope_at(const ExactQuadratic& g, const Vec3& corner) const;
  void meet_piece(std::uint32_t number, std::vector<ExactWall>& walls) const;
  void meet_arc(const Profile::Arc& arc, std::vector<ExactWall>& walls) const;

  const Profile& profile_;
  /// All t here are less by this, so that they are small and differ plainly.
  double shift_;
  Dyadic weight_;
  DyadicVector origin_;
  DyadicVector direction_;
  Dyadic height_;     ///< y at t = 0, times the weight
  Dyadic climb_;      ///< and what t adds to it
  ExactQuadratic q_;  ///< times the square of the weight
};

}  // namespace crt::core
