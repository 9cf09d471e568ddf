#include "oracle/line_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "oracle/equations.hpp"
#include "oracle/places.hpp"

namespace crt::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Returns |grad| of the polynomial's function where it is 0.
template <class Number>
double gradient(const Sphere& s, std::size_t, const ExactLine<Number>&, const Number&) {
  return 2 * s.radius;
}
template <class Number>
double gradient(const Box&, std::size_t, const ExactLine<Number>&, const Number&) {
  return 1;
}
template <class Number>
double gradient(const Plane& p, std::size_t, const ExactLine<Number>&, const Number&) {
  return glm::length(p.normal);
}
template <class Number>
double gradient(const Frustum& c, std::size_t which, const ExactLine<Number>& line,
                const Number& x) {
  const NumberVec<Number> axis = exactly<Number>(c.to) - exactly<Number>(c.from);
  const Number a = squared(axis);
  if (which > 0) return std::sqrt(a.value());
  const Number growth = Number(c.radius2) - Number(c.radius);
  const Number height = dot(line.from(c.from), axis) + x * dot(line.direction, axis);
  const Number radius = Number(c.radius) * a + growth * height;
  const double k = growth.value();
  return 2 * a.value() * std::abs(radius.value()) * std::sqrt(1 + k * k / a.value());
}
template <class Number>
double gradient(const Cylinder& c, std::size_t which, const ExactLine<Number>&, const Number&) {
  const Vec3 axis = c.to - c.from;
  const double a = glm::dot(axis, axis);
  return which > 0 ? std::sqrt(a) : 2 * a * a * c.radius;
}
template <class Number>
double gradient(const Cone& c, std::size_t which, const ExactLine<Number>& line, const Number& x) {
  return gradient(frustum_of(c), which, line, x);
}
template <class Number>
double gradient(const Capsule& c, std::size_t which, const ExactLine<Number>&, const Number&) {
  // The caps of its cylinder are no faces.
  if (which == 1 || which == 2) return infinity;
  if (which > 2) return 2 * c.radius;
  const Vec3 axis = c.to - c.from;
  const double a = glm::dot(axis, axis);
  return 2 * a * a * c.radius;
}
template <class Number>
double gradient(const Torus& torus, std::size_t which, const ExactLine<Number>& line,
                const Number& x) {
  if (which > 0) return infinity;
  const NumberVec<Number> p = line.from(torus.center) + x * line.direction;
  const double from_axis = glm::length(rounded(cross(p, exactly<Number>(torus.axis))));
  return 8 * glm::length(torus.axis) * torus.radius * torus.thickness * from_axis;
}
template <class Number>
double gradient(const Disc& d, std::size_t, const ExactLine<Number>&, const Number&) {
  return glm::length(d.normal);
}
template <class Number>
double gradient(const HalfPlane& h, std::size_t, const ExactLine<Number>&, const Number&) {
  return glm::length(h.normal);
}
template <class Number>
double gradient(const Triangle& t, std::size_t, const ExactLine<Number>&, const Number&) {
  return glm::length(rounded(normal_of<Number>(t)));
}

template <class Number>
double gradient(const Mesh& mesh, std::size_t which, const ExactLine<Number>&, const Number&) {
  return glm::length(rounded(normal_of<Number>(triangles_of(mesh)[which])));
}

template <class Number>
double gradient(const Extrusion& extrusion, std::size_t which, const ExactLine<Number>&,
                const Number&) {
  const ArchedTriangle profile(*extrusion.profile);
  if (which < 3) return glm::length(profile.to(which) - profile.from(which));
  return which == 3 ? 2 * profile.radius : 1;
}

