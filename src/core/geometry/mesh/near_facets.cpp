#include "core/geometry/mesh/near_facets.hpp"

#include <algorithm>

#include "core/math/vector.hpp"

namespace crt::core {

namespace {

PointOf<Interval> cross(const PointOf<Interval>& a, const PointOf<Interval>& b) {
  const auto component = [&](std::size_t i, std::size_t j) { return a[i] * b[j] - a[j] * b[i]; };
  return {component(1, 2), component(2, 0), component(0, 1)};
}

/// Returns the axis that a plane is exactly across, or 3 if it is across none.
std::size_t axis_across(const HalfSpaceFunction& plane) {
  const auto is_none = [&](std::size_t i) {
    return plane.normal[i].lo == 0 && plane.normal[i].hi == 0;
  };
  if (is_none(1) && is_none(2)) return 0;
  if (is_none(0) && is_none(2)) return 1;
  return is_none(0) && is_none(1) ? 2 : 3;
}

}  // namespace

HalfSpaceFunction plane_function(const Triangle& triangle) {
  const PointOf<Interval> along = relative_to(known_point(triangle.b), triangle.a);
  const PointOf<Interval> aside = relative_to(known_point(triangle.c), triangle.a);
  const auto to_one = [](const Vec3& side) {
    return inverse_of_power(power_of_two_below(largest_component(side)));
  };
  PointOf<Interval> normal = cross(scaled(along, to_one(triangle.b - triangle.a)),
                                   scaled(aside, to_one(triangle.c - triangle.a)));
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<int>(i);
    const double place = triangle.a[axis];
    if (triangle.b[axis] != place || triangle.c[axis] != place || normal[i].contains(0)) continue;
    const double sign = normal[i].lo > 0 ? 1 : -1;
    normal = {Interval{0, 0}, Interval{0, 0}, Interval{0, 0}};
    normal[i] = Interval::of(sign);
    break;
  }
  return {.normal = normal, .position = triangle.a};
}

int side_of(const HalfSpaceFunction& plane, const PointOf<Interval>& box) {
  Interval value = plane.value(box);
  if (const std::size_t i = axis_across(plane); i < 3) {
    value = box[i] - Interval::of(plane.position[static_cast<int>(i)]);
    if (plane.normal[i].hi < 0) value = -value;
  }
  if (value.lo == 0 && value.hi == 0) return 0;
  return value.lo >= 0 ? 1 : (value.hi <= 0 ? -1 : 0);
}

CutByTriangle cut_by(const Triangle& triangle, const HalfSpaceFunction& plane,
                     const PointOf<Interval>& box) {
  // A point on the triangle's edges is cut, too.
  const bool is_point = is_one_point(box);
  const auto is_below = [&](double a, double b) { return is_point ? a < b : a <= b; };
  Bounds bounds;
  for (const Vec3& corner : {triangle.a, triangle.b, triangle.c}) bounds.include(corner);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<int>(i);
    if (is_below(box[i].hi, bounds.lower[axis]) || is_below(bounds.upper[axis], box[i].lo))
      return CutByTriangle::none;
  }
  if (side_of(plane, box) != 0) return CutByTriangle::none;
  const Vec3 corners[] = {triangle.a, triangle.b, triangle.c, triangle.a};
  bool is_all = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const PointOf<Interval> edge = relative_to(known_point(corners[i + 1]), corners[i]);
    const HalfSpaceFunction inwards{.normal = cross(plane.normal, edge), .position = corners[i]};
    const Interval within = inwards.value(box);
    if (is_below(within.hi, 0)) return CutByTriangle::none;
    is_all = is_all && within.lo >= 0;
  }
  return is_all ? CutByTriangle::all : CutByTriangle::some;
}

Cut cut_by(const HalfSpaceFunction& plane, const Vec3& middle) {
  const Interval length = root(squared_length(plane.normal));
  Cut cut{.slope = plane.normal, .at_middle = plane.value(known_point(middle))};
  if (!(length.lo > 0)) return cut;
  for (Interval& component : cut.slope) component = component / length;
  cut.at_middle = cut.at_middle / length;
  return cut;
}

}  // namespace crt::core
