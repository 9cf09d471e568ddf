#include "oracle/line_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace crt::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Polynomial operator+(const Polynomial& a, const Polynomial& b) {
  Polynomial result = a.size() >= b.size() ? a : b;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) result[i] = a[i] + b[i];
  return result;
}
Polynomial operator*(const Interval& a, const Polynomial& b) {
  Polynomial result;
  for (const Interval& coefficient : b) result.push_back(a * coefficient);
  return result;
}
Polynomial operator-(const Polynomial& a, const Polynomial& b) {
  return a + Interval(-1) * b;
}
Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  Polynomial result(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) result[i + k] = result[i + k] + a[i] * b[k];
  }
  return result;
}

/// The line relative to a point, and what can be said of it as polynomials in x.
struct Relative {
  Relative(const ExactLine& line, const Vec3& origin)
      : point(line.point - exactly(origin)), direction(line.direction) {}

  Polynomial along(const IntervalVec& axis) const { return {dot(axis, point), dot(axis, direction)}; }
  Polynomial squared_distance() const {
    return {squared(point), Interval(2) * dot(point, direction), squared(direction)};
  }

  IntervalVec point;
  IntervalVec direction;
};

// A truncated cone about `axis` = to - from, A = axis . axis, k = radius2 - radius, w = p - from,
// h = w . axis: F = |w|^2 A^2 - h^2 A - (radius A + k h)^2 < 0 and 0 < h < A.
std::vector<Polynomial> equations(const Frustum& c, const ExactLine& line) {
  const Relative relative(line, c.from);
  const IntervalVec axis = exactly(c.to) - exactly(c.from);
  const Interval a = squared(axis);
  const Polynomial h = relative.along(axis);
  const Interval growth = Interval(c.radius2) - Interval(c.radius);
  const Polynomial radius = Polynomial{Interval(c.radius) * a} + growth * h;
  return {square(a) * relative.squared_distance() - a * (h * h) - radius * radius, Interval(-1) * h,
          h - Polynomial{a}};
}

std::vector<Polynomial> equations(const Sphere& s, const ExactLine& line) {
  return {Relative(line, s.center).squared_distance() - Polynomial{square(Interval(s.radius))}};
}

std::vector<Polynomial> equations(const Box& b, const ExactLine& line) {
  std::vector<Polynomial> result;
  const Relative lower(line, glm::min(b.corner_a, b.corner_b));
  const Relative upper(line, glm::max(b.corner_a, b.corner_b));
  for (std::size_t i = 0; i < 3; ++i) {
    result.push_back({-lower.point[i], -lower.direction[i]});
    result.push_back({upper.point[i], upper.direction[i]});
  }
  return result;
}

std::vector<Polynomial> equations(const Plane& p, const ExactLine& line) {
  return {Relative(line, p.position).along(exactly(p.normal))};
}
std::vector<Polynomial> equations(const Cylinder& c, const ExactLine& line) {
  return equations(frustum_of(c), line);
}
std::vector<Polynomial> equations(const Cone& c, const ExactLine& line) {
  return equations(frustum_of(c), line);
}

// With S = |p|^2 + R^2 - r^2, inside means S < 2 R rho: S < 0 or Q = |axis|^2 (S^2 - 4 R^2 rho^2) < 0.
// So the lemon within a spindle torus, where Q > 0 and S < 0, is filled.
std::vector<Polynomial> equations(const Torus& torus, const ExactLine& line) {
  const Relative relative(line, torus.center);
  const IntervalVec axis = exactly(torus.axis);
  const Polynomial distance = relative.squared_distance();
  const Polynomial height = relative.along(axis);
  const Interval ring = square(Interval(torus.radius));
  const Polynomial s = distance + Polynomial{ring - square(Interval(torus.thickness))};
  const Interval a = squared(axis);
  return {a * (s * s) - (Interval(4) * ring) * (a * distance - height * height), s};
}

std::vector<Polynomial> equations(const Disc& d, const ExactLine& line) {
  return {Relative(line, d.center).along(exactly(d.normal))};
}
std::vector<Polynomial> equations(const HalfPlane& h, const ExactLine& line) {
  return {Relative(line, h.position).along(exactly(h.normal))};
}
std::vector<Polynomial> equations(const Triangle& t, const ExactLine& line) {
  return {Relative(line, t.a).along(normal_of(t))};
}

