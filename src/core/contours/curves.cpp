#include "crt/curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/contours/append.hpp"
#include "core/contours/biarcs.hpp"
#include "core/math/vector.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt {

namespace core {

void check_point(const CurvePoint& point, const char* name) {
  constexpr double largest = 1e100;
  for (const double number : {point.x, point.y}) {
    if (!(std::abs(number) <= largest)) {
      throw Error(ErrorCode::invalid_argument,
                  text::format("{} must have finite numbers of at most 1e100 in magnitude (it is "
                               "({}, {}))",
                               name, point.x, point.y),
                  name);
    }
  }
}

double checked_deviation(double deviation, double size, double magnitude) {
  constexpr double usual_share = 1e-4;
  constexpr double least_share = 0x1p-32;
  constexpr double share_of_magnitude = 0x1p-44;  // leaves room for the rounding of corners
  const double by_magnitude = share_of_magnitude * magnitude;
  if (deviation == 0) return std::max(usual_share * size, by_magnitude);
  const double least = std::max(least_share * size, by_magnitude);
  if (!(deviation >= least) || !std::isfinite(deviation)) {
    throw Error(ErrorCode::invalid_argument,
                text::format("deviation must be 0 or at least {} for such a curve (it is {})",
                             least, deviation),
                "deviation");
  }
  return deviation;
}

void append_corner(Contour& contour, const ProfilePoint& corner) {
  constexpr double smallest_length = 1e-100;
  const ProfilePoint& last = contour.back();
  if (std::max(std::abs(corner.x - last.x), std::abs(corner.y - last.y)) >= smallest_length) {
    contour.push_back(corner);
  }
}

}  // namespace core

using namespace core;

void append_cubic(Contour& contour, const CurvePoint& control1, const CurvePoint& control2,
                  const CurvePoint& end, double deviation) {
  if (contour.empty()) {
    throw Error(ErrorCode::invalid_argument, "contour must have a corner for the curve to begin at",
                "contour");
  }
  const CurvePoint begin{contour.back().x, contour.back().y};
  check_point(begin, "contour");
  check_point(control1, "control1");
  check_point(control2, "control2");
  check_point(end, "end");
  double size = 0;
  double magnitude = 0;
  for (const double CurvePoint::*axis : {&CurvePoint::x, &CurvePoint::y}) {
    const auto [least, most] =
        std::minmax({begin.*axis, control1.*axis, control2.*axis, end.*axis});
    size = std::max(size, most - least);
    magnitude = std::max({magnitude, std::abs(least), std::abs(most)});
  }
  const double within = checked_deviation(deviation, size, magnitude);
  constexpr double smallest_length = 1e-100;
  if (size < smallest_length) return;

  // The curve is brought to the origin and to a size of about 1, and the corners back.
  const double unit = power_of_two_below(size);
  const auto moved = [&](const CurvePoint& point) {
    return Vec2((point.x - begin.x) / unit, (point.y - begin.y) / unit);
  };
  constexpr double rounding_of_corners = 0x1p-50;  // of the curve's points, too
  constexpr double rounding_of_bounds = 0x1p-14;
  const Fit fit{
      .deviation = (within - rounding_of_corners * magnitude) / unit * (1 - rounding_of_bounds),
      .least_rise = least_share_of_rise * (magnitude / unit)};
  std::vector<ArcTo> arcs;
  append_biarcs({Vec2(0, 0), moved(control1), moved(control2), moved(end)}, fit, arcs);
  for (const ArcTo& arc : arcs) {
    const bool is_last = &arc == &arcs.back();
    append_corner(contour, {.x = is_last ? end.x : begin.x + unit * arc.end.x,
                            .y = is_last ? end.y : begin.y + unit * arc.end.y,
                            .bulge = arc.bulge});
  }
}

void append_quadratic(Contour& contour, const CurvePoint& control, const CurvePoint& end,
                      double deviation) {
  if (contour.empty()) return append_cubic(contour, control, control, end, deviation);
  check_point(control, "control");
  const auto toward_control = [&](double x, double y) {
    constexpr double share = 2.0 / 3.0;
    return CurvePoint{x + share * (control.x - x), y + share * (control.y - y)};
  };
  append_cubic(contour, toward_control(contour.back().x, contour.back().y),
               toward_control(end.x, end.y), end, deviation);
}

}  // namespace crt
