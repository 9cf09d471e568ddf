#include "core/geometry/cone/cone.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/geometry/cylinder/cylinder.hpp"
#include "geometry/frustum_oracle.hpp"

using namespace crt;
using namespace crt::test;

namespace {

Subject random_cone(Random& random) {
  const double size = random.power_of_ten(-6, 6);
  const Vec3 from = random.in_cube() * (size * random.power_of_ten(-2, 2));
  const double height = size * random.power_of_ten(-1.5, 0);
  const double radius = size * random.power_of_ten(-1.5, 0);
  const double radius2 = random.one_in(2) ? 0 : size * random.power_of_ten(-1.5, 0);
  const Vec3 to = from + random.direction() * height;
  const FrustumOracle oracle(from, to, radius, radius2);
  return {.primitive = Cone{.from = from, .to = to, .radius = radius, .radius2 = radius2},
          .center = from,
          .size = std::max({height, radius, radius2}),
          .candidates = [=](const RealRay& ray) { return oracle.candidates(ray); },
          .field = [=](const RealVec& p) { return oracle.field(p); }};
}

core::CrossingList crossings(const Cone& cone, const core::ObjectRay& ray) {
  core::CrossingList result;
  core::make_shape(cone)->crossings(ray, result);
  return result;
}

}  // namespace

TEST_CASE("cone: crossings are the true ones within their error") {
  check_against_oracle(random_cone, 50000);
}
TEST_CASE("cone: powers of two scale it to the bit") {
  check_scaling(random_cone, 2000);
}
TEST_CASE("cone: a ray turned round meets the same points") {
  check_reversal(random_cone, 20000);
}
TEST_CASE("cone: points, normals and (u, v)") {
  check_surface_points(random_cone, 10000, true);
}
TEST_CASE("cone: a ray that starts on it obeys its side") {
  check_starts(random_cone, 100000, true);
}

TEST_CASE("cone: rays through the apex") {
  const Cone cone{.from = {0, 0, 0}, .to = {0, 1, 0}, .radius = 1, .radius2 = 0};
  // Down the axis the ray goes in at the apex and out at the base.
  const core::ObjectRay down{.origin = {0, 3, 0}, .direction = {0, -1, 0}};
  const auto along = crossings(cone, down);
  REQUIRE(along.size() == 2);
  CHECK(along[0].t == 2);
  CHECK(along[0].face == 0);
  CHECK(along[0].error < 1e-14);
  CHECK(along[1].t == 3);
  CHECK(along[1].face == 1);
  // A steep ray goes in at the apex and out at the base, and flat ones only touch it.
  CHECK(crossings(cone, {.origin = {-1, 3, 0}, .direction = {0.5, -1, 0}}).size() == 2);
  CHECK(crossings(cone, {.origin = {-3, 1, 0}, .direction = {1, 0, 0}}).empty());
  CHECK(crossings(cone, {.origin = {-4, 2, 0}, .direction = {4, -1, 0}}).empty());
  // This ray is along a ruling.
  CHECK(crossings(cone, {.origin = {-1, 2, 0}, .direction = {1, -1, 0}}).empty());
  const core::SurfacePoint apex = core::make_shape(cone)->surface_point(down, along[0]);
  CHECK(apex.position == Vec3(0, 1, 0));
  CHECK(apex.normal == Vec3(0, 1, 0));
  CHECK(std::isfinite(apex.u));
  CHECK(apex.v == 1);
}

TEST_CASE("cone: the other nappe is not there") {
  const Cone cone{.from = {0, 0, 0}, .to = {0, 1, 0}, .radius = 1, .radius2 = 0};
  CHECK(crossings(cone, {.origin = {-9, 1.5, 0}, .direction = {1, 0, 0}}).empty());
  const auto steep = crossings(cone, {.origin = {0.1, 9, 0}, .direction = {0, -1, 0}});
  REQUIRE(steep.size() == 2);
  CHECK(steep[0].t == doctest::Approx(8.1).epsilon(1e-15));
  CHECK(steep[0].root == 1);
}

TEST_CASE("cone: a ray parallel to a ruling meets the side once") {
  const Cone cone{.from = {0, 0, 0}, .to = {0, 1, 0}, .radius = 1, .radius2 = 0};
  const auto found = crossings(cone, {.origin = {-3, 3, 0}, .direction = {1, -1, 0}});
  REQUIRE(found.size() == 2);
  CHECK(found[0].face == 0);
  CHECK(found[0].t == doctest::Approx(2.5).epsilon(1e-15));
  CHECK(found[1].t == 3);
  const auto inside = crossings(cone, {.origin = {-0.5, 0, 0}, .direction = {1, 1, 0}});
  REQUIRE(inside.size() == 2);
  CHECK(inside[0].face == 1);
  CHECK(inside[1].face == 0);
  CHECK(inside[1].t == doctest::Approx(0.75).epsilon(1e-15));
}

