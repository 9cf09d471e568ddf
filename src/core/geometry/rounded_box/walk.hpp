// A line walks past the inner box of a rounded box, of which each point is farther from that box
// than the radius or not. Both tiers ask it where the line enters and leaves.
//
// Beside the inner box the distance from it is that from a face, from an edge or from a corner. It
// is the one or the other as each coordinate is below the box, within or above. So the six planes
// of the inner box cut the line into steps. In a step the square of the distance is a polynomial of
// degree 2 in t at most, and along the whole line it is convex. Its values at the ends of steps say
// in which it falls below the square of the radius, and in which it grows beyond. Both may also be
// in one step, between the ends.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/geometry/near_line.hpp"
#include "core/geometry/shape.hpp"

namespace crt::core {

/// Sides say along each axis whether a point is below the inner box (-1), within (0) or above (1).
using Sides = std::array<int, 3>;

inline constexpr std::uint32_t flat_faces_of_box = 6;

/// Returns the face that is there, as rounded_box.hpp numbers them. Not all sides may be 0.
std::uint32_t face_at(const Sides& sides);
Sides sides_of(std::uint32_t face);

/// A RoundedBoxLayout is where a rounded box is, with lengths in `unit`, relative to `center`.
struct RoundedBoxLayout {
  explicit RoundedBoxLayout(const RoundedBox& box);

  /// Returns the offset of a coordinate from the inner box, or 0 for a side of 0.
  double beyond(const Sides& sides, int axis, double coordinate) const {
    const int side = sides[static_cast<std::size_t>(axis)];
    if (side == 0) return 0;
    return coordinate - (side < 0 ? inner_lower : inner_upper)[axis];
  }
  Vec3 beyond(const Sides& sides, const Vec3& p) const {
    return {beyond(sides, 0, p.x), beyond(sides, 1, p.y), beyond(sides, 2, p.z)};
  }
  /// Returns it with all that is outside moved outwards.
  RoundedBoxLayout grown(double by) const;

  Vec3 center{0, 0, 0};
  double unit = 1;  ///< a power of two near half of the longest side
  Vec3 lower{0, 0, 0};
  Vec3 upper{0, 0, 0};
  Vec3 inner_lower{0, 0, 0};
  Vec3 inner_upper{0, 0, 0};
  double radius = 0;
  double size = 0;  ///< the radius of a ball about the center that holds it
};

/// A WalkStep is a piece of the line between two planes of the inner box that follow one another.
struct WalkStep {
  Sides sides{};
  double from = 0;  ///< x there, in units of the NearLine
  double to = 0;
};

/// A Walk has the steps in which a line enters a rounded box and leaves it.
struct Walk {
  bool found = false;
  WalkStep enter;
  WalkStep leave;
};
Walk walk_through(const RoundedBoxLayout& box, const NearLine& line);

/// A WayOut is the step in which a line leaves that starts on the surface and goes in.
struct WayOut {
  WalkStep leave;
  bool is_first = false;  ///< it is the step that begins at the start
};
/// Finds the way out of a line whose `point` is the start, whatever rounding has made of that: the
/// surface is taken to be at its distance from the inner box.
WayOut way_out(const RoundedBoxLayout& box, const NearLine& line);

/// Returns the crossing of a step's round face, by the standard tier.
Crossing round_crossing(const RoundedBoxLayout& box, const ObjectRay& ray, const NearLine& line,
                        const WalkStep& step, bool entering);

/// Returns the standard tier's bound on the error of t next to a point of the line, in its units.
/// `turning` is the length of the part of the direction along which the surface may be curved, or 0
/// if that is not known.
double error_next_to(const RoundedBoxLayout& box, const NearLine& line, const Vec3& point, double t,
                     double approach, double turning);

}  // namespace crt::core
