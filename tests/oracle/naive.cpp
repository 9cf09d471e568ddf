#include "oracle/naive.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "geometry/height_fields.hpp"
#include "oracle/number_vec.hpp"
#include "oracle/rounded_box.hpp"
#include "oracle/without_oracle.hpp"

namespace crt::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A Span is what of a line is between two parameters.
struct Span {
  double enter = -infinity;
  double leave = infinity;

  void cut(double a, double b) {
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
};

bool emit(const Span& span, core::CrossingList& out) {
  if (!(span.enter < span.leave)) return false;
  if (span.enter > -infinity) out.push_back({.t = span.enter, .entering = true});
  if (span.leave < infinity) out.push_back({.t = span.leave, .entering = false});
  return span.enter == -infinity;
}

bool meet(const Sphere& s, const Vec3& o, const Vec3& d, core::CrossingList& out) {
  const Vec3 f = o - s.center;
  const double a = glm::dot(d, d);
  const double b = 2 * glm::dot(f, d);
  const double c = glm::dot(f, f) - s.radius * s.radius;
  const double discriminant = b * b - 4 * a * c;
  if (discriminant <= 0) return false;
  const double root = std::sqrt(discriminant);
  return emit({(-b - root) / (2 * a), (-b + root) / (2 * a)}, out);
}

bool meet(const Box& box, const Vec3& o, const Vec3& d, core::CrossingList& out) {
  Span span;
  for (int axis = 0; axis < 3; ++axis) {
    const double inverse = 1 / d[axis];
    span.cut((box.corner_a[axis] - o[axis]) * inverse, (box.corner_b[axis] - o[axis]) * inverse);
  }
  return emit(span, out);
}

double plane_t(const Vec3& normal, const Vec3& position, const Vec3& o, const Vec3& d) {
  return glm::dot(normal, position - o) / glm::dot(normal, d);
}

void emit_surface(const Vec3& normal, const Vec3& d, double t, core::CrossingList& out) {
  if (std::isfinite(t)) out.push_back({.t = t, .entering = glm::dot(normal, d) < 0});
}

bool meet(const Plane& p, const Vec3& o, const Vec3& d, core::CrossingList& out) {
  const double rate = glm::dot(p.normal, d);
  if (rate == 0) return glm::dot(p.normal, o - p.position) < 0;
  emit_surface(p.normal, d, plane_t(p.normal, p.position, o, d), out);
  return rate > 0;
}

bool meet(const HalfPlane& h, const Vec3& o, const Vec3& d, core::CrossingList& out) {
  const double t = plane_t(h.normal, h.position, o, d);
  if (glm::dot(o + t * d - h.position, h.direction) >= 0) emit_surface(h.normal, d, t, out);
  return false;
}

bool meet(const Disc& disc, const Vec3& o, const Vec3& d, core::CrossingList& out) {
  const double t = plane_t(disc.normal, disc.center, o, d);
  if (glm::length(o + t * d - disc.center) <= disc.radius) emit_surface(disc.normal, d, t, out);
  return false;
}

/// Intersects as in Moeller, Trumbore, Fast, minimum storage ray/triangle intersection, 1997.
bool meet(const Triangle& triangle, const Vec3& o, const Vec3& d, core::CrossingList& out) {
  const Vec3 ab = triangle.b - triangle.a;
  const Vec3 ac = triangle.c - triangle.a;
  const Vec3 p = glm::cross(d, ac);
  const double determinant = glm::dot(ab, p);
  const Vec3 from_a = o - triangle.a;
  const double u = glm::dot(from_a, p) / determinant;
  const Vec3 q = glm::cross(from_a, ab);
  const double v = glm::dot(d, q) / determinant;
  if (u >= 0 && v >= 0 && u + v <= 1)
    emit_surface(glm::cross(ab, ac), d, glm::dot(ac, q) / determinant, out);
  return false;
}

/// Intersects each triangle by itself.
bool meet(const Mesh& mesh, const Vec3& o, const Vec3& d, core::CrossingList& out) {
  for (const Triangle& triangle : triangles_of(mesh)) meet(triangle, o, d, out);
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
  return false;
}

bool meet(const WithoutOracle auto&, const Vec3&, const Vec3&, core::CrossingList&) {
  has_no_oracle();
}

bool meet(const HeightField& field, const Vec3& o, const Vec3& d, core::CrossingList& out) {
  const TriangleList list = mesh_of(field);
  for (const auto& [a, b, c] : list.triangles) {
    meet(Triangle{.a = list.positions[a], .b = list.positions[b], .c = list.positions[c]}, o, d,
         out);
  }
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
  return false;
}

/// Looks at what is between all places where the line meets a surface.
bool meet(const Extrusion& extrusion, const Vec3& o, const Vec3& d, core::CrossingList& out) {
  const ArchedTriangle profile(*extrusion.profile);
  std::vector<double> places = {(lower_end(extrusion) - o.z) / d.z,
                                (upper_end(extrusion) - o.z) / d.z};
  for (std::size_t side = 0; side < 3; ++side) {
    const Vec3 along = profile.to(side) - profile.from(side);
    places.push_back(plane_t({along.y, -along.x, 0}, profile.from(side), o, d));
  }
  const Vec3 f = o - profile.center;
  const double a = d.x * d.x + d.y * d.y;
  const double b = 2 * (f.x * d.x + f.y * d.y);
  const double c = f.x * f.x + f.y * f.y - profile.radius * profile.radius;
  const double discriminant = b * b - 4 * a * c;
  if (discriminant > 0) {
    places.push_back((-b - std::sqrt(discriminant)) / (2 * a));
    places.push_back((-b + std::sqrt(discriminant)) / (2 * a));
  }
  std::erase_if(places, [](double t) { return !std::isfinite(t); });
  std::sort(places.begin(), places.end());
  const auto is_inside = [&](double t) {
    const Vec3 p = o + t * d;
    std::array<bool, 3> right{};
    for (std::size_t side = 0; side < 3; ++side) {
      right[side] = glm::cross(profile.to(side) - profile.from(side), p - profile.from(side)).z < 0;
    }
    const Vec3 g = p - profile.center;
    const bool in_disc = g.x * g.x + g.y * g.y < profile.radius * profile.radius;
    const bool in_triangle = right[0] == right[1] && right[1] == right[2];
    return in_triangle != (in_disc && right[2] == profile.is_right) && p.z > lower_end(extrusion) &&
           p.z < upper_end(extrusion);
  };
  bool inside = false;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool after = i + 1 < places.size() && is_inside((places[i] + places[i + 1]) / 2);
    if (after != inside) out.push_back({.t = places[i], .entering = after});
    inside = after;
  }
  return false;
}

