#include "oracle/ray_maker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/geometry/shape.hpp"
#include "crt/error.hpp"
#include "oracle/ruling_rays.hpp"
#include "oracle/scaled_rays.hpp"

namespace crt::test {

double Counted::uniform(double low, double high) {
  const core::RandomUse use{static_cast<std::uint32_t>(number_),
                            static_cast<std::uint32_t>(number_ >> 32), 0, drawn_++};
  return low + (high - low) * core::random_number(seed_, use);
}

int Counted::integer(int low, int high) {
  return std::min(high, low + static_cast<int>(uniform(0, high - low + 1)));
}

double Counted::power_of_ten(double low, double high) {
  return std::pow(10.0, uniform(low, high));
}

Vec3 Counted::in_cube() {
  const double x = uniform(-1, 1);
  const double y = uniform(-1, 1);
  const double z = uniform(-1, 1);
  return {x, y, z};
}

Vec3 Counted::direction() {
  if (integer(0, 3) == 0) {
    Vec3 axis(0);
    axis[integer(0, 2)] = sign();
    return axis;
  }
  while (true) {
    const Vec3 v = in_cube();
    const double size = glm::length(v);
    if (size > 0.1 && size <= 1) return v / size;
  }
}

namespace {

/// A Spot is a point on the surface with its normal, and a direction that a ray may be nearly
/// parallel to.
struct Spot {
  Vec3 point;
  Vec3 normal;
  Vec3 parallel;
};

struct Frame {
  Vec3 a;
  Vec3 b;
};
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

RayKind random_kind(Counted& random) {
  const int tenth = random.integer(0, 9);
  return tenth < 5 ? RayKind::plain : static_cast<RayKind>(tenth - 4);
}

template <class P>
TestRay ray_for(Counted& random, const P& primitive, double size) {
  TestRay ray;
  ray.primitive = primitive;
  ray.kind = random_kind(random);
  const double exponent = random.uniform(lowest_decade, highest_decade + 1);
  ray.decade = static_cast<int>(std::floor(exponent));
  const double distance = size * std::pow(10.0, exponent);
  const Spot at = spot(random, primitive);
  const double tilt = random.power_of_ten(-16, -1) * random.sign();
  Vec3 target = at.point + 0.2 * size * random.in_cube();
  Vec3 d = random.direction();
  switch (ray.kind) {
    case RayKind::plain:
    case RayKind::along_ruling:  // made elsewhere
    case RayKind::extreme_length:
      break;
    case RayKind::grazing:
      d = around(across(at.normal), angle(random));
      target = at.point + tilt * size * at.normal;
      break;
    case RayKind::axis_parallel:
      d = Vec3(0);
      d[random.integer(0, 2)] = random.sign();
      ray.origin = target - distance * d;
      ray.direction = d * random.uniform(0.5, 2);
      return ray;
    case RayKind::edge:
      target = edge(random, primitive);
      break;
    case RayKind::on_surface:
      ray.origin = at.point;
      ray.direction = d * random.uniform(0.5, 2);
      return ray;
    case RayKind::near_parallel:
      d = at.parallel + tilt * random.direction();
      break;
  }
  // The line starts from the rounded origin, so that it still passes the target.
  ray.origin = target - distance * d;
  ray.direction = target - ray.origin;
  if (random.integer(0, 3) == 0) ray.direction = glm::normalize(ray.direction);
  return ray;
}

template <std::size_t kind = 0>
Primitive default_primitive(std::size_t wanted) {
  if constexpr (kind + 1 < primitive_kinds) {
    if (wanted != kind) return default_primitive<kind + 1>(wanted);
  }
  return std::variant_alternative_t<kind, Primitive>{};
}

/// Numbers that end in these digits make no ordinary rays at cylinders and cones.
constexpr std::uint64_t ruling_digit = 7;
constexpr std::uint64_t extreme_digit = 3;

template <class P>
constexpr bool has_rulings = std::is_same_v<P, Cylinder> || std::is_same_v<P, Cone>;

bool is_usable(const TestRay& ray) {
  if (ray.direction == Vec3(0) || !std::isfinite(glm::dot(ray.direction, ray.direction)))
    return false;
  try {
    core::validate(ray.primitive);
  } catch (const Error&) {
    return false;
  }
  return true;
}

/// Applies the linear part.
Vec3 apply(const Transform& transform, const Vec3& v) {
  return {glm::dot(transform.row_x, v), glm::dot(transform.row_y, v), glm::dot(transform.row_z, v)};
}

/// Returns the linear part of first and then second, rounded.
Transform product(const Transform& second, const Transform& first) {
  const auto row = [&](const Vec3& r) {
    return r.x * first.row_x + r.y * first.row_y + r.z * first.row_z;
  };
  return {row(second.row_x), row(second.row_y), row(second.row_z)};
}

}  // namespace

Primitive make_primitive(Counted& random, std::size_t primitive_kind, const Vec3& at, double size) {
  Primitive primitive = default_primitive(primitive_kind);
  const auto make_one = [&]<class P>(P& p) {
    if constexpr (has_rulings<P>) {
      const std::uint64_t digit = random.number() % 10;
      if (digit == extreme_digit || digit == ruling_digit) return make_extreme(random, at, size, p);
    }
    make(random, at, size, p);
  };
  std::visit(make_one, primitive);
  return primitive;
}

TestRay make_ray_at(Counted& random, const Primitive& primitive, double size) {
  const auto make_one = [&]<class P>(const P& p) {
    if constexpr (has_rulings<P>) {
      if (random.number() % 10 == ruling_digit) return make_ruling_ray(random, p);
    }
    return ray_for(random, p, size);
  };
  return std::visit(make_one, primitive);
}

Transform random_transform(Counted& random) {
  const auto quarter_turns = [&] { return 90.0 * random.integer(0, 3); };
  const auto angle_in_degrees = [&] { return random.uniform(0, 360); };
  const bool unrounded = random.integer(0, 3) == 0;
  const auto turned = [&] {
    const double x = unrounded ? quarter_turns() : angle_in_degrees();
    const double y = unrounded ? quarter_turns() : angle_in_degrees();
    return rotate({x, y, unrounded ? quarter_turns() : angle_in_degrees()});
  };
  constexpr double spread = 4;  // of decades, up and down
  const auto factor = [&] {
    return random.sign() * (unrounded ? std::ldexp(1.0, random.integer(-8, 8))
                                      : random.power_of_ten(-spread, spread));
  };
  const double x = factor();
  const double y = factor();
  const Transform scaled = scale(Vec3(x, y, random.integer(0, 1) == 0 ? x : factor()));
  const Transform first = turned();
  return product(turned(), product(scaled, first));
}

std::string_view name_of(RayKind kind) {
  constexpr std::array<std::string_view, ray_kinds> names = {
      "plain",          "grazing",         "axis-parallel",  "edges, corners",
      "on the surface", "nearly parallel", "along a ruling", "extreme direction"};
  return names[static_cast<std::size_t>(kind)];
}

std::string_view name_of_primitive(std::size_t kind) {
  constexpr std::array<std::string_view, primitive_kinds> names = {
      "sphere", "box", "plane", "half plane", "cylinder", "cone", "torus", "disc", "triangle"};
  return names[kind];
}

TestRay make_ray(std::size_t primitive_kind, std::uint64_t number) {
  // A size that is lost in the offset makes no primitive. The next seed makes another.
  for (std::uint64_t seed = primitive_kind;; seed += primitive_kinds) {
    Counted random(seed, number);
    const double size = random.power_of_ten(-9, 9);
    const Vec3 at = random.power_of_ten(-9, 9) * random.direction();
    TestRay ray = make_ray_at(random, make_primitive(random, primitive_kind, at, size), size);
    if (number / 10 % 10 == extreme_digit) scale_direction(random, ray);
    if (is_usable(ray)) return ray;
  }
}

void move_to_world(TestRay& ray) {
  ray.origin = apply(ray.to_world, ray.origin) + ray.to_world.translation;
  ray.direction = apply(ray.to_world, ray.direction);
}

TestRay make_placed_ray(std::size_t primitive_kind, std::uint64_t number) {
  TestRay ray = make_ray(primitive_kind, number);
  Counted random(primitive_kinds * primitive_kinds + primitive_kind, number);
  const Transform transform = random_transform(random);
  const Vec3 shift = glm::length(ray.origin) * random.power_of_ten(-3, 3) * random.in_cube();
  ray.to_world = transform;
  if (random.integer(0, 1) == 0) ray.to_world.translation = shift;
  move_to_world(ray);
  round_scaled(ray);
  return ray;
}

}  // namespace crt::test
