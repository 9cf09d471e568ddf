// One rule says which crossings of a ray are at one place, within CSG objects and between objects.
//
// A crossing's place is the part of the line about its t that is its *reach* to both sides. Those
// are at one place that have a part in common. The reach is
//
//  - what the crossing's error leaves open, but
//  - at least what makes two surfaces one that lie a few roundings apart, measured across them: as
//    much as different expressions for one place in a script differ by, and
//  - at most a small share of the primitive. A surface that is all but parallel to the ray has an
//    error as long as the solid, which says nothing of what else is there. Then t decides.
//
// In the exact tier the reach is the error alone: there a gap is a gap (exact_order.hpp).
// Tests: tests/csg/one_place_test.cpp, tests/csg/along_surfaces_test.cpp
#pragma once

#include <algorithm>
#include <cmath>

#include "core/csg/program.hpp"
#include "core/math/vector.hpp"
#include "core/ray/coincidence_tolerance.hpp"

namespace crt::core {

/// Returns the reach of the place of a crossing with a leaf. It takes the normal there, so it is
/// only asked for where another crossing is near.
double reach_of_place(const PlacedLeaf& leaf, const WorldRay& ray, const Crossing& crossing);

/// Returns the reach of a crossing among others of its own leaf. These are in the right order, and
/// t is rounded for each alone, so that neither counts.
inline double reach_in_leaf(double t, double error, double reach) {
  return std::max(std::min(error, reach) - 2 * rounding_of(t), 0.0);
}

/// Returns how far the second of two crossings is behind the first.
template <class Hit>
double gap_between(const Hit& first, const Hit& second) {
  return (second.t - first.t) + (second.t_low - first.t_low);
}

/// A CommonPlace is what the places of crossings have in common, relative to the first of them.
class CommonPlace {
 public:
  explicit CommonPlace(double reach) : from_(-reach), to_(reach) {}

  /// Takes a crossing that far behind the first. Returns false if its place has nothing in common.
  bool take(double gap, double reach) {
    const double from = std::max(from_, gap - reach);
    const double to = std::min(to_, gap + reach);
    if (gap != 0 && !(from <= to)) return false;
    from_ = from;
    to_ = to;
    return true;
  }

 private:
  double from_;
  double to_;
};

}  // namespace crt::core
