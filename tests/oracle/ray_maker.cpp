#include "oracle/ray_maker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/geometry/shape.hpp"
#include "crt/error.hpp"
#include "oracle/ruling_rays.hpp"
#include "oracle/scaled_rays.hpp"
#include "oracle/spots.hpp"

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

RayKind random_kind(Counted& random) {
  const int tenth = random.integer(0, 9);
  return tenth < 5 ? RayKind::plain : static_cast<RayKind>(tenth - 4);
}

TestRay ray_for(Counted& random, const Primitive& primitive, double size) {
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

/// Numbers that end in these digits make no ordinary rays at solids that have rulings.
constexpr std::uint64_t ruling_digit = 7;
constexpr std::uint64_t extreme_digit = 3;

template <class P>
constexpr bool has_rulings =
    std::is_same_v<P, Cylinder> || std::is_same_v<P, Cone> || std::is_same_v<P, Capsule>;

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
  const std::uint64_t digit = random.number() % 10;
  const bool is_extreme = digit == extreme_digit || digit == ruling_digit;
  const auto make_if_extreme = [&]<class P>(P& p) {
    if constexpr (has_rulings<P>) {
      if (is_extreme) make_extreme(random, at, size, p);
      return is_extreme;
    } else {
      return false;
    }
  };
  if (!std::visit(make_if_extreme, primitive)) make(random, at, size, primitive);
  return primitive;
}

TestRay make_ray_at(Counted& random, const Primitive& primitive, double size) {
  const auto make_one = [&]<class P>(const P& p) {
    if constexpr (has_rulings<P>) {
      if (random.number() % 10 == ruling_digit) return make_ruling_ray(random, p);
    }
    return ray_for(random, primitive, size);
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
    return rotate_degrees({x, y, unrounded ? quarter_turns() : angle_in_degrees()});
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
      "sphere",     "box",          "plane",    "half plane", "cylinder", "cone",
      "torus",      "disc",         "triangle", "capsule",    "mesh",     "extrusion",
      "revolution", "height field", "quadric",  "rounded box"};
  static_assert(!names.back().empty());
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
