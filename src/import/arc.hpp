// Arcs of circles between corners of contours.
#pragma once

#include <cmath>
#include <crt/curves.hpp>
#include <crt/elementary.hpp>
#include <crt/primitives.hpp>
#include <numbers>

namespace crt::importing {

/// An Arc begins at an angle and turns by `sweep`, in radians, below 0 from y to x.
struct Arc {
  double x = 0;
  double y = 0;
  double radius = 0;
  double begin = 0;
  double sweep = 0;

  CurvePoint at_angle(double angle) const {
    return {x + radius * elementary::cos(angle), y + radius * elementary::sin(angle)};
  }
  CurvePoint at(double share) const { return at_angle(begin + share * sweep); }
  bool has_angle(double angle) const {
    const double turn = 2 * std::numbers::pi;
    double way = sweep > 0 ? angle - begin : begin - angle;
    way -= turn * std::floor(way / turn);
    return way <= std::abs(sweep);
  }
};

/// Returns the arc from one corner to another, which has a bulge.
inline Arc arc_between(const ProfilePoint& from, const ProfilePoint& to) {
  const double dx = to.x - from.x, dy = to.y - from.y;
  // The center is on the left of the chord for a bulge between 0 and 1.
  const double rise = (1 - to.bulge * to.bulge) / (4 * to.bulge);
  Arc arc;
  arc.x = (from.x + to.x) / 2 - dy * rise;
  arc.y = (from.y + to.y) / 2 + dx * rise;
  arc.radius = elementary::hypot(dx, dy) * (1 + to.bulge * to.bulge) / (4 * std::abs(to.bulge));
  arc.begin = elementary::atan2(from.y - arc.y, from.x - arc.x);
  arc.sweep = 4 * elementary::atan(to.bulge);
  return arc;
}

/// Adds an arc that an affine map may make a part of an ellipse. It is cut into cubic curves whose
/// error is below 1e-7 of the radius.
template <class Map>
void append_mapped_arc(Contour& contour, const Arc& arc, const Map& map) {
  const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(arc.sweep) * 8 / 3.2)));
  const double step = arc.sweep / pieces;
  const double reach = elementary::tan(step / 4) * 4 / 3;
  for (int piece = 0; piece < pieces; ++piece) {
    const CurvePoint from = arc.at_angle(arc.begin + piece * step);
    const CurvePoint to = arc.at_angle(arc.begin + (piece + 1) * step);
    append_cubic(
        contour,
        map(CurvePoint{from.x - reach * (from.y - arc.y), from.y + reach * (from.x - arc.x)}),
        map(CurvePoint{to.x + reach * (to.y - arc.y), to.y - reach * (to.x - arc.x)}), map(to));
  }
}

}  // namespace crt::importing