TEST_CASE("cone: equal radii make a cylinder") {
  Random random(23);
  const Cone cone{.from = {1, 2, 3}, .to = {2, 5, 1}, .radius = 0.7, .radius2 = 0.7};
  const Cylinder cylinder{.from = {1, 2, 3}, .to = {2, 5, 1}, .radius = 0.7};
  const auto cone_shape = core::make_shape(cone);
  const auto cylinder_shape = core::make_shape(cylinder);
  CHECK(cone_shape->surface(0).kind == core::SurfaceKind::cylinder);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 direction = random.direction();
    const core::ObjectRay ray{.origin = cone.from + random.in_cube() - 5.0 * direction,
                              .direction = direction};
    core::CrossingList a;
    core::CrossingList b;
    cone_shape->crossings(ray, a);
    cylinder_shape->crossings(ray, b);
    REQUIRE(a.size() == b.size());
    for (std::size_t k = 0; k < a.size(); ++k) REQUIRE(a[k].t == b[k].t);
  }
}

TEST_CASE("cone: a ray that starts on its other nappe meets this one as any other ray does") {
  const Cone cone{.from = {0, 0, 0}, .to = {0, 1, 0}, .radius = 1, .radius2 = 0};
  for (const core::Side side : {core::Side::outside, core::Side::inside}) {
    const core::FaceStart start{.face = 0, .side = side, .on_face = false};
    const auto down =
        crossings(cone, {.origin = {1, 2, 0}, .direction = {-0.3, -1, 0}, .start = start});
    REQUIRE(down.size() == 2);
    CHECK(down[0].t == doctest::Approx(2 / 1.3).epsilon(1e-15));
    CHECK(down[0].entering);
    CHECK(crossings(cone, {.origin = {1, 2, 0}, .direction = {-1, 0, 0}, .start = start}).empty());
  }
}

TEST_CASE("cone: frustums of one cone share its apex and slope") {
  const core::Surface a =
      core::make_shape(Cone{.from = {0, 0, 0}, .to = {0, 1, 0}, .radius = 2, .radius2 = 1})
          ->surface(0);
  const core::Surface b =
      core::make_shape(Cone{.from = {0, 2, 0}, .to = {0, 1, 0}, .radius = 0x1p-332, .radius2 = 1})
          ->surface(0);
  const core::Surface c =
      core::make_shape(Cone{.from = {0, 1, 0}, .to = {0, 2, 0}, .radius = 1, .radius2 = 0})
          ->surface(0);
  CHECK(a.kind == core::SurfaceKind::cone);
  CHECK(a.position == Vec3(0, 2, 0));
  CHECK(c.position == a.position);
  CHECK(c.sizes == a.sizes);
  CHECK(c.direction == a.direction);
  CHECK(b.position == Vec3(0, 2, 0));
}

TEST_CASE("cone: extreme shapes give finite answers") {
  Random random(29);
  for (int i = 0; i < 5000; ++i) {
    const double size = random.power_of_ten(-100, 100);
    const Cone cone{.from = {0, 0, 0},
                    .to = random.direction() * random.power_of_ten(-100, 99),
                    .radius = random.power_of_ten(-100, 100),
                    .radius2 = random.one_in(2) ? 0 : random.power_of_ten(-100, 100)};
    const auto shape = core::make_shape(cone);
    const core::ObjectRay ray{.origin = size * random.in_cube(),
                              .direction = random.direction() * random.power_of_ten(-150, 150)};
    core::CrossingList found;
    shape->crossings(ray, found);
    REQUIRE(found.size() % 2 == 0);
    for (const core::Crossing& crossing : found) {
      REQUIRE(std::isfinite(crossing.t));
      REQUIRE(std::isfinite(crossing.error));
      const core::SurfacePoint point = shape->surface_point(ray, crossing);
      REQUIRE(std::isfinite(glm::dot(point.normal, point.normal)));
      REQUIRE(std::isfinite(point.position.x + point.position.y + point.position.z));
      REQUIRE(std::isfinite(point.u + point.v));
    }
  }
}