template <class Number>
double gradient(const Revolution& revolution, std::size_t which, const ExactLine<Number>& line,
                const Number& x) {
  const ArchedTriangle profile(*revolution.profile);
  if (which >= equations_of_sides + 2) {
    return glm::length(ends_of(revolution)[which - equations_of_sides - 2]);
  }
  const Vec3 p = rounded(line.from(Vec3(0)) + x * line.direction);
  const double rho = std::hypot(p.x, p.z);
  if (which >= equations_of_sides) {
    if (which > equations_of_sides) return infinity;
    return 8 * std::abs(profile.center.x) * profile.radius * rho;
  }
  if (which % 2 == 1) return infinity;
  const Vec3 along = profile.to(which / 2) - profile.from(which / 2);
  return 2 * std::abs(along.y) * rho * glm::length(along);
}

template <class Number>
double gradient(const WithoutOracle auto&, std::size_t, const ExactLine<Number>&, const Number&) {
  has_no_oracle();
}

template <class Number>
double gradient(const HeightField& field, std::size_t which, const ExactLine<Number>&,
                const Number&) {
  constexpr std::size_t first_top = 5;
  if (which < first_top) return 1;
  const Triangle triangle = CornerField(field).triangles()[which - first_top];
  return glm::length(rounded(normal_of<Number>(triangle)));
}

template <class Number>
double gradient(const Quadric& quadric, std::size_t, const ExactLine<Number>& line,
                const Number& x) {
  const NumberVec<Number> p = line.from(Vec3(0)) + x * line.direction;
  return 2 * glm::length(rounded(slope_at(quadric, p)));
}

template <class Number>
double gradient(const RoundedBox& b, std::size_t which, const ExactLine<Number>&, const Number&) {
  if (which < flat_equations) return 1;
  return which < 2 * flat_equations ? infinity : 2 * b.radius;
}

/// Returns where a line meets a surface's plane, relative to its position, times `w` (so that it is
/// exact).
template <class Number>
struct Meeting {
  NumberVec<Number> point;
  Number w;
};
template <class Number>
Meeting<Number> meeting(const Polynomial<Number>& plane, const ExactLine<Number>& line,
                        const Vec3& position) {
  return {plane[1] * line.from(position) - plane[0] * line.direction, plane[1]};
}

template <class Number>
bool within_rim(const Disc& d, const Meeting<Number>& m) {
  return (squared(m.point) - square(Number(d.radius) * m.w)).sign() <= 0;
}
template <class Number>
bool within_rim(const HalfPlane& h, const Meeting<Number>& m) {
  return dot(exactly<Number>(h.direction), m.point).sign() * m.w.sign() >= 0;
}
template <class Number>
bool within_rim(const Triangle& t, const Meeting<Number>& m) {
  const NumberVec<Number> normal = normal_of<Number>(t);
  const NumberVec<Number> a = exactly<Number>(t.a);
  const std::array<Vec3, 3> corners = {t.a, t.b, t.c};
  for (std::size_t i = 0; i < 3; ++i) {
    const NumberVec<Number> corner = exactly<Number>(corners[i]);
    const NumberVec<Number> edge = exactly<Number>(corners[(i + 1) % 3]) - corner;
    const NumberVec<Number> from_corner = m.point - m.w * (corner - a);
    if (dot(normal, cross(edge, from_corner)).sign() * m.w.sign() < 0) return false;
  }
  return true;
}

/// Solves for one primitive and line.
template <class Number, class P>
class Solution {
 public:
  Solution(const Primitive& any, const P& primitive, const ExactLine<Number>& line)
      : any_(any), primitive_(primitive), line_(line), equations_(equations(primitive, line)) {}

  /// Returns the crossing of a surface. `anywhere` includes points beyond the edge.
  TrueLine surface_crossing(bool anywhere) const {
    TrueLine result;
    const Polynomial<Number>& plane = equations_[0];
    if (plane[1].sign() == 0) return result;
    if (!anywhere && !within_rim(primitive_, meeting(plane, line_, position_of(primitive_))))
      return result;
    const Number x = -plane[0] / plane[1];
    result.crossings.push_back(crossing_at(x, 0, plane[1].sign() < 0, approach_at(x, 0)));
    return result;
  }

