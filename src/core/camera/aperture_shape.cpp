#include "core/camera/aperture_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <crt/elementary.hpp>
#include <cstddef>
#include <numbers>

#include "core/geometry/angles.hpp"

namespace crt::core {

namespace {

// Corners go clockwise from the top. They are written out, as the sines that libraries and
// compilers compute need not agree in the last bit.
constexpr double sin_60 = 0.86602540378443865;
constexpr double sin_45 = 0.70710678118654752;
constexpr double sin_72 = 0.95105651629515357;
constexpr double cos_72 = 0.30901699437494742;
constexpr double sin_36 = 0.58778525229247313;
constexpr double cos_36 = 0.80901699437494742;

constexpr std::array<LensPoint, 3> triangle = {{{0, 1}, {sin_60, -0.5}, {-sin_60, -0.5}}};
constexpr std::array<LensPoint, 5> pentagon = {
    {{0, 1}, {sin_72, cos_72}, {sin_36, -cos_36}, {-sin_36, -cos_36}, {-sin_72, cos_72}}};
constexpr std::array<LensPoint, 6> hexagon = {
    {{0, 1}, {sin_60, 0.5}, {sin_60, -0.5}, {0, -1}, {-sin_60, -0.5}, {-sin_60, 0.5}}};
constexpr std::array<LensPoint, 8> octagon = {{{0, 1},
                                               {sin_45, sin_45},
                                               {1, 0},
                                               {sin_45, -sin_45},
                                               {0, -1},
                                               {-sin_45, -sin_45},
                                               {-1, 0},
                                               {-sin_45, sin_45}}};

/// Returns a point of a polygon, as a fan of equal triangles about the origin. `u` picks one of
/// them. What is left over of `u` is uniform again, and its root is how far out the point lies. `v`
/// is where it lies along the side.
template <std::size_t sides>
LensPoint polygon_point(const std::array<LensPoint, sides>& corners, double u, double v) {
  const double scaled = u * double{sides};
  // The product may be rounded up to `sides`.
  const std::size_t index = std::min(static_cast<std::size_t>(scaled), sides - 1);
  const double rest = std::min(scaled - static_cast<double>(index), 1.0);
  const LensPoint& a = corners[index];
  const LensPoint& b = corners[(index + 1) % sides];
  const double outwards = std::sqrt(rest);
  return {outwards * (a.x + v * (b.x - a.x)), outwards * (a.y + v * (b.y - a.y))};
}

}  // namespace

LensPoint circle_point(double u, double v) {
  return point_of_disc(u, v);
}

LensPoint uniform_point(double u, double v) {
  return {2 * u - 1, 2 * v - 1};
}

LensPoint gaussian_point(double u, double v) {
  // The distance r of a point of the normal distribution is at most R with probability 1 - exp(-R^2
  // / (2 sigma^2)). This is divided by its value at the cut, and solved for r.
  constexpr double two_variances = 2 * 0.5 * 0.5;
  constexpr double cut_radius = 2;
  const double share_within_cut = 1 - elementary::exp(-cut_radius * cut_radius / two_variances);
  const double radius =
      std::min(cut_radius, std::sqrt(-two_variances * elementary::log1p(-u * share_within_cut)));
  const double angle = 2 * std::numbers::pi * v;
  return {radius * elementary::cos(angle), radius * elementary::sin(angle)};
}

LensPoint triangle_point(double u, double v) {
  return polygon_point(triangle, u, v);
}
LensPoint pentagon_point(double u, double v) {
  return polygon_point(pentagon, u, v);
}
LensPoint hexagon_point(double u, double v) {
  return polygon_point(hexagon, u, v);
}
LensPoint octagon_point(double u, double v) {
  return polygon_point(octagon, u, v);
}

LensPoint square_point(double u, double v) {
  return {sin_45 * (2 * u - 1), sin_45 * (2 * v - 1)};
}

LensPoint line_point(double u, double /*v*/) {
  return {2 * u - 1, 0};
}

LensPoint aperture_point(ApertureShape shape, double u, double v) {
  switch (shape) {
    case ApertureShape::circle:
      return circle_point(u, v);
    case ApertureShape::uniform:
      return uniform_point(u, v);
    case ApertureShape::gaussian:
      return gaussian_point(u, v);
    case ApertureShape::triangle:
      return triangle_point(u, v);
    case ApertureShape::square:
      return square_point(u, v);
    case ApertureShape::pentagon:
      return pentagon_point(u, v);
    case ApertureShape::hexagon:
      return hexagon_point(u, v);
    case ApertureShape::octagon:
      return octagon_point(u, v);
    case ApertureShape::line:
      return line_point(u, v);
  }
  return {};
}

LensPointLanes aperture_points(ApertureShape shape, const Lanes& u, const Lanes& v) {
  if (shape == ApertureShape::circle) return point_of_disc(u, v);
  LensPointLanes points;
  for (std::size_t i = 0; i < lane_count; ++i) {
    set_lane(points, i, aperture_point(shape, u[i], v[i]));
  }
  return points;
}

}  // namespace crt::core
