#include <algorithm>
#include <cmath>
#include <crt/elementary.hpp>
#include <numbers>
#include <vector>

#include "core/contours/append.hpp"
#include "core/contours/biarcs.hpp"
#include "crt/error.hpp"

namespace crt::core {

namespace {

/// Returns the tangent of a quarter of the angle of an arc of the unit circle over half a chord.
double bulge_over(double half_chord, bool is_large) {
  const double cosine = std::sqrt((1 - half_chord) * (1 + half_chord));
  return is_large ? (1 + cosine) / half_chord : half_chord / (1 + cosine);
}

/// Adds an arc of a circle. One of more than half a turn becomes two, as its ends are close
/// together.
void append_circular_arc(Contour& contour, double bulge, const Vec2& end) {
  const Vec2 begin(contour.back().x, contour.back().y);
  const double magnitude =
      std::max({std::abs(begin.x), std::abs(begin.y), std::abs(end.x), std::abs(end.y)});
  const auto append = [&](const Vec2& from, const Vec2& to, double by) {
    const double shown =
        bulge_with_circle(by, glm::length(to - from), least_share_of_rise * magnitude);
    append_corner(contour, {.x = to.x, .y = to.y, .bulge = shown});
  };
  if (std::abs(bulge) <= 1) return append(begin, end, bulge);
  const Vec2 chord = end - begin;
  const Vec2 middle = begin + 0.5 * chord - 0.5 * bulge * quarter_turned(chord);
  const double half = bulge / (1 + elementary::hypot(1.0, bulge));
  append(begin, middle, half);
  append(middle, end, half);
}

/// An EllipseFrame maps the unit circle's plane to that of the ellipse.
struct EllipseFrame {
  Vec2 axis{1, 0};
  double radius_x = 1;
  double radius_y = 1;

  Vec2 to_unit(const Vec2& v) const {
    return {dot(axis, v) / radius_x, dot(quarter_turned(axis), v) / radius_y};
  }
  Vec2 from_unit(const Vec2& v) const {
    return v.x * radius_x * axis + v.y * radius_y * quarter_turned(axis);
  }
};

/// Returns an arc of the unit circle from the origin as so many cubics. It begins in a direction,
/// given as an angle, and turns by another angle.
std::vector<Cubic> cubics_of_arc(double begin, double turn, int count) {
  const auto direction = [](double angle) {
    return Vec2(elementary::cos(angle), elementary::sin(angle));
  };
  const auto at = [&](double angle) {
    return 2 * elementary::sin(0.5 * std::abs(angle)) * direction(begin + 0.5 * angle);
  };
  const double step = turn / count;
  const double reach = 4.0 / 3.0 * elementary::tan(0.25 * std::abs(step));
  std::vector<Cubic> cubics;
  for (int i = 0; i < count; ++i) {
    const double from = i * step;
    const double to = (i + 1) * step;
    cubics.push_back({at(from), at(from) + reach * direction(begin + from),
                      at(to) - reach * direction(begin + to), at(to)});
  }
  return cubics;
}

/// Returns how far such a cubic is from the unit circle.
/// Source: M. Goldapp, Approximation of circular arcs by cubic polynomials, 1991.
double error_of_cubic(double angle) {
  const double sine = elementary::sin(0.25 * angle);
  const double cosine = elementary::cos(0.25 * angle);
  return 4.0 / 27.0 * elementary::pow(sine, 6) / (cosine * cosine);
}

/// Adds an arc of an ellipse, whose bulge is that of the circle's arc which the frame maps to it.
void append_arc_of_ellipse(Contour& contour, const EllipseFrame& frame, double bulge,
                           const CurvePoint& end, double deviation) {
  const CurvePoint origin{contour.back().x, contour.back().y};
  const Vec2 way(end.x - origin.x, end.y - origin.y);
  const Vec2 chord = frame.to_unit(way);
  const double turn = 4 * elementary::atan(bulge);
  const double begin = elementary::atan2(chord.y, chord.x) - 0.5 * turn;
  constexpr double usual_step = std::numbers::pi / 8;
  int count = static_cast<int>(std::ceil(std::abs(turn) / usual_step));
  const auto points = [&] {
    std::vector<Cubic> cubics = cubics_of_arc(begin, turn, count);
    for (Cubic& cubic : cubics) {
      for (Vec2& point : cubic) point = Vec2(origin.x, origin.y) + frame.from_unit(point);
    }
    return cubics;
  };
  std::vector<Cubic> cubics = points();
  Vec2 lower = cubics[0][0];
  Vec2 upper = lower;
  for (const Cubic& cubic : cubics) {
    for (const Vec2& point : cubic) {
      lower = min(lower, point);
      upper = max(upper, point);
    }
  }
  const Vec2 box = upper - lower;
  const double magnitude =
      std::max({std::abs(lower.x), std::abs(lower.y), std::abs(upper.x), std::abs(upper.y)});
  const double within = checked_deviation(deviation, std::max(box.x, box.y), magnitude);
  // A part of the deviation is for the cubics, and the rest for what becomes of them.
  constexpr double share_of_cubics = 0.125;
  const double radius = std::max(frame.radius_x, frame.radius_y);
  constexpr int max_cubics = 1024;
  while (radius * error_of_cubic(turn / count) > share_of_cubics * within && count < max_cubics) {
    count *= 2;
  }
  cubics = points();
  const Vec2 off = cubics.back()[3] - Vec2(end.x, end.y);
  if (!(glm::length(off) <= share_of_cubics * within)) {
    throw Error(ErrorCode::invalid_argument,
                "the radii of an arc differ too much from each other, or from its size, for "
                "doubles to say its ellipse");
  }
  for (const Cubic& cubic : cubics) {
    const auto point = [&](std::size_t i) { return CurvePoint{cubic[i].x, cubic[i].y}; };
    const CurvePoint to = &cubic == &cubics.back() ? end : point(3);
    append_cubic(contour, point(1), point(2), to, (1 - 2 * share_of_cubics) * within);
  }
}

}  // namespace

void append_elliptical_arc(Contour& contour, const EllipticalArc& arc, const CurvePoint& end,
                           double deviation) {
  check_point(end, "end");
  const Vec2 way(end.x - contour.back().x, end.y - contour.back().y);
  if (way == Vec2(0, 0)) return;
  EllipseFrame frame{.radius_x = std::abs(arc.radius_x), .radius_y = std::abs(arc.radius_y)};
  if (frame.radius_x == 0 || frame.radius_y == 0) {
    return append_corner(contour, {.x = end.x, .y = end.y});
  }
  const bool is_circle = frame.radius_x == frame.radius_y;
  if (!is_circle) {
    const double angle = std::fmod(arc.turned, 360.0) * (std::numbers::pi / 180);
    frame.axis = {elementary::cos(angle), elementary::sin(angle)};
  }
  double half_chord = 0.5 * glm::length(frame.to_unit(way));
  if (half_chord > 1) {
    frame.radius_x *= half_chord;
    frame.radius_y *= half_chord;
    half_chord = 1;
  }
  const double size = bulge_over(half_chord, arc.is_large);
  const double bulge = arc.is_counterclockwise ? size : -size;
  if (is_circle) return append_circular_arc(contour, bulge, {end.x, end.y});
  append_arc_of_ellipse(contour, frame, bulge, end, deviation);
}

}  // namespace crt::core
