// Curves become pairs of arcs that go through the curve's ends in its directions: biarcs. A curve
// that leaves its biarc by more than the deviation is halved.
//
// How far it leaves an arc is not sampled but bounded. With the middle m and half the length h of
// the arc's chord, its bulge b, and the height v above the chord,
//   F(p) = (b (|p - m|^2 - h^2) - h (1 - b^2) v) / (h (1 + b^2))
// is 0 on the circle, where its gradient has the length 1, and it is -v for b = 0. For a point of
// the curve it is a polynomial of degree 6, which the coefficients of its Bernstein form bound. So
// does one of degree 5 show that the curve goes about the circle's center in one direction. Then it
// meets every radius of the arc, and both are equally far from each other.
// Source of the biarc: K. M. Bolton, Biarc curves, Computer-Aided Design 7 (1975), with equal
// distances of the inner control points from the ends.
// Tests: tests/contours/curve_test.cpp
#pragma once

#include <vector>

#include "core/contours/cubic.hpp"

namespace crt::core {

/// An ArcTo leads on from where the arc before it ended.
struct ArcTo {
  Vec2 end{0, 0};
  double bulge = 0;
};

/// Returns the bulge of an arc, or 0 if the arc is so flat that doubles may not say its circle.
double bulge_with_circle(double bulge, double chord, double least_rise);

/// Rounding hides what rises less than this share of the coordinates above its chord.
inline constexpr double least_share_of_rise = 0x1p-46;

/// A Fit says how close arcs must be to a curve of a size of about 1.
struct Fit {
  double deviation = 0;
  /// An arc that rises less above its chord becomes straight.
  double least_rise = 0;
};

/// Appends arcs that are as close to the curve as `fit` says.
void append_biarcs(const Cubic& curve, const Fit& fit, std::vector<ArcTo>& arcs);

}  // namespace crt::core
