#include "core/geometry/face_functions.hpp"

#include <algorithm>

#include "core/math/vector.hpp"

namespace crt::core {

namespace {

/// A Way is what is between two points, in units of a power of two near its length.
struct Way {
  PointOf<Interval> vector;
  double unit = 1;

  Way(const Vec3& from, const Vec3& to) {
    double largest = 0;
    for (int i = 0; i < 3; ++i) {
      Interval& component = vector[static_cast<std::size_t>(i)];
      component = Interval::of(to[i]) - Interval::of(from[i]);
      if (to[i] == from[i]) component = {0, 0};
      largest = std::max(largest, component.magnitude());
    }
    unit = power_of_two_below(largest);
    vector = scaled(vector, inverse_of_power(unit));
  }
  Interval length() const { return root(squared_length(vector)); }
};

}  // namespace

void NearFaces::keep_within(std::uint32_t face) {
  if (kind == Kind::outside || (kind == Kind::unknown && faces.empty())) return;
  if (kind == Kind::inside) kind = Kind::where_all_negative;
  const std::uint32_t signs = 1U << faces.size();
  if (kind == Kind::where_any_negative) {
    kind = faces.size() < most_by_signs ? Kind::by_signs : Kind::unknown;
    // Only where none is below 0 there is nothing.
    inside = (std::uint32_t{2} << (signs - 1)) - 2;
  }
  if (kind == Kind::by_signs && faces.size() == most_by_signs) kind = Kind::unknown;
  if (kind == Kind::by_signs) inside <<= signs;
  faces.push_back(face);
}

bool is_one_point(const PointOf<Interval>& box) {
  return std::ranges::all_of(box, [](const Interval& side) { return side.width() == 0; });
}

bool may_overlap(const PointOf<Interval>& box, const Bounds& bounds) {
  const bool is_point = is_one_point(box);
  const auto is_below = [&](double a, double b) { return is_point ? a < b : a <= b; };
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<int>(i);
    if (is_below(box[i].hi, bounds.lower[axis]) || is_below(bounds.upper[axis], box[i].lo))
      return false;
  }
  return true;
}

PointOf<Interval> unit_vector(const Vec3& from, const Vec3& to) {
  Way way(from, to);
  const Interval length = way.length();
  for (Interval& component : way.vector) {
    const bool is_none = component.lo == 0 && component.hi == 0;
    component = is_none ? Interval{0, 0} : component / length;
  }
  return way.vector;
}

PointOf<Interval> enclosed_unit(const Vec3& unit) {
  const double off = coordinate_axis(unit) >= 0 ? 0 : 4 * unit_roundoff;
  const auto component = [&](double x) { return Interval{x - off, x + off}; };
  return {component(unit.x), component(unit.y), component(unit.z)};
}

Interval distance(const Vec3& from, const Vec3& to) {
  const Way way(from, to);
  return way.length() * Interval::of(way.unit);
}

}  // namespace crt::core
