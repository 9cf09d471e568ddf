#include "oracle/spots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "oracle/number_vec.hpp"
#include "oracle/quadric_spots.hpp"
#include "oracle/rounded_spots.hpp"
namespace crt::test {

Frame across(const Vec3& v) {
  const Vec3 n = glm::normalize(v);
  const Vec3 other = std::abs(n.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 a = glm::normalize(glm::cross(n, other));
  return {a, glm::cross(n, a)};
}
Vec3 around(const Frame& frame, double angle) {
  return std::cos(angle) * frame.a + std::sin(angle) * frame.b;
}
double angle(Counted& random) {
  return random.uniform(0, 2 * std::numbers::pi);
}

namespace {

// Each primitive has make() for one of a size at a place, a random spot() on its surface, and a
// random point of an edge().

void make(Counted& random, const Vec3& at, double size, Sphere& s) {
  s.center = at;
  s.radius = size * random.uniform(0.5, 1);
}
Spot spot(Counted& random, const Sphere& s) {
  const Vec3 n = random.direction();
  return {s.center + s.radius * n, n, random.direction()};
}
Vec3 edge(Counted& random, const Sphere& s) {
  Vec3 pole(0);
  pole[random.integer(0, 2)] = s.radius * random.sign();
  return s.center + pole;
}

void make(Counted& random, const Vec3& at, double size, Box& b) {
  b.corner_a = at;
  b.corner_b =
      at + size * Vec3(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1));
}
Spot spot(Counted& random, const Box& b) {
  Vec3 p;
  for (int i = 0; i < 3; ++i) p[i] = random.uniform(b.corner_a[i], b.corner_b[i]);
  const int axis = random.integer(0, 2);
  Vec3 n(0);
  n[axis] = random.sign();
  p[axis] = n[axis] > 0 ? std::max(b.corner_a[axis], b.corner_b[axis])
                        : std::min(b.corner_a[axis], b.corner_b[axis]);
  return {p, n, around(across(n), angle(random))};
}
Vec3 edge(Counted& random, const Box& b) {
  Vec3 p = spot(random, b).point;
  const bool corner = random.integer(0, 1) == 0;
  const int along = random.integer(0, 2);
  for (int i = 0; i < 3; ++i) {
    if (corner || i != along) p[i] = random.integer(0, 1) == 0 ? b.corner_a[i] : b.corner_b[i];
  }
  return p;
}

void make(Counted& random, const Vec3& at, double size, Plane& p) {
  p.normal = random.direction() * random.uniform(0.5, 2);
  p.position = at + size * random.in_cube();
}
Spot spot(Counted& random, const Plane& p) {
  const Frame frame = across(p.normal);
  const double reach = std::max(1e-9, glm::length(p.position) * 1e-3);
  const Vec3 along = around(frame, angle(random));
  return {p.position + reach * random.uniform(0, 1) * along, glm::normalize(p.normal), along};
}
Vec3 edge(Counted&, const Plane& p) {
  return p.position;
}

void make(Counted& random, const Vec3& at, double size, HalfPlane& h) {
  h.normal = random.direction() * random.uniform(0.5, 2);
  h.position = at + size * random.in_cube();
  h.direction = random.direction() + 1e-3 * random.in_cube();
}
Spot spot(Counted& random, const HalfPlane& h) {
  const Spot on_plane = spot(random, Plane{.normal = h.normal, .position = h.position});
  const double side = glm::dot(on_plane.point - h.position, h.direction);
  if (side >= 0) return on_plane;
  return {h.position - (on_plane.point - h.position), on_plane.normal, on_plane.parallel};
}
Vec3 edge(Counted& random, const HalfPlane& h) {
  const Vec3 along = glm::cross(h.normal, h.direction);
  return h.position + (random.integer(0, 1) == 0 ? 0.0 : 1e-3 * glm::length(h.position)) * along;
}

void make(Counted& random, const Vec3& at, double size, Cylinder& c) {
  c.from = at;
  c.to = at + size * random.uniform(0.05, 1) * random.direction();
  c.radius = size * random.uniform(0.05, 1);
}
Spot on_frustum(Counted& random, const Vec3& from, const Vec3& to, double r1, double r2) {
  const Vec3 axis = to - from;
  const Vec3 out = around(across(axis), angle(random));
  const double height = glm::length(axis);
  const Vec3 w = axis / height;
  if (random.integer(0, 2) == 0)
    return {from + r1 * std::sqrt(random.uniform(0, 1)) * out, -w, out};
  const double share = random.uniform(0, 1);
  const Vec3 normal = glm::normalize(height * out + (r1 - r2) * w);
  const Vec3 ruling = glm::normalize(axis + (r2 - r1) * out);
  return {from + share * axis + (r1 + (r2 - r1) * share) * out, normal,
          random.integer(0, 1) == 0 ? w : ruling};
}
Vec3 frustum_edge(Counted& random, const Vec3& from, const Vec3& to, double r1, double r2) {
  const Vec3 out = around(across(to - from), angle(random));
  return random.integer(0, 1) == 0 ? from + r1 * out : to + r2 * out;
}
Spot spot(Counted& random, const Cylinder& c) {
  return on_frustum(random, c.from, c.to, c.radius, c.radius);
}
Vec3 edge(Counted& random, const Cylinder& c) {
  return frustum_edge(random, c.from, c.to, c.radius, c.radius);
}

void make(Counted& random, const Vec3& at, double size, Cone& c) {
  c.from = at;
  c.to = at + size * random.uniform(0.05, 1) * random.direction();
  c.radius = size * random.uniform(0.05, 1);
  c.radius2 = random.integer(0, 1) == 0 ? 0 : size * random.uniform(0.05, 1);
}
Spot spot(Counted& random, const Cone& c) {
  return on_frustum(random, c.from, c.to, c.radius, c.radius2);
}
Vec3 edge(Counted& random, const Cone& c) {
  return frustum_edge(random, c.from, c.to, c.radius, c.radius2);
}

void make(Counted& random, const Vec3& at, double size, Capsule& c) {
  c.from = at;
  c.to = at + size * random.uniform(0.05, 1) * random.direction();
  c.radius = size * random.uniform(0.05, 1);
}
/// Returns a spot on the side or on a half sphere.
Spot spot(Counted& random, const Capsule& c) {
  const Vec3 axis = c.to - c.from;
  const Vec3 w = glm::normalize(axis);
  const int part = random.integer(0, 2);
  if (part == 0) {
    const Vec3 out = around(across(axis), angle(random));
    return {c.from + random.uniform(0, 1) * axis + c.radius * out, out, w};
  }
  const Vec3 outwards = part == 1 ? -w : w;
  Vec3 n = random.direction();
  if (glm::dot(n, outwards) < 0) n = -n;
  return {(part == 1 ? c.from : c.to) + c.radius * n, n, w};
}
/// Returns a point of a seam, or a tip.
Vec3 edge(Counted& random, const Capsule& c) {
  const Vec3 on_seam = frustum_edge(random, c.from, c.to, c.radius, c.radius);
  if (random.integer(0, 3) != 0) return on_seam;
  return c.to + c.radius * glm::normalize(c.to - c.from);
}

void make(Counted& random, const Vec3& at, double size, Torus& t) {
  t.center = at;
  t.axis = random.direction() * random.uniform(0.5, 2);
  t.radius = size * random.uniform(0.1, 1);
  const int form = random.integer(0, 9);  // a ring mostly, now and then a horn or a spindle
  t.thickness = form == 0
                    ? t.radius
                    : t.radius * (form < 3 ? random.uniform(1, 3) : random.uniform(0.05, 0.95));
}
Spot spot(Counted& random, const Torus& t) {
  const Vec3 w = glm::normalize(t.axis);
  const Frame frame = across(t.axis);
  const double turn = angle(random);
  const Vec3 out = around(frame, turn);
  // For a spindle only the outside of the lemon counts.
  double tube = angle(random);
  while (t.radius + t.thickness * std::cos(tube) < 0) tube = angle(random);
  const Vec3 n = std::cos(tube) * out + std::sin(tube) * w;
  const Vec3 ring = around(frame, turn + std::numbers::pi / 2);
  return {t.center + t.radius * out + t.thickness * n, n, random.integer(0, 1) == 0 ? w : ring};
}
Vec3 edge(Counted& random, const Torus& t) {
  const Vec3 out = around(across(t.axis), angle(random));
  const Vec3 w = glm::normalize(t.axis);
  switch (random.integer(0, 2)) {
    case 0:
      return t.center + (t.radius - t.thickness) * out;
    case 1:
      return t.center + t.radius * out + t.thickness * random.sign() * w;
    default:
      return t.center;
  }
}

void make(Counted& random, const Vec3& at, double size, Disc& d) {
  d.center = at;
  d.normal = random.direction() * random.uniform(0.5, 2);
  d.radius = size * random.uniform(0.5, 1);
}
Spot spot(Counted& random, const Disc& d) {
  const Vec3 out = around(across(d.normal), angle(random));
  const double share = std::sqrt(random.uniform(0, 1));
  return {d.center + d.radius * share * out, glm::normalize(d.normal),
          around(across(d.normal), angle(random))};
}
Vec3 edge(Counted& random, const Disc& d) {
  return d.center + d.radius * around(across(d.normal), angle(random));
}

void make(Counted& random, const Vec3& at, double size, Triangle& t) {
  t.a = at + size * random.in_cube();
  t.b = at + size * random.in_cube();
  t.c = at + size * random.in_cube();
}
Spot spot(Counted& random, const Triangle& t) {
  double v = random.uniform(0, 1);
  double w = random.uniform(0, 1);
  if (v + w > 1) {
    v = 1 - v;
    w = 1 - w;
  }
  const Vec3 ab = t.b - t.a;
  const Vec3 ac = t.c - t.a;
  return {t.a + v * ab + w * ac, glm::normalize(glm::cross(ab, ac)),
          glm::normalize(random.integer(0, 1) == 0 ? ab : ac)};
}
Vec3 edge(Counted& random, const Triangle& t) {
  const std::array<Vec3, 3> corners = {t.a, t.b, t.c};
  const auto i = static_cast<std::size_t>(random.integer(0, 2));
  if (random.integer(0, 1) == 0) return corners[i];
  return corners[i] + random.uniform(0, 1) * (corners[(i + 1) % 3] - corners[i]);
}

void make(Counted& random, const Vec3& at, double size, Mesh& mesh) {
  std::array<Vec3, 4> offsets{};
  for (Vec3& offset : offsets) offset = size * random.in_cube();
  std::array<Vec3, 4> corners{};
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = at + offsets[i];
  // A size that is all but lost in the place makes no tetrahedron there.
  double largest_place = 0;
  for (int axis = 0; axis < 3; ++axis) largest_place = std::max(largest_place, std::abs(at[axis]));
  constexpr double few_digits = 1e-12;
  if (size > few_digits * largest_place) mesh = tetrahedron(corners);
  if (mesh.triangles == nullptr) mesh = tetrahedron(offsets);
}
Triangle any_triangle(Counted& random, const Mesh& mesh) {
  return triangles_of(mesh)[static_cast<std::size_t>(random.integer(0, 3))];
}
Spot spot(Counted& random, const Mesh& mesh) {
  return spot(random, any_triangle(random, mesh));
}
Vec3 edge(Counted& random, const Mesh& mesh) {
  return edge(random, any_triangle(random, mesh));
}

void make(Counted&, const Vec3&, double, WithoutOracle auto&) {
  has_no_oracle();
}
Spot spot(Counted&, const WithoutOracle auto&) {
  has_no_oracle();
}
Vec3 edge(Counted&, const WithoutOracle auto&) {
  has_no_oracle();
}

void make(Counted& random, const Vec3& at, double size, HeightField& field) {
  std::vector<double> heights(4);
  for (double& height : heights) height = random.uniform(0, 1);
  // Some heights are at the bottom or at the top.
  heights[static_cast<std::size_t>(random.integer(0, 3))] = random.integer(0, 2) * 0.5;
  field.heights = make_height_grid(heights, 2, 2);
  Box box;
  make(random, at, size, box);
  field.corner_a = box.corner_a;
  field.corner_b = box.corner_b;
}
/// Returns a spot on top, on the bottom or below an edge of the top.
Spot spot(Counted& random, const HeightField& field) {
  const CornerField corners(field);
  const auto which = static_cast<std::size_t>(random.integer(0, 6));
  if (which < 2) return spot(random, corners.triangles()[which]);
  Spot result = spot(random, Box{.corner_a = corners.lower, .corner_b = corners.upper});
  const double share = random.uniform(0, 1);
  if (which == 2) {
    result.point.y = corners.lower.y;
    result.normal = Vec3(0, 1, 0);
    result.parallel = glm::normalize(Vec3(random.sign(), 0, random.sign()));
    return result;
  }
  const Vec3& from = corners.tops[which - 3];
  const Vec3& to = corners.tops[(which - 2) % 4];
  result.point = from + share * (to - from);
  result.point.y = corners.lower.y + random.uniform(0, 1) * (result.point.y - corners.lower.y);
  result.normal = from.x == to.x ? Vec3(1, 0, 0) : Vec3(0, 0, 1);
  result.parallel = Vec3(0, 1, 0);
  return result;
}
/// Returns a point of an edge or a corner, on top or on the bottom.
Vec3 edge(Counted& random, const HeightField& field) {
  const CornerField corners(field);
  const auto first = static_cast<std::size_t>(random.integer(0, 3));
  const auto second = (first + static_cast<std::size_t>(random.integer(0, 2))) % 4;
  const Vec3& from = corners.tops[first];
  const Vec3& to = corners.tops[second];
  Vec3 point = from + random.uniform(0, 1) * (to - from);
  if (random.integer(0, 2) == 0) point.y = corners.lower.y;
  return point;
}

void make(Counted& random, const Vec3& at, double size, Extrusion& extrusion) {
  std::array<Vec3, 3> offsets{};
  for (Vec3& offset : offsets) offset = size * random.in_cube();
  std::array<Vec3, 3> corners{};
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = at + offsets[i];
  const double bulge = random.sign() * random.uniform(0.3, 1.2);
  extrusion.profile = arched_triangle(corners, bulge);
  if (extrusion.profile == nullptr) extrusion.profile = arched_triangle(offsets, bulge);
  extrusion.from = at.z;
  extrusion.to = at.z + size * random.uniform(0.05, 1);
}
/// Returns a random height between the ends.
double height(Counted& random, const Extrusion& extrusion) {
  return extrusion.from + random.uniform(0, 1) * (extrusion.to - extrusion.from);
}
/// Returns a spot in the plane of a profile, on one of its three walls.
Spot flat_spot(const ArchedTriangle& profile, std::size_t side, double share) {
  const Vec3 up(0, 0, 1);
  const Vec3 along = profile.to(side) - profile.from(side);
  const Vec3 point = profile.from(side) + share * along;
  if (side < 2) return {point, glm::normalize(glm::cross(along, up)), glm::normalize(along)};
  Vec3 out = glm::normalize(point - profile.center);
  const bool is_right = glm::dot(out, glm::cross(along, up)) > 0;
  if (is_right != profile.is_right) out = -out;
  return {profile.center + profile.radius * out, out, glm::cross(out, up)};
}
/// Returns a spot on one of the three walls, or on an end.
Spot spot(Counted& random, const Extrusion& extrusion) {
  const ArchedTriangle profile(*extrusion.profile);
  const auto side = static_cast<std::size_t>(random.integer(0, 3));
  const double share = random.uniform(0, 1);
  const Vec3 up(0, 0, 1);
  const auto lifted = [](Vec3 point, double z) {
    point.z = z;
    return point;
  };
  if (side == 3) {
    const Vec3 within = profile.corners[0] + share * (profile.corners[1] - profile.corners[0]);
    const Vec3 point = within + random.uniform(0, 1) * (profile.corners[2] - within);
    return {lifted(point, random.integer(0, 1) == 0 ? extrusion.from : extrusion.to), up,
            glm::normalize(profile.corners[1] - profile.corners[0])};
  }
  const Spot on_side = flat_spot(profile, side, share);
  if (side < 2) {
    return {lifted(on_side.point, height(random, extrusion)), on_side.normal,
            random.integer(0, 1) == 0 ? up : on_side.parallel};
  }
  return {lifted(on_side.point, height(random, extrusion)), on_side.normal, up};
}
/// Returns a point of an edge between two walls, or of one between a wall and an end.
Vec3 edge(Counted& random, const Extrusion& extrusion) {
  Vec3 point =
      ArchedTriangle(*extrusion.profile).corners[static_cast<std::size_t>(random.integer(0, 2))];
  point.z = height(random, extrusion);
  if (random.integer(0, 1) == 0) return point;
  point = spot(random, extrusion).point;
  point.z = random.integer(0, 1) == 0 ? extrusion.from : extrusion.to;
  return point;
}

void make(Counted& random, const Vec3& at, double size, Revolution& revolution) {
  std::array<Vec3, 3> offsets{};
  for (Vec3& offset : offsets) offset = size * random.in_cube();
  // One corner in eight is on the axis.
  const double ring = random.integer(0, 2) == 0 ? size * random.power_of_ten(0, 3) : size;
  for (Vec3& offset : offsets) {
    offset.x = random.integer(0, 7) == 0 ? 0 : ring + offset.x;
  }
  std::array<Vec3, 3> corners = offsets;
  for (Vec3& corner : corners) corner.y += at.y;
  const double bulge = random.sign() * random.uniform(0.3, 1.2);
  revolution.profile = arched_triangle(corners, bulge);
  if (revolution.profile == nullptr) revolution.profile = arched_triangle(offsets, bulge);
  revolution.angle = random.integer(0, 1) == 0 ? 2 * std::numbers::pi : random.uniform(0.2, 6);
}
/// Turns a vector of the plane of the profile about the axis.
Vec3 turned(const Vec3& v, double turn) {
  return {v.x * std::sin(turn), v.y, v.x * std::cos(turn)};
}
/// Returns a spot on one of the three walls, or on an end.
Spot spot(Counted& random, const Revolution& revolution) {
  const ArchedTriangle profile(*revolution.profile);
  const std::vector<Vec3> ends = ends_of(revolution);
  const auto side = static_cast<std::size_t>(random.integer(0, ends.empty() ? 2 : 3));
  const double share = random.uniform(0, 1);
  if (side == 3) {
    const Vec3 within = profile.corners[0] + share * (profile.corners[1] - profile.corners[0]);
    const Vec3 point = within + random.uniform(0, 1) * (profile.corners[2] - within);
    const bool is_first = random.integer(0, 1) == 0;
    return {turned(point, is_first ? 0 : revolution.angle), ends[is_first ? 0 : 1],
            random.integer(0, 1) == 0 ? Vec3(0, 1, 0)
                                      : turned({1, 0, 0}, is_first ? 0 : revolution.angle)};
  }
  const Spot flat = flat_spot(profile, side, share);
  const double turn = random.uniform(0, 1) * revolution.angle;
  return {turned(flat.point, turn), turned(flat.normal, turn),
          random.integer(0, 1) == 0 ? turned(flat.parallel, turn)
                                    : Vec3(std::cos(turn), 0, -std::sin(turn))};
}
/// Returns a point of the circle of a corner, or of the edge of an end.
Vec3 edge(Counted& random, const Revolution& revolution) {
  const ArchedTriangle profile(*revolution.profile);
  if (ends_of(revolution).empty() || random.integer(0, 1) == 0) {
    const Vec3& corner = profile.corners[static_cast<std::size_t>(random.integer(0, 2))];
    return turned(corner, random.uniform(0, 1) * revolution.angle);
  }
  const auto side = static_cast<std::size_t>(random.integer(0, 2));
  const Vec3 point = flat_spot(profile, side, random.uniform(0, 1)).point;
  return turned(point, random.integer(0, 1) == 0 ? 0 : revolution.angle);
}

}  // namespace

void make(Counted& random, const Vec3& at, double size, Primitive& primitive) {
  std::visit([&](auto& p) { make(random, at, size, p); }, primitive);
}

Spot spot(Counted& random, const Primitive& primitive) {
  return std::visit([&](const auto& p) { return spot(random, p); }, primitive);
}

Vec3 edge(Counted& random, const Primitive& primitive) {
  return std::visit([&](const auto& p) { return edge(random, p); }, primitive);
}

}  // namespace crt::test
