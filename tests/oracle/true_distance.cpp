// This finds how far a point is from a primitive's surface, and where primitives are, by their
// definitions.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "oracle/equations.hpp"
#include "oracle/line_oracle.hpp"

namespace crt::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Returns a number near the middle, but 0 for what may be 0.
double value_if_certain(const Interval& interval) {
  return interval.certain_sign() == 0 ? 0 : interval.value();
}

/// Returns how far a point, relative to the position, is beyond the edge.
double beyond_rim(const Disc& d, const IntervalVec& p) {
  return value_if_certain(length(p) - Interval(d.radius));
}
double beyond_rim(const HalfPlane& h, const IntervalVec& p) {
  const IntervalVec normal = exactly<Interval>(h.normal);
  const Interval across = length(cross(normal, exactly<Interval>(h.direction))) / length(normal);
  return -value_if_certain(dot(exactly<Interval>(h.direction), p) / across);
}
double beyond_rim(const Triangle& t, const IntervalVec& p) {
  const IntervalVec normal = normal_of<Interval>(t);
  const std::array<Vec3, 3> corners = {t.a, t.b, t.c};
  double result = -infinity;
  for (std::size_t i = 0; i < 3; ++i) {
    const IntervalVec corner = exactly<Interval>(corners[i]);
    const IntervalVec edge = exactly<Interval>(corners[(i + 1) % 3]) - corner;
    const Interval height = dot(normal, cross(edge, p - (corner - exactly<Interval>(t.a))));
    result = std::max(result, -value_if_certain(height / (length(normal) * length(edge))));
  }
  return result;
}

double outside(const Sphere& s, const IntervalVec& p) {
  return (length(p - exactly<Interval>(s.center)) - Interval(s.radius)).value();
}
double outside(const Box& b, const IntervalVec& p) {
  double result = -infinity;
  const IntervalVec lower = exactly<Interval>(glm::min(b.corner_a, b.corner_b));
  const IntervalVec upper = exactly<Interval>(glm::max(b.corner_a, b.corner_b));
  for (std::size_t i = 0; i < 3; ++i)
    result = std::max({result, (lower[i] - p[i]).value(), (p[i] - upper[i]).value()});
  return result;
}
double outside(const Plane& plane, const IntervalVec& p) {
  const IntervalVec normal = exactly<Interval>(plane.normal);
  return (dot(normal, p - exactly<Interval>(plane.position)) / length(normal)).value();
}
double outside(const Frustum& c, const IntervalVec& p) {
  const IntervalVec axis = exactly<Interval>(c.to) - exactly<Interval>(c.from);
  const IntervalVec w = p - exactly<Interval>(c.from);
  const Interval height = length(axis);
  const Interval h = dot(w, axis) / height;
  const Interval growth = Interval(c.radius2) - Interval(c.radius);
  const Interval radial = length(cross(w, axis)) / height;
  const Interval side = (radial - Interval(c.radius) - growth * (h / height)) * height /
                        sqrt(square(height) + square(growth));
  return std::max({side.value(), -h.value(), (h - height).value()});
}
double outside(const Cylinder& c, const IntervalVec& p) {
  return outside(frustum_of(c), p);
}
double outside(const Cone& c, const IntervalVec& p) {
  return outside(frustum_of(c), p);
}
double outside(const Capsule& c, const IntervalVec& p) {
  const IntervalVec axis = exactly<Interval>(c.to) - exactly<Interval>(c.from);
  const IntervalVec w = p - exactly<Interval>(c.from);
  const Interval h = dot(w, axis) / length(axis);
  const auto from_axis = [&] { return length(cross(w, axis)) / length(axis); };
  const Interval distance = h.value() < 0                    ? length(w)
                            : (h - length(axis)).value() > 0 ? length(p - exactly<Interval>(c.to))
                                                             : from_axis();
  return (distance - Interval(c.radius)).value();
}
double outside(const Torus& torus, const IntervalVec& p) {
  const IntervalVec axis = exactly<Interval>(torus.axis);
  const IntervalVec w = p - exactly<Interval>(torus.center);
  const Interval height = dot(w, axis) / length(axis);
  const Interval outwards = length(cross(w, axis)) / length(axis) - Interval(torus.radius);
  return (sqrt(square(outwards) + square(height)) - Interval(torus.thickness)).value();
}

double outside(const Mesh& mesh, const IntervalVec& p) {
  double farthest = -infinity;
  for (const Triangle& triangle : triangles_of(mesh)) {
    const IntervalVec normal = normal_of<Interval>(triangle);
    const Interval height = dot(p - exactly<Interval>(triangle.a), normal) / length(normal);
    farthest = std::max(farthest, height.value());
  }
  return farthest;
}