/// Solves the quadratic of the side with a unit axis, and intersects with the caps as slabs.
bool meet_frustum(const Vec3& from, const Vec3& to, double radius, double radius2, const Vec3& o,
                  const Vec3& d, core::CrossingList& out) {
  const double height = glm::length(to - from);
  const Vec3 w = (to - from) / height;
  const double k = (radius2 - radius) / height;
  const Vec3 f = o - from;
  const double fw = glm::dot(f, w);
  const double dw = glm::dot(d, w);
  const double r = radius + k * fw;
  const double a = glm::dot(d, d) - dw * dw - k * k * dw * dw;
  const double b = 2 * (glm::dot(f, d) - fw * dw - k * dw * r);
  const double c = glm::dot(f, f) - fw * fw - r * r;
  const double discriminant = b * b - 4 * a * c;
  Span span;
  span.cut(-fw / dw, (height - fw) / dw);
  if (discriminant < 0) {
    if (a >= 0) return false;
    return emit(span, out);
  }
  const double root = std::sqrt(discriminant);
  const double first = (-b - root) / (2 * a);
  const double second = (-b + root) / (2 * a);
  if (a > 0) {
    span.cut(first, second);
  } else if (dw * k > 0) {
    span.enter = std::max(span.enter, std::max(first, second));
  } else {
    span.leave = std::min(span.leave, std::min(first, second));
  }
  return emit(span, out);
}
bool meet(const Cylinder& c, const Vec3& o, const Vec3& d, core::CrossingList& out) {
  return meet_frustum(c.from, c.to, c.radius, c.radius, o, d, out);
}
bool meet(const Cone& c, const Vec3& o, const Vec3& d, core::CrossingList& out) {
  return meet_frustum(c.from, c.to, c.radius, c.radius2, o, d, out);
}

/// Unites the spans of a cylinder and of the spheres about its ends.
bool meet(const Capsule& c, const Vec3& o, const Vec3& d, core::CrossingList& out) {
  core::CrossingList all;
  meet(Cylinder{.from = c.from, .to = c.to, .radius = c.radius}, o, d, all);
  meet(Sphere{.center = c.from, .radius = c.radius}, o, d, all);
  meet(Sphere{.center = c.to, .radius = c.radius}, o, d, all);
  Span span{.enter = infinity, .leave = -infinity};
  for (const core::Crossing& crossing : all) {
    span.enter = std::min(span.enter, crossing.t);
    span.leave = std::max(span.leave, crossing.t);
  }
  return emit(span, out);
}

