#include "core/section/circle_fit.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "crt/elementary.hpp"

namespace crt::core {

namespace {

constexpr double full_turn = 2 * std::numbers::pi;
/// More than this, and a whole circle is meant.
constexpr double most_angle = 0.95 * full_turn;
/// Flatter arcs than this hardly differ from lines.
constexpr double most_radius = 1e6;

struct Circle {
  PlanePoint center;
  double radius = 0;
};

/// Returns the circle through three points.
std::optional<Circle> circle_through(const PlanePoint& a, const PlanePoint& b,
                                     const PlanePoint& c) {
  const double bx = b.x - a.x;
  const double by = b.y - a.y;
  const double cx = c.x - a.x;
  const double cy = c.y - a.y;
  const double twice = 2 * (bx * cy - by * cx);
  const double b_squared = bx * bx + by * by;
  const double c_squared = cx * cx + cy * cy;
  const double x = (cy * b_squared - by * c_squared) / twice;
  const double y = (bx * c_squared - cx * b_squared) / twice;
  const Circle circle{{a.x + x, a.y + y}, std::sqrt(x * x + y * y)};
  if (!std::isfinite(circle.radius)) return {};
  return circle;
}

/// Returns the angle from one point to another as seen from a center, between -pi and pi.
double angle_between(const PlanePoint& center, const PlanePoint& from, const PlanePoint& to) {
  const double ax = from.x - center.x;
  const double ay = from.y - center.y;
  const double bx = to.x - center.x;
  const double by = to.y - center.y;
  return elementary::atan2(ax * by - ay * bx, ax * bx + ay * by);
}

/// Follows points around a circle. Returns how far what is between them is from it at most, or
/// nothing if they turn back or are farther than a tolerance. Gives the angle from the first to the
/// last.
std::optional<double> follow(const Circle& circle, std::span<const BoundaryPoint> points,
                             bool is_closed, const FitTolerance& tolerance, double& angle) {
  double off = 0;
  angle = 0;
  const std::size_t count = is_closed ? points.size() + 1 : points.size();
  double direction = 0;
  double before = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const PlanePoint& here = points[i % points.size()].place;
    const double away = std::abs(distance_between(circle.center, here) - circle.radius);
    if (!(away <= tolerance.points)) return {};
    off = std::max(off, away);
    const double last_away = std::exchange(before, away);
    if (i == 0) continue;
    const BoundaryPoint& last = points[i - 1];
    const double step = angle_between(circle.center, last.place, here);
    if (direction == 0) direction = step;
    if (!(step * direction >= 0) || std::abs(step) > 0.5 * std::numbers::pi) return {};
    // Two arcs over one chord are no farther apart than their middles.
    const double own = elementary::sin(0.25 * step) / elementary::cos(0.25 * step);
    const double between = std::max(away, last_away) +
                           0.5 * distance_between(last.place, here) * std::abs(own - last.bulge);
    if (!(between <= tolerance.between)) return {};
    off = std::max(off, between);
    angle += step;
    if (std::abs(angle) > 1.01 * full_turn) return {};
  }
  return off;
}

/// Returns how far points, and what is between them, are from the line from the first to the last.
std::optional<double> distance_from_line(std::span<const BoundaryPoint> points, double tolerance) {
  const PlanePoint& from = points.front().place;
  const PlanePoint& to = points.back().place;
  const double length = distance_between(from, to);
  if (!(length > 0)) return {};
  const double x = (to.x - from.x) / length;
  const double y = (to.y - from.y) / length;
  double off = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PlanePoint& point = points[i].place;
    const double dx = point.x - from.x;
    const double dy = point.y - from.y;
    const double along = dx * x + dy * y;
    double away = std::abs(dx * y - dy * x);
    if (along < 0) away = std::max(away, distance_between(from, point));
    if (along > length) away = std::max(away, distance_between(to, point));
    if (i + 1 < points.size()) {
      // The arc from here is within its sagitta of the chord, whose other end comes next.
      const double sagitta =
          0.5 * distance_between(point, points[i + 1].place) * std::abs(points[i].bulge);
      off = std::max(off, away + sagitta);
      const PlanePoint& next = points[i + 1].place;
      const double next_away = std::abs((next.x - from.x) * y - (next.y - from.y) * x);
      off = std::max(off, next_away + sagitta);
    }
    off = std::max(off, away);
    if (!(off <= tolerance)) return {};
  }
  return off;
}

}  // namespace

std::optional<FittedArc> fit_arc(std::span<const BoundaryPoint> points,
                                 const FitTolerance& tolerance) {
  if (points.size() == 2) return FittedArc{.bulge = points.front().bulge, .off = 0};
  if (const std::optional<double> off = distance_from_line(points, tolerance.points))
    return FittedArc{.bulge = 0, .off = *off};
  const PlanePoint& from = points.front().place;
  const PlanePoint& to = points.back().place;
  const double chord = distance_between(from, to);
  if (!(chord > 0)) return {};
  for (const std::size_t quarters : {2U, 1U, 3U}) {
    const std::size_t between =
        std::clamp<std::size_t>(points.size() * quarters / 4, 1, points.size() - 2);
    const std::optional<Circle> circle = circle_through(from, points[between].place, to);
    if (!circle || circle->radius > most_radius * chord) continue;
    double angle = 0;
    const std::optional<double> off = follow(*circle, points, false, tolerance, angle);
    if (!off || std::abs(angle) > most_angle || angle == 0) continue;
    // The tangent of a quarter of the angle is that of the angle at the chord's end.
    const double sine = elementary::sin(0.25 * angle);
    const double cosine = elementary::cos(0.25 * angle);
    return FittedArc{.bulge = sine / cosine, .off = *off};
  }
  return {};
}

std::optional<FittedContour> fit_circle(std::span<const BoundaryPoint> points,
                                        const FitTolerance& tolerance) {
  constexpr std::size_t fewest = 6;
  if (points.size() < fewest) return {};
  const std::size_t third = points.size() / 3;
  const std::optional<Circle> circle =
      circle_through(points[0].place, points[third].place, points[2 * third].place);
  if (!circle) return {};
  double angle = 0;
  const std::optional<double> off = follow(*circle, points, true, tolerance, angle);
  if (!off || std::abs(std::abs(angle) - full_turn) > 0.01) return {};
  const double bulge = angle > 0 ? 1 : -1;
  const auto [center, radius] = *circle;
  return FittedContour{
      .contour = {{center.x + radius, center.y, bulge}, {center.x - radius, center.y, bulge}},
      .off = *off};
}

}  // namespace crt::core