/// Returns how far a point of the plane of x and y is outside of an arched triangle.
double outside(const ArchedTriangle& profile, const IntervalVec& p) {
  double right = infinity;
  double left = infinity;
  std::array<double, 3> sides{};
  for (std::size_t side = 0; side < 3; ++side) {
    const IntervalVec normal = profile.normal<Interval>(side);
    sides[side] = (dot(p - exactly<Interval>(profile.from(side)), normal) / length(normal)).value();
    right = std::min(right, sides[side]);
    left = std::min(left, -sides[side]);
  }
  const double triangle = -std::max(right, left);
  IntervalVec from_center = p - exactly<Interval>(profile.center);
  from_center[2] = Interval(0.0);
  const double disc = (length(from_center) - Interval(profile.radius)).value();
  const double segment = std::max(disc, profile.is_right ? -sides[2] : sides[2]);
  return std::max(std::min(triangle, segment), -std::max(triangle, segment));
}
double outside(const Extrusion& extrusion, const IntervalVec& p) {
  const double aside = outside(ArchedTriangle(*extrusion.profile), p);
  const double below = (Interval(lower_end(extrusion)) - p[2]).value();
  const double above = (p[2] - Interval(upper_end(extrusion))).value();
  return std::max({aside, below, above});
}
double outside(const Revolution& revolution, const IntervalVec& p) {
  const Interval rho = sqrt(square(p[0]) + square(p[2]));
  const double aside = outside(ArchedTriangle(*revolution.profile), {rho, p[1], Interval(0.0)});
  const std::vector<Vec3> normals = ends_of(revolution);
  if (normals.empty()) return aside;
  const double first = dot(p, exactly<Interval>(normals[0])).value();
  const double last = dot(p, exactly<Interval>(normals[1])).value();
  return std::max(aside,
                  is_more_than_half(revolution) ? std::min(first, last) : std::max(first, last));
}

double outside(const WithoutOracle auto&, const IntervalVec&) {
  has_no_oracle();
}
double outside(const HeightField& field, const IntervalVec& p) {
  const CornerField corners(field);
  double beside = (Interval(corners.lower.y) - p[1]).value();
  for (const std::size_t axis : {std::size_t{0}, std::size_t{2}}) {
    const auto i = static_cast<int>(axis);
    beside = std::max({beside, (Interval(corners.lower[i]) - p[axis]).value(),
                       (p[axis] - Interval(corners.upper[i])).value()});
  }
  std::array<double, 2> above{};
  for (std::size_t i = 0; i < above.size(); ++i) {
    const Triangle triangle = corners.triangles()[i];
    const IntervalVec normal = normal_of<Interval>(triangle);
    above[i] = (dot(p - exactly<Interval>(triangle.a), normal) / length(normal)).value();
  }
  const double top =
      corners.is_ridge() ? std::max(above[0], above[1]) : std::min(above[0], above[1]);
  return std::max(beside, top);
}

/// Returns a distance that the point has at least, by the most that the gradient can change on the
/// way to the surface.
double outside(const Quadric& q, const IntervalVec& p) {
  const IntervalVec slope = slope_at(q, p);
  const Interval twice =
      dot(p, slope + exactly<Interval>(q.linear)) + Interval(2) * Interval(q.constant);
  const double sum = value_if_certain(twice) / 2;
  const double steepness = glm::length(rounded(slope));
  const double bend =
      std::sqrt(4 * glm::dot(q.squares, q.squares) + 2 * glm::dot(q.products, q.products));
  const double most = steepness + std::sqrt(steepness * steepness + 2 * bend * std::abs(sum));
  return sum == 0 ? 0 : 2 * sum / most;
}

double outside(const RoundedBox& b, const IntervalVec& p) {
  const IntervalVec lower = p - exactly<Interval>(glm::min(b.corner_a, b.corner_b));
  const IntervalVec upper = p - exactly<Interval>(glm::max(b.corner_a, b.corner_b));
  RoundedPlaces places{};
  for (std::size_t i = 0; i < 3; ++i) {
    if ((lower[i] - Interval(b.radius)).value() < 0) places[i] = -1;
    if ((upper[i] + Interval(b.radius)).value() > 0) places[i] = 1;
  }
  if (std::count(places.begin(), places.end(), 0) > 1)
    return outside(Box{.corner_a = b.corner_a, .corner_b = b.corner_b}, p);
  return (length(beyond_inner_box(b, places, lower, upper)) - Interval(b.radius)).value();
}

