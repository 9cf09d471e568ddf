#include "core/contours/biarcs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/math/vector.hpp"

namespace crt::core {

namespace {

/// An arc may turn by so much that the curve beside it is well away from its center.
constexpr double largest_bulge = 0.5;

/// Returns a bound on the distance of a curve from the arc between two points, and of the arc from
/// the curve. It is infinite where there is none. The curve must begin and end on the radii of the
/// arc's ends.
double distance_bound(const Cubic& curve, const Vec2& from, const Vec2& to, double bulge) {
  const Vec2 chord = to - from;
  const double length = glm::length(chord);
  if (!(length > 0)) return infinity;
  const double half = 0.5 * length;
  const Vec2 along = chord / length;
  const Vec2 across = quarter_turned(along);
  const Vec2 middle = from + 0.5 * chord;
  Cubic offset{};
  for (std::size_t i = 0; i < 4; ++i) offset[i] = curve[i] - middle;

  const double straightness = half * (1 - bulge * bulge);
  const auto turning = bernstein_product(
      offset, steps_of(curve), [](const Vec2& a, const Vec2& step) { return cross(a, step); });
  const auto advance =
      bernstein_product(std::array<double, 4>{1, 1, 1, 1}, steps_of(curve),
                        [&](double, const Vec2& step) { return dot(along, step); });
  for (std::size_t i = 0; i < turning.size(); ++i) {
    if (2 * bulge * turning[i] + straightness * advance[i] < 0) return infinity;
  }

  const auto squares =
      bernstein_product(offset, offset, [](const Vec2& a, const Vec2& b) { return dot(a, b); });
  const auto heights = bernstein_product(std::array<double, 4>{1, 1, 1, 1}, offset,
                                         [&](double, const Vec2& a) { return dot(across, a); });
  double most = 0;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const double value = bulge * (squares[i] - half * half) - straightness * heights[i];
    most = std::max(most, std::abs(value));
  }
  const double gradient = half * (1 + bulge * bulge);
  most /= gradient;
  // F is (d^2 - r^2) / 2r for the distance d from the center.
  const double by_radius = 4 * most * std::abs(bulge) / gradient;
  if (!(by_radius < 0.5)) return infinity;
  return 2 * most / (1 + std::sqrt(1 - by_radius));
}

/// Returns the direction of the first step that is long enough to have one.
std::optional<Vec2> direction_of(std::array<Vec2, 3> steps) {
  constexpr double negligible = 0x1p-40;
  double longest = 0;
  for (const Vec2& step : steps) longest = std::max(longest, glm::length(step));
  for (const Vec2& step : steps) {
    const double length = glm::length(step);
    if (length > 0 && length > negligible * longest) return step / length;
  }
  return std::nullopt;
}

/// A Biarc is two arcs with one direction where they join.
struct Biarc {
  ArcTo first;
  ArcTo second;
  Vec2 direction{0, 0};  ///< where they join
};

std::optional<Biarc> biarc_of(const Cubic& curve) {
  const auto [first, second, third] = steps_of(curve);
  const std::optional<Vec2> begin = direction_of({first, second, third});
  const std::optional<Vec2> end = direction_of({third, second, first});
  if (!begin || !end) return std::nullopt;
  const Vec2 chord = curve[3] - curve[0];
  const double along = dot(chord, *begin + *end);
  if (!(along > 0)) return std::nullopt;
  // The inner control points are at the same distance from the ends, and at twice that from each
  // other.
  const Vec2 turn = *end - *begin;
  const double squared = dot(chord, chord);
  const double distance = squared / (along + std::sqrt(along * along + dot(turn, turn) * squared));
  const Vec2 inner1 = curve[0] + distance * *begin;
  const Vec2 inner2 = curve[3] - distance * *end;
  Biarc biarc;
  biarc.first.end = 0.5 * (inner1 + inner2);
  biarc.second.end = curve[3];
  biarc.direction = inner2 - inner1;
  const Vec2 chord1 = biarc.first.end - curve[0];
  const Vec2 chord2 = curve[3] - biarc.first.end;
  biarc.first.bulge = cross(*begin, chord1) / (glm::length(chord1) + dot(*begin, chord1));
  biarc.second.bulge = cross(chord2, *end) / (glm::length(chord2) + dot(*end, chord2));
  for (const ArcTo& arc : {biarc.first, biarc.second}) {
    if (!(std::abs(arc.bulge) <= largest_bulge)) return std::nullopt;
  }
  return biarc;
}

/// Returns where the curve crosses the line across the biarc's direction where its arcs join.
double parameter_of_join(const Cubic& curve, const Biarc& biarc) {
  std::array<double, 4> ahead{};
  for (std::size_t i = 0; i < 4; ++i) ahead[i] = dot(biarc.direction, curve[i] - biarc.first.end);
  double below = 0;
  double above = 1;
  for (int halvings = 0; halvings < 54; ++halvings) {
    const double t = 0.5 * (below + above);
    const double s = 1 - t;
    const double value =
        s * s * (s * ahead[0] + 3 * t * ahead[1]) + t * t * (3 * s * ahead[2] + t * ahead[3]);
    (value < 0 ? below : above) = t;
  }
  return 0.5 * (below + above);
}

/// Makes an arc straight that is too flat for its circle.
void flatten(ArcTo& arc, const Vec2& from, double least_rise) {
  arc.bulge = bulge_with_circle(arc.bulge, glm::length(arc.end - from), least_rise);
}

/// Returns whether a curve is so small that a straight line does for it.
bool is_small(const Cubic& curve, double deviation) {
  return std::all_of(curve.begin(), curve.end(), [&](const Vec2& point) {
    return glm::length(point - curve[0]) <= 0.5 * deviation;
  });
}

}  // namespace

double bulge_with_circle(double bulge, double chord, double least_rise) {
  constexpr double least_bulge = 0x1p-22;
  const double size = std::abs(bulge);
  return size < least_bulge || 0.5 * size * chord < least_rise ? 0 : bulge;
}

void append_biarcs(const Cubic& curve, const Fit& fit, std::vector<ArcTo>& arcs) {
  // A bend that this much of the deviation hides is no edge.
  constexpr double share_of_straight = 0x1p-10;
  if (is_small(curve, fit.deviation) ||
      distance_bound(curve, curve[0], curve[3], 0) <= share_of_straight * fit.deviation) {
    arcs.push_back({.end = curve[3]});
    return;
  }
  if (std::optional<Biarc> biarc = biarc_of(curve)) {
    flatten(biarc->first, curve[0], fit.least_rise);
    flatten(biarc->second, biarc->first.end, fit.least_rise);
    const auto parts = split(curve, parameter_of_join(curve, *biarc));
    const ArcTo& first = biarc->first;
    const ArcTo& second = biarc->second;
    if (distance_bound(parts.first, curve[0], first.end, first.bulge) <= fit.deviation &&
        distance_bound(parts.second, first.end, second.end, second.bulge) <= fit.deviation) {
      arcs.push_back(first);
      arcs.push_back(second);
      return;
    }
  }
  const auto halves = split(curve, 0.5);
  append_biarcs(halves.first, fit, arcs);
  append_biarcs(halves.second, fit, arcs);
}

}  // namespace crt::core