// |grad| of the polynomial's function where it is 0.
double gradient(const Sphere& s, std::size_t, const IntervalVec&) {
  return 2 * s.radius;
}
double gradient(const Box&, std::size_t, const IntervalVec&) {
  return 1;
}
double gradient(const Plane& p, std::size_t, const IntervalVec&) {
  return length(exactly(p.normal)).value();
}
double gradient(const Frustum& c, std::size_t which, const IntervalVec& p) {
  const IntervalVec axis = exactly(c.to) - exactly(c.from);
  const double a = squared(axis).value();
  if (which > 0) return std::sqrt(a);
  const Interval growth = Interval(c.radius2) - Interval(c.radius);
  const Interval radius = Interval(c.radius) * squared(axis) + growth * dot(p - exactly(c.from), axis);
  const double k = growth.value();
  return 2 * a * std::abs(radius.value()) * std::sqrt(1 + k * k / a);
}
double gradient(const Cylinder& c, std::size_t which, const IntervalVec& p) {
  return gradient(frustum_of(c), which, p);
}
double gradient(const Cone& c, std::size_t which, const IntervalVec& p) {
  return gradient(frustum_of(c), which, p);
}
double gradient(const Torus& torus, std::size_t which, const IntervalVec& p) {
  if (which > 0) return infinity;
  const IntervalVec axis = exactly(torus.axis);
  const double a = squared(axis).value();
  const double from_axis = (length(cross(p - exactly(torus.center), axis)) / length(axis)).value();
  return 8 * a * torus.radius * torus.thickness * from_axis;
}
double gradient(const Disc& d, std::size_t, const IntervalVec&) {
  return length(exactly(d.normal)).value();
}
double gradient(const HalfPlane& h, std::size_t, const IntervalVec&) {
  return length(exactly(h.normal)).value();
}
double gradient(const Triangle& t, std::size_t, const IntervalVec&) {
  return length(normal_of(t)).value();
}

/// Where a line meets a surface's plane, relative to its position, times `w` (so that it is exact).
struct Meeting {
  IntervalVec point;
  Interval w;
};
Meeting meeting(const Polynomial& plane, const ExactLine& line, const Vec3& position) {
  const Relative relative(line, position);
  return {plane[1] * relative.point - plane[0] * relative.direction, plane[1]};
}

bool within_rim(const Disc& d, const Meeting& m) {
  return (squared(m.point) - square(Interval(d.radius) * m.w)).sign() <= 0;
}
bool within_rim(const HalfPlane& h, const Meeting& m) {
  return dot(exactly(h.direction), m.point).sign() * m.w.sign() >= 0;
}
bool within_rim(const Triangle& t, const Meeting& m) {
  const IntervalVec normal = normal_of(t);
  const std::array<Vec3, 3> corners = {t.a, t.b, t.c};
  for (std::size_t i = 0; i < 3; ++i) {
    const IntervalVec corner = exactly(corners[i]);
    const IntervalVec edge = exactly(corners[(i + 1) % 3]) - corner;
    const IntervalVec from_corner = m.point - m.w * (corner - exactly(t.a));
    if (dot(normal, cross(edge, from_corner)).sign() * m.w.sign() < 0) return false;
  }
  return true;
}

double reach_at(const Primitive& primitive, const IntervalVec& p) {
  return size_of(primitive) + length(p - exactly(center_of(primitive))).value();
}

template <class P>
TrueLine solve(const P& primitive, const ExactLine& line, bool anywhere) {
  TrueLine result;
  const std::vector<Polynomial> polynomials = equations(primitive, line);
  const auto approach_at = [&](const Interval& x, const std::vector<std::size_t>& causes) {
    const IntervalVec p = line.at(x);
    double approach = infinity;
    for (const std::size_t i : causes) {
      const double size = gradient(primitive, i, p);
      const double rate = std::abs(evaluate(derivative(polynomials[i]), x).value());
      if (size < infinity) approach = std::min(approach, size > 0 ? rate / size : 0.0);
    }
    return approach;
  };
  const auto crossing_at = [&](const Interval& x, bool entering, double approach) {
    return TrueCrossing{.t = x + Interval(line.shift),
                        .entering = entering,
                        .approach = approach < infinity ? approach : 0,
                        .reach = reach_at(primitive, line.at(x))};
  };
  if constexpr (is_surface<P>) {
    const Polynomial& plane = polynomials[0];
    if (plane[1].sign() == 0) return result;
    if (!anywhere && !within_rim(primitive, meeting(plane, line, position_of(primitive)))) return result;
    result.crossings.push_back(
        crossing_at(-plane[0] / plane[1], plane[1].sign() < 0, approach_at(-plane[0] / plane[1], {0})));
  } else {
    const Primitive solid = primitive;
    const auto inside = [&](const Interval& x) { return is_inside(solid, polynomials, x); };
    const std::vector<Change> places = places_of_roots(polynomials);
    for (const Change& change : changes(places, inside, result.inside_before)) {
      TrueCrossing crossing = crossing_at(change.x, change.entering, approach_at(change.x, change.causes));
      crossing.at_edge = change.causes.size() > 1;
      for (const Change& place : places) {
        const double gap = magnitude(place.x - change.x).value();
        const double approach = approach_at(place.x, place.causes);
        if (gap == 0 || gap * approach > 8 * unit_of_rounding * crossing.reach) continue;
        crossing.approach = std::min(crossing.approach, approach);
        crossing.at_edge = true;
      }
      result.crossings.push_back(std::move(crossing));
    }
  }
  return result;
}

