// How often contours go about a point, by the sum of the angles in which it sees them.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "contours/arc_distance.hpp"

namespace crt::test {

/// Returns the pieces of a contour with the one that closes it.
inline std::vector<ArcPiece> closed_pieces_of(const Contour& contour) {
  std::vector<ArcPiece> pieces;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const ArcPiece piece(contour[i], contour[(i + 1) % contour.size()]);
    if (length(piece.to - piece.from) > 0) pieces.push_back(piece);
  }
  return pieces;
}

/// A View is what a point sees of contours.
struct View {
  int winding = 0;
  long double distance = std::numeric_limits<long double>::infinity();

  View(const std::vector<Contour>& contours, const Point& point) {
    long double turned = 0;
    for (const Contour& contour : contours) {
      for (const ArcPiece& piece : closed_pieces_of(contour)) {
        distance = std::min(distance, piece.distance(point));
        const int steps = piece.angle == 0 ? 1 : 32;
        for (int i = 0; i < steps; ++i) {
          const Point a = piece.at(static_cast<long double>(i) / steps) - point;
          const Point b = piece.at(static_cast<long double>(i + 1) / steps) - point;
          turned += std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
        }
      }
    }
    winding = static_cast<int>(std::lround(turned / (2 * std::numbers::pi_v<long double>)));
  }
  bool is_odd() const { return winding % 2 != 0; }
};

/// Returns the area within a contour that does not cross itself.
inline long double area_within(const Contour& contour) {
  long double area = 0;
  for (const ArcPiece& piece : closed_pieces_of(contour)) {
    area += (piece.from.x * piece.to.y - piece.from.y * piece.to.x) / 2;
    if (piece.angle == 0) continue;
    const long double radius = length(piece.from - piece.center);
    area += radius * radius * (piece.angle - std::sin(piece.angle)) / 2;
  }
  return std::fabs(area);
}

/// Returns the area of what is inside by the even-odd rule, if no contours cross. Those within an
/// odd number of others are holes.
inline double area_of(const std::vector<Contour>& contours) {
  long double area = 0;
  for (const Contour& contour : contours) {
    std::vector<Contour> others;
    for (const Contour& other : contours) {
      if (&other != &contour) others.push_back(other);
    }
    const bool is_hole = View(others, closed_pieces_of(contour)[0].at(0.4L)).is_odd();
    area += is_hole ? -area_within(contour) : area_within(contour);
  }
  return static_cast<double>(area);
}

}  // namespace crt::test