Vec3 middle(const Vec3& a, const Vec3& b) {
  return a / 2.0 + b / 2.0;
}

struct Ball {
  Vec3 center;
  double radius;
};
Ball ball_of(const Sphere& s) {
  return {s.center, s.radius};
}
Ball ball_of(const Box& b) {
  return {middle(b.corner_a, b.corner_b), glm::length(b.corner_a - b.corner_b) / 2};
}
Ball ball_of(const RoundedBox& b) {
  const Vec3 inner = glm::abs(b.corner_a - b.corner_b) / 2.0 - b.radius;
  return {middle(b.corner_a, b.corner_b), glm::length(inner) + b.radius};
}
Ball ball_of(const Plane& p) {
  return {p.position, 0};
}
Ball ball_of(const HalfPlane& h) {
  return {h.position, 0};
}
Ball ball_of(const Cylinder& c) {
  return {middle(c.from, c.to), std::hypot(c.radius, glm::length(c.to - c.from) / 2)};
}
Ball ball_of(const Cone& c) {
  return {middle(c.from, c.to),
          std::hypot(std::max(c.radius, c.radius2), glm::length(c.to - c.from) / 2)};
}
Ball ball_of(const Capsule& c) {
  return {middle(c.from, c.to), c.radius + glm::length(c.to - c.from) / 2};
}
Ball ball_of(const Torus& t) {
  return {t.center, t.radius + t.thickness};
}
Ball ball_of(const Disc& d) {
  return {d.center, d.radius};
}
Ball ball_of(const Triangle& t) {
  const Vec3 center = t.a / 3.0 + t.b / 3.0 + t.c / 3.0;
  return {center, std::max({glm::length(t.a - center), glm::length(t.b - center),
                            glm::length(t.c - center)})};
}
Ball ball_of(const Extrusion& extrusion) {
  core::Bounds box = extrusion.profile->bounds();
  box.lower.z = lower_end(extrusion);
  box.upper.z = upper_end(extrusion);
  // The radius of an arc counts like that of a cylinder.
  return {middle(box.lower, box.upper),
          std::max(glm::length(box.upper - box.lower) / 2, extrusion.profile->arcs()[0].radius)};
}
Ball ball_of(const Revolution& revolution) {
  const core::Bounds& box = revolution.profile->bounds();
  const Profile::Arc& arc = revolution.profile->arcs()[0];
  // The radii of a torus count, too, also where only a part of it is there.
  return {{0, middle(box.lower, box.upper).y, 0},
          std::max(std::hypot(box.upper.x, (box.upper.y - box.lower.y) / 2),
                   std::abs(arc.center.x) + arc.radius)};
}

Ball ball_of(const WithoutOracle auto&) {
  has_no_oracle();
}
Ball ball_of(const HeightField& field) {
  const Vec3 offset = field.corner_b - field.corner_a;
  return {middle(field.corner_a, field.corner_b), glm::length(offset) / 2};
}
Ball ball_of(const Quadric&) {
  return {Vec3(0), 0};
}
Ball ball_of(const Mesh& mesh) {
  const core::Bounds& box = mesh.triangles->bounds();
  return {middle(box.lower, box.upper), glm::length(box.upper - box.lower) / 2};
}

}  // namespace

double true_distance(const Question& question, double t) {
  const ExactLine<Interval> line(question.origin, question.direction, question.to_world,
                                 center_of(question.primitive));
  return std::visit(
      [&]<class P>(const P& p) {
        if constexpr (is_surface<P>) {
          const Polynomial<Interval> plane = equations(p, line)[0];
          if (plane[1].certain_sign() == 0) return plane[0].certain_sign() == 0 ? 0.0 : infinity;
          const Interval x = -plane[0] / plane[1];
          return beyond_rim(p, line.from(position_of(p)) + x * line.direction);
        } else {
          return outside(p, line.at(Interval(t) - Interval(line.shift)));
        }
      },
      question.primitive);
}

PointAndSpeed point_and_speed(const Question& question, double t) {
  const ExactLine<Interval> line(question.origin, question.direction, question.to_world, Vec3(0));
  return {rounded(line.at(Interval(t) - Interval(line.shift))),
          glm::length(rounded(line.direction))};
}

Vec3 center_of(const Primitive& primitive) {
  return std::visit([](const auto& p) { return ball_of(p).center; }, primitive);
}

double size_of(const Primitive& primitive) {
  return std::visit([](const auto& p) { return ball_of(p).radius; }, primitive);
}

}  // namespace crt::test