/// For surfaces `anywhere` means within the rim or not.
TrueLine solve_any(const Primitive& primitive, const Vec3& origin, const Vec3& direction, bool anywhere) {
  return until_certain([&] {
    const ExactLine line(origin, direction, center_of(primitive));
    return std::visit([&](const auto& p) { return solve(p, line, anywhere); }, primitive);
  });
}

}  // namespace

ExactLine::ExactLine(const Vec3& origin, const Vec3& d, const Vec3& near)
    : shift(-glm::dot(origin - near, d) / glm::dot(d, d)),
      point(exactly(origin) + Interval(shift) * exactly(d)),
      direction(exactly(d)) {}

IntervalVec ExactLine::at(const Interval& x) const {
  return point + x * direction;
}

namespace {

/// Whether two polynomials have the same roots, as they are one but for a factor: known at once where
/// faces coincide, and where lines meet the edge of two planes.
bool are_proportional(const Polynomial& a, const Polynomial& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i + 1 < a.size(); ++i) {
    if (!(a[i] * b.back() - b[i] * a.back()).is_zero()) return false;
  }
  return true;
}

}  // namespace

std::vector<Change> places_of_roots(const std::vector<Polynomial>& polynomials) {
  std::vector<Change> places;
  for (std::size_t i = 0; i < polynomials.size(); ++i) {
    for (Interval& root : roots(polynomials[i])) places.push_back({std::move(root), false, {i}});
  }
  std::sort(places.begin(), places.end(),
            [](const Change& a, const Change& b) { return a.x.middle().surely_below(b.x.middle()); });
  std::vector<Change> distinct;
  for (Change& place : places) {
    if (distinct.empty() || distinct.back().x.surely_below(place.x)) {
      distinct.push_back(std::move(place));
      continue;
    }
    const bool same = are_proportional(polynomials[distinct.back().causes[0]], polynomials[place.causes[0]]);
    if (!same && Precision::bits < Precision::highest) throw Undecided{};
    distinct.back().x = hull(distinct.back().x, place.x);
    distinct.back().causes.push_back(place.causes[0]);
  }
  return distinct;
}

std::vector<Change> changes(const std::vector<Change>& places, const Membership& inside,
                            bool& inside_before) {
  const auto beyond = [](const Interval& x) { return magnitude(x) + Interval(1); };
  const Interval before =
      places.empty() ? Interval(0) : (places.front().x.lower() - beyond(places.front().x)).middle();
  bool now = inside(before);
  inside_before = now;
  std::vector<Change> result;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Interval& x = places[i].x;
    const Interval after = i + 1 == places.size()
                               ? (x.upper() + beyond(x)).middle()
                               : ((x.upper() + places[i + 1].x.lower()) / Interval(2)).middle();
    const bool next = inside(after);
    if (next == now) continue;
    now = next;
    result.push_back(places[i]);
    result.back().entering = now;
  }
  return result;
}

std::vector<Polynomial> polynomials_of(const Primitive& solid, const ExactLine& line) {
  return std::visit([&](const auto& p) { return equations(p, line); }, solid);
}

bool is_inside(const Primitive& solid, const std::vector<Polynomial>& polynomials, const Interval& x) {
  if (std::holds_alternative<Torus>(solid))
    return evaluate(polynomials[1], x).sign() < 0 || evaluate(polynomials[0], x).sign() < 0;
  return std::all_of(polynomials.begin(), polynomials.end(),
                     [&](const Polynomial& p) { return evaluate(p, x).sign() < 0; });
}

TrueLine true_crossings(const Primitive& primitive, const Vec3& origin, const Vec3& direction) {
  return solve_any(primitive, origin, direction, false);
}

TrueLine true_plane_crossings(const Primitive& surface, const Vec3& origin, const Vec3& direction) {
  return solve_any(surface, origin, direction, true);
}

}  // namespace crt::test
