// Questions about solids as such: how much one is, where it is, and what is in it.
//
// Every answer is an interval that surely holds the truth: that of the solid which the numbers of
// the entity describe, by its equations. Space is divided into boxes, and the more of them, the
// narrower the answer. No triangles and no samples are taken.
//
// Answers are the same, to the last bit, for any number of threads and on any machine, unless time
// ends them. All functions are safe from any number of threads at once. They throw Error:
// invalid_argument for an entity that is no solid or has no bounds, and for options out of range;
// limit as prepare() does; cancelled as the options say; out_of_memory.
#pragma once

#include <array>
#include <crt/bounding_box.hpp>
#include <crt/entity.hpp>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace crt {

/// An Interval holds a number: lower <= it <= upper.
struct Interval {
  double lower = 0;
  double upper = 0;

  /// Returns the number in the middle, rounded.
  double middle() const { return 0.5 * lower + 0.5 * upper; }
  /// Returns how far the ends are apart, rounded.
  double width() const { return upper - lower; }
  /// Returns whether a number is in the interval. Its ends are.
  bool contains(double x) const { return lower <= x && x <= upper; }

  friend bool operator==(const Interval&, const Interval&) = default;
};

/// MeasureOptions say how well something is to be known.
struct MeasureOptions {
  /// Answers are found to this width, relative to their size, above 0 and at most 1. Rounding keeps
  /// them from being narrower than about 1e-12.
  double relative_width = 1e-6;
  /// What is known after so many seconds is the answer, if that comes first. It then depends on the
  /// machine. Above 0.
  double seconds = std::numeric_limits<double>::infinity();
  int threads = 0;  ///< as in RenderOptions
  /// This is asked now and then whether to continue, from one thread at a time. Empty: always.
  std::function<bool()> go_on = {};
  /// The calling thread calls this with how much work was done since the last call: how many boxes
  /// were looked at, times the parts that each was compared with (and 4 more for what is in it). It
  /// is the same on any machine. What it throws ends the measuring, and comes out.
  std::function<void(std::uint64_t)> work = {};
};

/// MassProperties are those of a solid of density 1, in scene units.
struct MassProperties {
  Interval volume;
  Interval area;  ///< of the surface
  std::array<Interval, 3> centroid{};
  /// The inertia tensor about the centroid: xx, yy, zz, xy, yz and zx. The last three are the
  /// integrals of -x y, -y z and -z x. Widths are relative to the volume times the square of half
  /// the longest side of the box around the solid, and those of the centroid to that half.
  std::array<Interval, 6> inertia{};
};

/// Returns the density of a solid that its materials say, in kg per cubic metre: 0 if they say
/// none. Of a difference and of an intersection the first part counts alone. Materials of single
/// triangles do not count. Throws Error (invalid_argument) if parts have different densities, of
/// which one may be unknown: where they overlap, nothing says which one it is.
double density(const Entity& entity);

/// Returns the volume of a solid, in cubed scene units. Parts that overlap count once.
Interval volume(const Entity& entity, const MeasureOptions& options = {});

/// Returns the area of a solid's surface, in squared scene units, without what is within the solid.
/// The upper end is infinite while a place of the surface is so narrow that nothing bounds it.
Interval surface_area(const Entity& entity, const MeasureOptions& options = {});

/// Returns the centroid of a solid, each coordinate to a width relative to half of the longest side
/// of the box around it. It takes less long than all mass properties. What is known of a solid
/// without a volume is everything.
std::array<Interval, 3> centroid(const Entity& entity, const MeasureOptions& options = {});

/// Returns all mass properties of a solid. It takes some times as long as the volume alone.
MassProperties mass_properties(const Entity& entity, const MeasureOptions& options = {});

/// Says where a point is.
enum class PointSide : std::int8_t {
  outside = -1,
  on = 0,  ///< on the surface, as far as rounding of its equations lets one know
  inside = 1,
};

/// Finds whether points are in a solid. What coincides is decided by identity: a point where two
/// parts of a union touch is inside. Where surfaces touch without crossing, it may be `on` what is
/// no surface. Of Custom solids it says `inside` or `outside` alone, as rays do. Points must be
/// finite, and `sides` has as many places. It runs on up to `threads` threads (as in
/// RenderOptions).
void contains(const Entity& entity, std::span<const Vec3> points, std::span<PointSide> sides,
              int threads = 0);
/// Does so for one point. For many it is much cheaper to ask at once.
PointSide contains(const Entity& entity, const Vec3& point);