/// Unites the spans of three boxes, of cylinders along the edges and of spheres at the corners.
bool meet(const RoundedBox& b, const Vec3& o, const Vec3& d, core::CrossingList& out) {
  core::CrossingList all;
  const Vec3 lower = glm::min(b.corner_a, b.corner_b) + b.radius;
  const Vec3 upper = glm::max(b.corner_a, b.corner_b) - b.radius;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 wider(0);
    wider[axis] = b.radius;
    meet(Box{.corner_a = lower - wider, .corner_b = upper + wider}, o, d, all);
  }
  for (const RoundedPlaces& places : round_places()) {
    Vec3 from;
    Vec3 to;
    for (int i = 0; i < 3; ++i) {
      const int place = places[static_cast<std::size_t>(i)];
      from[i] = place > 0 ? upper[i] : lower[i];
      to[i] = place < 0 ? lower[i] : upper[i];
    }
    if (from == to) {
      meet(Sphere{.center = from, .radius = b.radius}, o, d, all);
    } else {
      meet_frustum(from, to, b.radius, b.radius, o, d, all);
    }
  }
  Span span{.enter = infinity, .leave = -infinity};
  for (const core::Crossing& crossing : all) {
    span.enter = std::min(span.enter, crossing.t);
    span.leave = std::max(span.leave, crossing.t);
  }
  return emit(span, out);
}

bool meet(const Quadric& q, const Vec3& o, const Vec3& d, core::CrossingList& out) {
  const auto mixed = [](const Vec3& v) { return Vec3(v.x * v.y, v.x * v.z, v.y * v.z); };
  const Vec3 crossed(o.x * d.y + o.y * d.x, o.x * d.z + o.z * d.x, o.y * d.z + o.z * d.y);
  const double a = glm::dot(q.squares, d * d) + glm::dot(q.products, mixed(d));
  const double b =
      2 * glm::dot(q.squares, o * d) + glm::dot(q.products, crossed) + glm::dot(q.linear, d);
  const double c = glm::dot(q.squares, o * o) + glm::dot(q.products, mixed(o)) +
                   glm::dot(q.linear, o) + q.constant;
  if (a == 0) {
    if (b == 0) return c < 0;
    out.push_back({.t = -c / b, .entering = b < 0});
    return b > 0;
  }
  const double discriminant = b * b - 4 * a * c;
  if (discriminant <= 0) return a < 0;
  const double root = std::sqrt(discriminant);
  const double first = (-b - root) / (2 * a);
  const double second = (-b + root) / (2 * a);
  out.push_back({.t = std::min(first, second), .entering = a > 0});
  out.push_back({.t = std::max(first, second), .entering = a < 0});
  return a < 0;
}

using Complex = std::complex<double>;

/// Returns the roots of x^4 + b x^3 + c x^2 + d x + e by Ferrari's formula.
std::array<Complex, 4> quartic_roots(double b, double c, double d, double e) {
  const double p = c - 3 * b * b / 8;
  const double q = b * b * b / 8 - b * c / 2 + d;
  const double r = -3 * b * b * b * b / 256 + b * b * c / 16 - b * d / 4 + e;
  const Complex u = -p * p / 12 - r;
  const Complex v = -p * p * p / 108 + p * r / 3 - q * q / 8;
  const Complex w = std::pow(-v / 2.0 + std::sqrt(v * v / 4.0 + u * u * u / 27.0), 1.0 / 3);
  const Complex y = -5 * p / 6 + (std::abs(w) > 0 ? w - u / (3.0 * w) : -std::pow(v, 1.0 / 3));
  const Complex z = std::sqrt(p + 2.0 * y);
  const Complex plus = std::sqrt(-(3 * p + 2.0 * y + 2 * q / z));
  const Complex minus = std::sqrt(-(3 * p + 2.0 * y - 2 * q / z));
  return {-b / 4 + (z + plus) / 2.0, -b / 4 + (z - plus) / 2.0, -b / 4 + (-z + minus) / 2.0,
          -b / 4 + (-z - minus) / 2.0};
}

