// An ellipsoid is a sphere that is scaled: it has that one's hits, and those of its equation.
#include "crt/ellipsoid.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "crt/prepared_scene.hpp"
#include "crt/query.hpp"
#include "csg/made_solids.hpp"

using namespace crt;
using namespace crt::test;

namespace {

PreparedScene prepared(const Entity& entity, Precision precision) {
  Scene scene;
  scene.entities = {entity};
  scene.settings.precision = precision;
  return prepare(scene);
}

}  // namespace

TEST_CASE("rays meet an ellipsoid where its equation says, in both tiers") {
  const Ellipsoid ellipsoid{.center = {1, -2, 3}, .radii = {2, 0.5, 1.25}};
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    const PreparedScene scene = prepared(ellipsoid, precision);
    int met = 0;
    for (int i = 0; i < 400; ++i) {
      const double turn = 0.7 * i;
      const Vec3 origin(1 + 6 * std::cos(turn), -2 + 3 * std::sin(1.3 * turn),
                        3 + 6 * std::sin(turn));
      const Vec3 target(1 + 1.5 * std::sin(2.1 * turn), -2 + 0.4 * std::cos(turn), 3);
      const Ray ray{.origin = origin, .direction = target - origin};
      const auto crossings = crt::crossings(scene, ray);
      // The equation in the space of the unit sphere.
      const Vec3 o = (origin - ellipsoid.center) / ellipsoid.radii;
      const Vec3 d = ray.direction / ellipsoid.radii;
      const double a = d.x * d.x + d.y * d.y + d.z * d.z;
      const double b = o.x * d.x + o.y * d.y + o.z * d.z;
      const double c = o.x * o.x + o.y * o.y + o.z * o.z - 1;
      const double discriminant = b * b - a * c;
      if (std::abs(discriminant) < 1e-9) continue;
      REQUIRE(crossings.size() == (discriminant > 0 ? 2 : 0));
      if (discriminant < 0) continue;
      ++met;
      CHECK(crossings[0].t == doctest::Approx((-b - std::sqrt(discriminant)) / a).epsilon(1e-12));
      CHECK(crossings[1].t == doctest::Approx((-b + std::sqrt(discriminant)) / a).epsilon(1e-12));
    }
    CHECK(met > 200);
  }
}

TEST_CASE("an ellipsoid of equal radii is the sphere, to the last bit") {
  const PreparedScene sphere = prepared(Sphere{.center = {0.1, 0, 0}, .radius = 0.3}, {});
  const PreparedScene ellipsoid =
      prepared(Ellipsoid{.center = {0.1, 0, 0}, .radii = {0.3, 0.3, 0.3}}, {});
  const Ray ray{.origin = {-1, 0.1, 0.05}, .direction = {1, 0.01, 0}};
  CHECK(crossings(sphere, ray).at(0).t == crossings(ellipsoid, ray).at(0).t);
}

TEST_CASE("an ellipsoid is a solid that can be cut, in the box of its radii") {
  const Entity whole = Ellipsoid{.center = {1, 2, 3}, .radii = {1, 2, 4}};
  CHECK(whole.is_solid());
  const BoundingBox box = bounding_box(whole);
  CHECK(box.lower.x == doctest::Approx(0));
  CHECK(box.upper.y == doctest::Approx(4));
  CHECK(box.upper.z == doctest::Approx(7));
  const Entity half = whole - Entity(Plane{.position = {0, 2, 0}});
  CHECK(crossings(prepared(half, {}), {.origin = {1, 9, 3}, .direction = {0, -1, 0}}).at(1).t ==
        doctest::Approx(7));
}

TEST_CASE("radii and centers that are out of range are named") {
  CHECK(fault_of(Ellipsoid{.radii = {1, 0, 1}}) == "radii must be greater than 0 (it is 0)");
  CHECK(fault_of(Ellipsoid{.radii = {1, 1, -2}}) == "radii must be greater than 0 (it is -2)");
  CHECK(fault_of(Ellipsoid{.radii = {1e101, 1, 1}}) ==
        "radii must be at most 1e100 (it is 1e+101)");
  CHECK(fault_of(Ellipsoid{.center = {0, NAN, 0}}) == "center must be finite (it is (0, nan, 0))");
  CHECK(fault_of(Ellipsoid{}).empty());
}
