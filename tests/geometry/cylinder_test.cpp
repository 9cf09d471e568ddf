#include "core/geometry/cylinder/cylinder.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/frustum_oracle.hpp"

using namespace crt;
using namespace crt::test;

namespace {

Subject random_cylinder(Random& random) {
  const double size = random.power_of_ten(-6, 6);
  const Vec3 from = random.in_cube() * (size * random.power_of_ten(-2, 2));
  const double height = size * random.power_of_ten(-2, 0);
  const double radius = size * random.power_of_ten(-2, 0);
  const Vec3 to = from + random.direction() * height;
  const FrustumOracle oracle(from, to, radius, radius);
  return {.primitive = Cylinder{.from = from, .to = to, .radius = radius},
          .center = from,
          .size = std::max(height, radius),
          .candidates = [=](const RealRay& ray) { return oracle.candidates(ray); },
          .field = [=](const RealVec& p) { return oracle.field(p); }};
}

core::CrossingList crossings(const Cylinder& cylinder, const core::ObjectRay& ray) {
  core::CrossingList result;
  core::make_shape(cylinder)->crossings(ray, result);
  return result;
}

}  // namespace

TEST_CASE("cylinder: crossings are the true ones within their error") {
  check_against_oracle(random_cylinder, 50000);
}
TEST_CASE("cylinder: powers of two scale it to the bit") {
  check_scaling(random_cylinder, 2000);
}
TEST_CASE("cylinder: a ray turned round meets the same points") {
  check_reversal(random_cylinder, 20000);
}
TEST_CASE("cylinder: points, normals and (u, v)") {
  check_surface_points(random_cylinder, 10000, true);
}
TEST_CASE("cylinder: a ray that starts on it obeys its side") {
  check_starts(random_cylinder, 100000, true);
}

TEST_CASE("cylinder: rays nearly parallel to the axis keep their digits") {
  Random random(19);
  for (int i = 0; i < 20000; ++i) {
    const Subject subject = random_cylinder(random);
    const auto& cylinder = std::get<Cylinder>(subject.primitive);
    const Vec3 axis = glm::normalize(cylinder.to - cylinder.from);
    const Vec3 aside = glm::normalize(glm::cross(axis, random.in_cube()));
    core::ObjectRay ray;
    ray.direction = axis + random.power_of_ten(-12, -1) * aside;
    ray.origin = cylinder.from + cylinder.radius * random.uniform(0, 1) * aside -
                 random.uniform(-2, 50) * subject.size * ray.direction;
    core::CrossingList found;
    core::make_shape(cylinder)->crossings(ray, found);
    const RealRay real(ray);
    for (const core::Crossing& crossing : found) {
      Real nearest = 1e300;
      for (const Real root : subject.candidates(real))
        nearest = std::min(nearest, magnitude(root - crossing.t));
      REQUIRE(nearest <= crossing.error);
    }
  }
}

TEST_CASE("cylinder: rays along the axis meet the caps, or nothing on the side and beyond") {
  CHECK(crossings(Cylinder{}, {.origin = {0.3, -5, 0.2}, .direction = {0, 1, 0}}).size() == 2);
  CHECK(crossings(Cylinder{}, {.origin = {1, -5, 0}, .direction = {0, 1, 0}}).empty());
  CHECK(crossings(Cylinder{}, {.origin = {1.5, -5, 0}, .direction = {0, 1, 0}}).empty());
  CHECK(crossings(Cylinder{}, {.origin = {1 - 0x1p-53, -5, 0}, .direction = {0, 1, 0}}).size() ==
        2);
  CHECK(crossings(Cylinder{}, {.origin = {0.3, -5, 0.2}, .direction = {5e-324, 1, 0}}).size() == 2);
}

TEST_CASE("cylinder: rays within a cap's plane or along the side do not enter") {
  CHECK(crossings(Cylinder{}, {.origin = {-5, 0, 0}, .direction = {1, 0, 0}}).empty());
  CHECK(crossings(Cylinder{}, {.origin = {-5, 1, 0}, .direction = {1, 0, 0}}).empty());
  CHECK(crossings(Cylinder{}, {.origin = {-5, 0.5, 1}, .direction = {1, 0, 0}}).empty());
  CHECK(crossings(Cylinder{}, {.origin = {-5, 0.5, 0}, .direction = {1, 0, 0}}).size() == 2);
}

TEST_CASE("cylinder: both directions of the axis and stacked ones share their side") {
  const core::Surface up =
      core::make_shape(Cylinder{.from = {1, 0, 2}, .to = {1, 4, 2}})->surface(0);
  const core::Surface down =
      core::make_shape(Cylinder{.from = {1, 9, 2}, .to = {1, 4, 2}})->surface(0);
  CHECK(up.kind == core::SurfaceKind::cylinder);
  CHECK(up.direction == down.direction);
  CHECK(up.position == down.position);
  CHECK(up.sizes == down.sizes);
}

TEST_CASE("cylinder: its box is tight") {
  const core::Bounds straight = core::make_shape(Cylinder{.radius = 0.5})->bounds();
  CHECK(straight.lower.y == 0);
  CHECK(straight.upper.y == 1);
  CHECK(straight.upper.x == doctest::Approx(0.5).epsilon(1e-14));
  const core::Bounds slanted = core::make_shape(Cylinder{.to = {3, 4, 0}})->bounds();
  CHECK(slanted.upper.x == doctest::Approx(3 + 0.8).epsilon(1e-14));
  CHECK(slanted.upper.y == doctest::Approx(4 + 0.6).epsilon(1e-14));
  CHECK(slanted.lower.z == doctest::Approx(-1).epsilon(1e-14));
}

TEST_CASE("cylinder: extreme shapes give finite answers") {
  const Cylinder needle{.from = {0, -1e100, 0}, .to = {0, 1e100, 0}, .radius = 1e-100};
  CHECK(crossings(needle, {.origin = {-1, 5, 0}, .direction = {1, 0, 0}}).size() <= 2);
  CHECK(crossings(needle, {.origin = {-1e-99, 5, 0}, .direction = {1, 0, 0}}).size() == 2);
  const Cylinder coin{.from = {0, 0, 0}, .to = {0, 1e-100, 0}, .radius = 1e100};
  CHECK(crossings(coin, {.origin = {1, 1e-99, 0}, .direction = {0, -1, 0}}).size() == 2);
}
