// Distances from the pieces of contours, by the textbook's formulas in extended precision.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "crt/curves.hpp"

namespace crt::test {

/// A Random makes reproducible random numbers.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  bool one_in(std::uint64_t count) { return engine_() % count == 0; }

 private:
  std::mt19937_64 engine_;
};

/// A Point has extended precision, so that no rounding of doubles is its own.
struct Point {
  long double x = 0;
  long double y = 0;
};

inline Point operator+(const Point& a, const Point& b) {
  return {a.x + b.x, a.y + b.y};
}
inline Point operator-(const Point& a, const Point& b) {
  return {a.x - b.x, a.y - b.y};
}
inline Point operator*(long double factor, const Point& a) {
  return {factor * a.x, factor * a.y};
}
inline long double length(const Point& a) {
  return std::hypot(a.x, a.y);
}

/// An ArcPiece is a piece of a contour, with its circle.
struct ArcPiece {
  Point from;
  Point to;
  long double angle = 0;  ///< that it turns by, or 0 for a straight piece
  Point center;

  ArcPiece(const ProfilePoint& begin, const ProfilePoint& end)
      : from{begin.x, begin.y}, to{end.x, end.y}, angle(4 * std::atan(std::fabs(end.bulge))) {
    if (end.bulge == 0) return;
    const long double bulge = end.bulge;
    const Point chord = to - from;
    const long double height = (1 - bulge * bulge) / (4 * bulge);
    center = from + 0.5L * chord + height * Point{-chord.y, chord.x};
    if (bulge < 0) angle = -angle;
  }

  /// Returns the point at a share of the piece.
  Point at(long double share) const {
    if (angle == 0) return from + share * (to - from);
    const long double c = std::cos(share * angle);
    const long double s = std::sin(share * angle);
    const Point arm = from - center;
    return center + Point{c * arm.x - s * arm.y, s * arm.x + c * arm.y};
  }

  long double distance(const Point& point) const {
    const long double to_ends = std::min(length(point - from), length(point - to));
    const Point along = to - from;
    if (angle == 0) {
      const Point offset = point - from;
      const long double squared = along.x * along.x + along.y * along.y;
      const long double share = (offset.x * along.x + offset.y * along.y) / squared;
      return length(offset - std::clamp(share, 0.0L, 1.0L) * along);
    }
    const Point arm = from - center;
    const Point other = point - center;
    long double turned =
        std::atan2(arm.x * other.y - arm.y * other.x, arm.x * other.x + arm.y * other.y);
    if (angle < 0) turned = -turned;
    if (turned < 0) turned += 2 * std::numbers::pi_v<long double>;
    const bool is_beside = turned <= std::fabs(angle);
    return is_beside ? std::min(to_ends, std::fabs(length(other) - length(arm))) : to_ends;
  }
};

/// Returns the pieces between a contour's corners, from the first corner to the last.
inline std::vector<ArcPiece> pieces_of(const Contour& contour) {
  std::vector<ArcPiece> pieces;
  for (std::size_t i = 1; i < contour.size(); ++i) pieces.emplace_back(contour[i - 1], contour[i]);
  return pieces;
}

/// Returns the largest distance that a point of `line`, which a parameter in [0, 1] gives, has from
/// the nearest piece. Points are tried that lie close together.
template <class Line>
long double largest_distance(const Line& line, const std::vector<ArcPiece>& pieces, int points) {
  long double largest = 0;
  for (int i = 0; i <= points; ++i) {
    const Point point = line(static_cast<long double>(i) / static_cast<long double>(points));
    long double nearest = std::numeric_limits<long double>::infinity();
    for (const ArcPiece& piece : pieces) nearest = std::min(nearest, piece.distance(point));
    largest = std::max(largest, nearest);
  }
  return largest;
}

}  // namespace crt::test
