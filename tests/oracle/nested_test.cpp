// These tests compare nested transforms in the exact tier with the product without rounding, of the
// very doubles given.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/double_double.hpp"
#include "oracle/line_oracle.hpp"
#include "oracle/prepared_tree.hpp"
#include "support/solids.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Applies one transform after the other: on the entity itself, or on what it is a part of, the
/// innermost first.
Entity nested(const Primitive& primitive, const std::vector<Transform>& transforms,
              bool in_unions) {
  Entity entity(primitive);
  const Entity far_away = Sphere{.center = {1e9, 0, 0}};
  for (const Transform& transform : transforms) {
    entity = entity.transformed(transform);
    if (in_unions) entity = entity + far_away.transformed(transform);
  }
  return entity;
}

Transform random_transform(SolidMaker& make) {
  switch (make.integer(0, 3)) {
    case 0:
      return scale(make.real(0.2, 3));
    case 1:
      return translate({make.real(-3, 3), make.real(-3, 3), make.real(-3, 3)});
    case 2:
      return scale({make.real(0.5, 2), make.real(0.5, 2), make.real(0.5, 2)});
    default:
      return rotate_degrees({make.real(-180, 180), make.real(-180, 180), make.real(-180, 180)});
  }
}

Primitive random_primitive(SolidMaker& make) {
  const Vec3 place{make.real(-2, 2), make.real(-2, 2), make.real(-2, 2)};
  const Vec3 extent{make.real(0.5, 2), make.real(-2, 2), make.real(-2, 2)};
  switch (make.integer(0, 5)) {
    case 0:
      return Sphere{.center = place, .radius = make.real(0.5, 2)};
    case 1:
      return Box{.corner_a = place, .corner_b = place + Vec3(1, 2, make.real(0.5, 2))};
    case 2:
      return Cylinder{.from = place, .to = place + extent, .radius = make.real(0.2, 1)};
    case 3:
      return Cone{.from = place,
                  .to = place + extent,
                  .radius = make.real(0.2, 1),
                  .radius2 = make.real(0, 1)};
    case 4:
      return Torus{.center = place, .axis = extent, .radius = 1, .thickness = make.real(0.1, 0.6)};
    default:
      return Plane{.normal = extent, .position = place};
  }
}

Vec3 applied(const std::vector<Transform>& transforms, Vec3 p) {
  for (const Transform& m : transforms) {
    p = Vec3(glm::dot(m.row_x, p), glm::dot(m.row_y, p), glm::dot(m.row_z, p)) + m.translation;
  }
  return p;
}

struct Count {
  std::size_t crossings = 0;
  std::size_t wrong = 0;
};

/// Compares both along one ray.
void compare(const Primitive& primitive, const std::vector<Transform>& transforms,
             PreparedTree& scene, const Vec3& origin, const Vec3& direction, Count& count) {
  const TrueLine truth = true_crossings({.primitive = primitive,
                                         .origin = origin,
                                         .direction = direction,
                                         .to_world = {},
                                         .around = transforms});
  const FoundFlips found = scene.flips({origin, direction});
  std::vector<FoundFlip> near;
  for (const FoundFlip& flip : found.flips) {
    if (std::abs(flip.t) < 1e6) near.push_back(flip);
  }
  count.crossings += truth.crossings.size();
  if (near.size() != truth.crossings.size()) {
    count.wrong += std::max(near.size(), truth.crossings.size());
    return;
  }
  for (std::size_t i = 0; i < near.size(); ++i) {
    const Ball<4>& t = truth.crossings[i].t;
    const double tolerance = std::holds_alternative<Torus>(primitive) ? 1 : 0.51;
    const double error = std::abs((Ball<4>(near[i].t) - t).value());
    const bool right = near[i].entering == truth.crossings[i].entering &&
                       error <= tolerance * ulp(t.value()) + t.radius();
    count.wrong += right ? 0 : 1;
  }
}

}  // namespace