bool meet(const Torus& torus, const Vec3& o, const Vec3& d, core::CrossingList& out) {
  const double speed = glm::length(d);
  const Vec3 v = d / speed;
  const Vec3 w = glm::normalize(torus.axis);
  const Vec3 f = o - torus.center;
  const double ring = torus.radius * torus.radius;
  const double fd = glm::dot(f, v);
  const double fw = glm::dot(f, w);
  const double vw = glm::dot(v, w);
  const double k = glm::dot(f, f) + ring - torus.thickness * torus.thickness;
  const auto all = quartic_roots(4 * fd, 4 * fd * fd + 2 * k - 4 * ring * (1 - vw * vw),
                                 4 * fd * k - 8 * ring * (fd - fw * vw),
                                 k * k - 4 * ring * (glm::dot(f, f) - fw * fw));
  constexpr double real = 1e-6;
  std::array<double, 4> t{};
  t.fill(infinity);
  std::size_t count = 0;
  for (const Complex& root : all) {
    if (std::abs(root.imag()) < real * torus.radius && std::isfinite(root.real()))
      t[count++] = root.real() / speed;
  }
  if (count == 3) count = 2;
  std::sort(t.begin(), t.end());
  // The inner lemon of a spindle is no boundary.
  if (torus.thickness > torus.radius && count == 4) {
    t[1] = t[3];
    count = 2;
  }
  for (std::size_t i = 0; i + 1 < count; i += 2) {
    if (!(t[i] < t[i + 1])) continue;
    out.push_back({.t = t[i], .entering = true});
    out.push_back({.t = t[i + 1], .entering = false});
  }
  return false;
}

/// Looks at what is between all places where the line meets a surface.
bool meet(const Revolution& revolution, const Vec3& o, const Vec3& d, core::CrossingList& out) {
  const ArchedTriangle profile(*revolution.profile);
  const std::vector<Vec3> normals = ends_of(revolution);
  std::vector<double> places;
  for (const Vec3& normal : normals) places.push_back(plane_t(normal, Vec3(0), o, d));
  for (std::size_t side = 0; side < 3; ++side) {
    const Vec3& from = profile.from(side);
    const Vec3 along = profile.to(side) - from;
    const double u = along.x * (o.y - from.y) + along.y * from.x;
    const double rate = along.x * d.y;
    const double squared = along.y * along.y;
    const double a = squared * (d.x * d.x + d.z * d.z) - rate * rate;
    const double b = squared * (o.x * d.x + o.z * d.z) - u * rate;
    const double c = squared * (o.x * o.x + o.z * o.z) - u * u;
    const double root = std::sqrt(b * b - a * c);
    places.push_back((-b - root) / a);
    places.push_back((-b + root) / a);
  }
  const double speed = glm::length(d);
  const Vec3 v = d / speed;
  const Vec3 f = o - Vec3(0, profile.center.y, 0);
  const double ring = profile.center.x * profile.center.x;
  const double fd = glm::dot(f, v);
  const double k = glm::dot(f, f) + ring - profile.radius * profile.radius;
  const auto all = quartic_roots(4 * fd, 4 * fd * fd + 2 * k - 4 * ring * (1 - v.y * v.y),
                                 4 * fd * k - 8 * ring * (fd - f.y * v.y),
                                 k * k - 4 * ring * (glm::dot(f, f) - f.y * f.y));
  for (const Complex& root : all) places.push_back(root.real() / speed);
  std::erase_if(places, [](double t) { return !std::isfinite(t); });
  std::sort(places.begin(), places.end());
  const auto is_inside = [&](double t) {
    const Vec3 point = o + t * d;
    const Vec3 p(std::hypot(point.x, point.z), point.y, 0);
    std::array<bool, 3> right{};
    for (std::size_t side = 0; side < 3; ++side) {
      right[side] = glm::cross(profile.to(side) - profile.from(side), p - profile.from(side)).z < 0;
    }
    const bool in_disc = glm::length(p - profile.center) < profile.radius;
    const bool in_triangle = right[0] == right[1] && right[1] == right[2];
    if (in_triangle == (in_disc && right[2] == profile.is_right)) return false;
    const auto is_behind = [&](const Vec3& normal) { return glm::dot(normal, point) < 0; };
    return is_more_than_half(revolution)
               ? normals.empty() || std::any_of(normals.begin(), normals.end(), is_behind)
               : std::all_of(normals.begin(), normals.end(), is_behind);
  };
  bool inside = false;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool after = i + 1 < places.size() && is_inside((places[i] + places[i + 1]) / 2);
    if (after != inside) out.push_back({.t = places[i], .entering = after});
    inside = after;
  }
  return false;
}

}  // namespace

bool naive_crossings(const Primitive& primitive, const Vec3& origin, const Vec3& direction,
                     core::CrossingList& out) {
  return std::visit([&](const auto& p) { return meet(p, origin, direction, out); }, primitive);
}

}  // namespace crt::test
