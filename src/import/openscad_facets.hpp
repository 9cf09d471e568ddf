// The facets that OpenSCAD makes of what is round, by its documented rules and those that its
// meshes follow.
#pragma once

#include "import/csg_tree.hpp"
#include "import/region.hpp"
#include "import/solid.hpp"

namespace crt::importing {

/// A Resolution is $fn, $fa and $fs.
struct Resolution {
  double fn = 0;
  double fa = 12;
  double fs = 2;
};
Resolution resolution_of(const CsgNode& node);

/// A $fn up to this says that something with so many sides is meant, and nothing round.
inline constexpr double most_meant_sides = 8;
/// What would have more pieces than this is refused.
inline constexpr int most_fragments = 100000;

/// One solid has at most so many facets.
inline constexpr std::size_t most_facets = 200000;

/// Returns how many pieces a full circle has.
int fragments_of(double radius, const Resolution& resolution);

/// Returns a sphere as rings of facets.
Faces sphere_facets(double radius, int fragments);
/// Returns a cone or cylinder along z, where one radius may be 0.
Faces frustum_facets(double z1, double r1, double z2, double r2, int fragments);

/// A Twist says how a profile is drawn out along z.
struct Twist {
  double height = 0;
  double degrees = 0;  ///< by which the upper end is turned clockwise
  double scale_x = 1;
  double scale_y = 1;
  int slices = 1;

  bool is_none() const { return degrees == 0 && scale_x == 1 && scale_y == 1; }
};
/// Returns the slices of a node that does not say how many there are.
int slices_of(const Region& region, const Twist& twist, const Resolution& resolution);
/// Returns what is drawn out of one contour without arcs. `is_hole` has the sides divided as those
/// of a hole.
Faces twisted_facets(const Contour& contour, const Twist& twist, bool is_hole);

/// Returns what a contour without arcs passes as it turns about z: x is the distance from the axis,
/// and y the height. It is closed for 360 degrees.
Faces revolved_facets(const Contour& contour, double degrees, int fragments);

}  // namespace crt::importing