TEST_CASE(
    "a unit ball scaled by 1/3 and then by 1/5 is met where the product of both without rounding "
    "has it") {
  constexpr double third = 1.0 / 3;
  constexpr double fifth = 1.0 / 5;
  const core::DoubleDouble product = core::two_product(third, fifth);
  REQUIRE(product.lo != 0);
  const std::vector<Transform> transforms{scale(third), scale(fifth)};
  for (const bool in_unions : {false, true}) {
    PreparedTree scene(nested(Sphere{}, transforms, in_unions), Precision::exact);
    // A line that touches the ball of the rounded radius meets the true one if that is larger.
    const std::size_t expected = product.lo > 0 ? 2 : 0;
    CHECK(scene.flips({{product.hi, 0, -1}, {0, 0, 1}}).flips.size() == expected);
    const double inner = product.lo > 0 ? product.hi : std::nextafter(product.hi, 0);
    CHECK(scene.flips({{inner, 0, -1}, {0, 0, 1}}).flips.size() == 2);
    CHECK(scene.flips({{std::nextafter(inner, 1), 0, -1}, {0, 0, 1}}).flips.empty());
  }
}

TEST_CASE("nested transforms are their product without rounding in the exact tier") {
  Count count;
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    SolidMaker make(seed);
    const Primitive primitive = random_primitive(make);
    std::vector<Transform> transforms;
    for (int i = make.integer(2, 6); i > 0; --i) transforms.push_back(random_transform(make));
    PreparedTree scene(nested(primitive, transforms, make.integer(0, 1) == 0), Precision::exact);
    const Vec3 center = applied(transforms, center_of(primitive));
    for (int i = 0; i < 30; ++i) {
      const Vec3 aim = center + Vec3(make.real(-1, 1), make.real(-1, 1), make.real(-1, 1));
      const Vec3 origin(make.real(-30, 30), make.real(-30, 30), make.real(-30, 30));
      compare(primitive, transforms, scene, origin, aim - origin, count);
    }
  }
  CHECK(count.crossings > 5000);
  CHECK(count.wrong == 0);
}

TEST_CASE("rays that graze nested spheres hit or miss as the product without rounding says") {
  Count count;
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    SolidMaker make(500 + seed);
    std::vector<Transform> transforms;
    double size = 1;
    for (int i = make.integer(2, 6); i > 0; --i) {
      const double factor = make.real(0.2, 3);
      size *= factor;
      transforms.push_back(scale(factor));
      transforms.push_back(make.integer(0, 1) == 0 ? random_transform(make) : Transform{});
      if (transforms.back().row_x != Vec3(1, 0, 0)) {
        transforms.back() =
            rotate_degrees({make.real(-180, 180), make.real(-180, 180), make.real(-180, 180)});
      }
    }
    PreparedTree scene(nested(Sphere{}, transforms, make.integer(0, 1) == 0), Precision::exact);
    const Vec3 center = applied(transforms, Vec3(0));
    for (int i = 0; i < 20; ++i) {
      const Vec3 direction(make.real(-1, 1), make.real(-1, 1), make.real(-1, 1));
      const Vec3 across = glm::normalize(
          glm::cross(direction, Vec3(make.real(-1, 1), make.real(-1, 1), make.real(-1, 1))));
      const Vec3 touch = center + size * (1 + make.integer(-8, 8) * 0x1p-53) * across;
      compare(Sphere{}, transforms, scene, touch - 2.0 * direction, direction, count);
    }
  }
  CHECK(count.crossings > 2000);
  CHECK(count.wrong == 0);
}

TEST_CASE("what is nested thousands deep is rounded beyond 1024 bits and goes on from there") {
  Entity entity = Sphere{.radius = 1};
  Entity other = entity;
  for (int i = 0; i < 3000; ++i) {
    entity = entity.transformed(rotate_degrees({0.1 * i, 7, 0.3}));
    other = (other + Sphere{.center = {1e9, 0, 0}}).transformed(rotate_degrees({0.1 * i, 7, 0.3}));
  }
  for (const Entity& deep : {entity, other}) {
    PreparedTree scene(deep, Precision::exact);
    std::vector<double> ends;
    for (const FoundFlip& flip : scene.flips({{0, 0, -3}, {0, 0, 1}}).flips) {
      if (std::abs(flip.t) < 1e6) ends.push_back(flip.t);
    }
    REQUIRE(ends.size() == 2);
    CHECK(std::abs(ends[0] - 2) < 1e-12);
    CHECK(std::abs(ends[1] - 4) < 1e-12);
  }
}
