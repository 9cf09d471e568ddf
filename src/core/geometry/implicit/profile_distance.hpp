// The distance of points from the boundary of a profile, below 0 inside, as a field has it: over a
// box of the plane, as intervals that surely hold it and its slopes.
//
// Next to one piece the gradient is the piece's normal, out of the region. At a corner it is
// between the normals on both sides. So the pieces that may be the nearest one for some point of
// the box, with their corners, bound it.
// Tests: tests/geometry/profile_distance_test.cpp
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/geometry/plane_piece.hpp"
#include "core/math/interval.hpp"
#include "crt/primitives.hpp"

namespace crt::core {

class ProfileDistance {
 public:
  /// Throws Error (invalid_argument) if contours cross or touch one another or themselves, or have
  /// more than max_pieces pieces.
  explicit ProfileDistance(std::shared_ptr<const Profile> profile);

  static constexpr std::size_t max_pieces = 4096;

  struct Values {
    Interval middle;  ///< for the points in the middle
    Interval all;     ///< for any points of the box
    Interval slope_x;
    Interval slope_y;
  };

  /// Evaluates it for points in the middle of a box, and for all points of that.
  Values evaluate(const std::array<Interval, 2>& middle, const std::array<Interval, 2>& box) const;

  const std::shared_ptr<const Profile>& profile() const { return profile_; }
  std::size_t bytes() const;

 private:
  /// Directions are pairs of intervals.
  struct Directions {
    Interval x;
    Interval y;
  };

  struct Wall {
    PlanePiece piece;  ///< in this one's units
    Vec2 along{1, 0};  ///< of the chord, of length 1
    double length = 0;
    Vec2 center{0, 0};
    double radius = 0;       ///< 0 if it is straight
    bool is_outward = true;  ///< the right side is outside
    Directions normals{};    ///< out of the region
    // This is the corner at its end. It is smooth if there is no difference between the normals.
    bool is_smooth = false;
    Vec2 end_direction{1, 0};
    Vec2 next_direction{1, 0};
    Directions corner_normals{};

    double distance_to(const Vec2& point) const;
  };

  static Directions between(const Vec2& a, const Vec2& b);
  void add_contour(const Contour& contour);
  void finish_contour(std::size_t first, std::size_t end);
  void check_apart() const;
  bool is_inside(const Vec2& point) const;
  Directions slopes_near(const Wall& wall, const Vec2& point, const Vec2& reach) const;

  std::shared_ptr<const Profile> profile_;
  std::vector<Wall> walls_;
  Vec2 origin_{0, 0};
  double unit_ = 1;
  double error_ = 0;  ///< of distances, in units, for points near the profile
};

}  // namespace crt::core