/// Returns a box that holds a solid. Each side is within `relative_width` times half of the longest
/// side of bounding_box() of the smallest one. Sides that are infinite there stay so, and so do all
/// sides of what is infinite along another axis. It is empty (lower > upper) for a solid without
/// points. Surfaces have the box that bounding_box() says. The search for a side ends after 2^16
/// boxes and one for each solid. So solids that merely touch where they are intersected, what is
/// thinner than rounding and what has no equations may have a larger box.
BoundingBox tight_bounding_box(const Entity& entity, const MeasureOptions& options = {});

/// A NearestPoint is where the surface of a solid is nearest to a point.
struct NearestPoint {
  Interval distance;    ///< below 0 for a point in the solid
  Vec3 point{0, 0, 0};  ///< of the surface, as far away as the interval says, to its width

  /// Returns how far away that point is, which is never less than the distance: below 0 in the
  /// solid, and 0 on its surface.
  double signed_distance() const {
    if (distance.upper <= 0) return distance.lower;
    return distance.lower < 0 ? 0 : distance.upper;
  }
};

/// Finds the nearest points of a solid's surface. Distances are found to `relative_width` of
/// themselves, or to 1e-12 of half of the longest side of the box around the solid if that is more.
/// Where surfaces are equally near over a wide range, as between a shaft and its bore, or merely
/// touch, the intervals may stay wider. Points must be finite, and `nearest` has as many places.
/// Throws Error (invalid_argument) for a solid without points, too.
void nearest_points(const Entity& entity, std::span<const Vec3> points,
                    std::span<NearestPoint> nearest, const MeasureOptions& options = {});
/// Does so for one point.
NearestPoint nearest_point(const Entity& entity, const Vec3& point,
                           const MeasureOptions& options = {});

/// A Clearance is how near two solids are.
struct Clearance {
  Interval distance;   ///< 0 if they touch or overlap
  Vec3 on_a{0, 0, 0};  ///< a pair of points so far apart
  Vec3 on_b{0, 0, 0};
  bool overlap = false;  ///< they have inner points in common, such as on_a
};

/// Finds how near two solids are, to a width as nearest_points() has it. That of solids that touch
/// has a lower end of 0, and an upper end that is as small as the width. Throws as that does.
Clearance clearance(const Entity& a, const Entity& b, const MeasureOptions& options = {});

/// An Overlap is what two entities have in common.
struct Overlap {
  std::size_t first = 0;  ///< places in what was given
  std::size_t second = 0;
  Interval volume;
};

/// Finds all pairs of solids that overlap, in order, with how much they have in common. Surfaces
/// without an inside are passed over, and so is what only touches.
std::vector<Overlap> interference(std::span<const Entity> entities,
                                  const MeasureOptions& options = {});

/// A LinePiece is a piece of a line that is in a solid, between two distances along the line.
struct LinePiece {
  Interval from;
  Interval to;
};

/// Finds which pieces of a line are in a solid, in order. Distances are from the origin, in scene
/// units, and below 0 behind it. They are found to rounding. Where parts of a union touch, the
/// piece goes on, by identity. A piece or a gap that is no longer than rounding may be left out.
/// Where the line runs along a surface, or merely touches one, `from` and `to` may hold all of that
/// stretch. Of the options only `go_on` and `work` count. Throws Error (invalid_argument) for an
/// origin that is not finite, and a direction that is not or that is 0.
std::vector<LinePiece> thickness_along(const Entity& entity, const Vec3& origin,
                                       const Vec3& direction, const MeasureOptions& options = {});

/// WallOptions say what a wall is, and how well its thickness is to be known.
struct WallOptions {
  /// The sides of a wall are parallel up to this angle, in degrees from 0 to 45. So what narrows to
  /// an edge is no wall if its sides meet at a larger angle.
  double angle = 5;
  MeasureOptions measure{.relative_width = 1e-2};
};

/// A Wall is where a solid is thinnest.
struct Wall {
  Interval thickness;  ///< infinite at both ends if there is no wall
  Vec3 from{0, 0, 0};  ///< a chord as long as the upper end says, to rounding
  Vec3 to{0, 0, 0};
};

/// Finds the thinnest wall of a solid: the shortest chord in it that is normal to the surface at
/// one end (to a hundred thousandth of a radian, as rounding goes) and within WallOptions::angle of
/// a normal at the other. So a ball is as thick as its diameter, and the edge of a box is no wall.
/// Features smaller than 2^-20 of half of the box's diagonal are not looked at: a face that is
/// narrower, and places as near to a point without a normal, such as the apex of a cone. The chord
/// that is given is surely there. The lower end may be poor, down to 0, where curved walls of one
/// thickness are large, and for Custom solids: the search ends after many thousand pairs of boxes.
Wall least_wall(const Entity& entity, const WallOptions& options = {});

}  // namespace crt