  TrueLine solid_crossings() const {
    const Places<Number> places(std::span(equations_.begin(), equations_.end()));
    TrueLine result;
    const auto inside = [&](const std::vector<int>& signs) { return is_inside(any_, signs); };
    std::optional<bool> inside_within;
    const bool before = follow(places, inside, [&](const Place<Number>& place, bool entering) {
      // A crossing beyond the largest double is none.
      const double rounded_x = place.x.value();
      if (!std::isfinite(rounded_x + line_.shift)) {
        if (rounded_x < 0) inside_within = entering;
        return;
      }
      const double own_approach = approach_at(place);
      TrueCrossing crossing =
          crossing_at(place.x, place.flips[0].polynomial, entering, own_approach);
      crossing.at_edge = place.flips.size() > 1;
      for (const Place<Number>& other : places.places()) {
        if (&other == &place) continue;
        const double gap = std::abs((other.x - place.x).value());
        const double approach = approach_at(other);
        // Within the bounds of both, the rounding of either t included, one may stand for the
        // other.
        const double bounds =
            8 * unit_of_rounding * crossing.reach * (1 / approach + 1 / own_approach) +
            2 * unit_of_rounding * std::abs(crossing.t.value());
        if (gap > bounds) continue;
        crossing.approach = std::min(crossing.approach, approach);
        crossing.at_edge = true;
      }
      result.crossings.push_back(std::move(crossing));
    });
    result.inside_before = inside_within.value_or(before);
    return result;
  }

 private:
  double approach_at(const Number& x, std::size_t which) const {
    const double size = gradient(primitive_, which, line_, x);
    if (!(size < infinity)) return infinity;
    return size > 0 ? std::abs(evaluate(derivative(equations_[which]), x).value()) / size : 0;
  }
  double approach_at(const Place<Number>& place) const {
    double approach = infinity;
    for (const auto& flip : place.flips)
      approach = std::min(approach, approach_at(place.x, flip.polynomial));
    return approach;
  }

  TrueCrossing crossing_at(const Number& x, std::size_t which, bool entering,
                           double approach) const {
    const NumberVec<Number> from_center = line_.from(center_of(any_)) + x * line_.direction;
    return {.t = t_at(x, which),
            .entering = entering,
            .approach = approach < infinity ? approach : 0,
            .at_edge = false,
            .reach = size_of(any_) + glm::length(rounded(from_center))};
  }

  /// Throws Undecided if t is not known well enough to decide its last bit.
  Ball<4> t_at(const Number& x, std::size_t which) const {
    constexpr double accuracy = 0x1p-76;
    const Ball<4> t = as_ball(x) + Ball<4>(line_.shift);
    if (t.radius() <= accuracy * std::abs(t.value())) return t;
    // The origin may be on the surface exactly, not to rounding only.
    ExactLine<Number> from_origin = line_;
    from_origin.move_to(0);
    if (t.certain_sign() == 0 && equations(primitive_, from_origin)[which][0].is_zero()) return {};
    if (!is_last_try()) throw Undecided{};
    return t.certain_sign() == 0 ? Ball<4>() : t;
  }

  const Primitive& any_;
  const P& primitive_;  ///< the primitive of question_
  const ExactLine<Number>& line_;
  Equations<Number> equations_;
};

TrueLine solve(const Question& question, FirstTry first, bool anywhere) {
  return until_certain(
      [&]<class Number>(Using<Number>) {
        const ExactLine<Number> line(question.origin, question.direction, question.to_world,
                                     center_of(question.primitive), question.around);
        return std::visit(
            [&]<class P>(const P& primitive) {
              const Solution<Number, P> solution(question.primitive, primitive, line);
              if constexpr (is_surface<P>) {
                return solution.surface_crossing(anywhere);
              } else {
                return solution.solid_crossings();
              }
            },
            question.primitive);
      },
      first);
}

}  // namespace

TrueLine true_crossings(const Question& question, FirstTry first) {
  return solve(question, first, false);
}

TrueLine true_plane_crossings(const Question& question) {
  return solve(question, FirstTry::two_doubles, true);
}

}  // namespace crt::test
