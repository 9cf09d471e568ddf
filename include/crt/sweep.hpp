// These solids follow a path. They are put together from other primitives, without any facets of
// their own.
#pragma once

#include <crt/entity.hpp>
#include <crt/material.hpp>
#include <crt/primitives.hpp>
#include <crt/vec.hpp>
#include <optional>
#include <vector>

namespace crt {

/// A path has at most so many points, and a Tube at most so many pieces.
inline constexpr std::size_t most_path_points = 4096;

/// A Sweep has all points that a profile passes as it follows a path of straight lines, across
/// which it stays. It turns with the path as little as can be, and so never about the path itself.
///
/// With a `bend` above 0 the path has an arc of that radius at each of its points in between, which
/// it enters and leaves smoothly. There the sweep has parts of tori, cones and planes. With 0 it
/// is mitred: two pieces meet in the plane halfway between their directions. Ends are flat. The
/// pieces meet without a gap and without a wall between them.
///
/// (u, v) are those of the extrusions and revolutions that it consists of. It is an Entity wherever
/// one is needed.
struct Sweep {
  std::shared_ptr<const Profile> profile{};  ///< from make_profile(); its origin is on the path
  /// At least 2 points, or 3 if it is closed, of which those that follow one another are at least
  /// 1e-100 apart. No turn goes straight back (to 0.1 degrees).
  std::vector<Vec3> path{};
  double bend = 0;  ///< the radius of arcs at the points, from 1e-100 to 1e100, or 0 for none
  /// Says where y of the profile points at the first of the path's lines, as far as that is across.
  /// If it is along that line, z takes its place, or x if it is along that, too.
  Vec3 up{0, 1, 0};
  /// Leads back from the last point to the first. What follows a closed path that is not flat may
  /// come back turned about it: that is an error.
  bool closed = false;
  std::optional<SharedMaterial> material{};

  /// Makes the entity. It takes O(n log n) for n pieces of the path times those of the profile.
  /// Throws Error (invalid_argument) naming the field that is out of range, or the point of the
  /// path (they count from 0) at which there is too little room for the profile to turn, and Error
  /// (limit) for more than most_path_points, or more than 2^20 corners of profiles in all bends.
  operator Entity() const;  // NOLINT(google-explicit-constructor): it is one
};

/// A Tube has all points within a radius of a path, and the radius changes along it. Its ends are
/// round. So it is a chain of balls with cones between them that touch these smoothly.
struct Tube {
  /// At least 2 points, or 3 if it is closed, of which those that follow one another are at least
  /// 1e-100 apart.
  std::vector<Vec3> path{};
  /// The radius at each point, from 1e-100 to 1e100, or 0 for a tip. One number is that at all.
  std::vector<double> radii{};
  /// Lets the path be a curve through its points (Catmull, Rom 1974), and radii change as smoothly,
  /// but never beyond those of the two points. Otherwise both are straight between points.
  bool smooth = false;
  bool closed = false;  ///< leads back from the last point to the first
  /// No point of a curve is farther from the straight pieces that take its place, and no radius is
  /// farther off. 0 stands for a 1000th of the largest radius.
  double deviation = 0;
  std::optional<SharedMaterial> material{};

  /// Makes the entity. It takes O(n log n) for n pieces. Throws Error (invalid_argument) naming the
  /// field that is out of range, and Error (limit) for more than most_path_points points or pieces.
  operator Entity() const;  // NOLINT(google-explicit-constructor): it is one
};

}  // namespace crt
