#include "core/geometry/triangle/triangle.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/oracle.hpp"

using namespace crt;
using namespace crt::test;

namespace {

Subject random_triangle(Random& random) {
  const double size = random.power_of_ten(-6, 6);
  const Vec3 center = random.in_cube() * (size * random.power_of_ten(-2, 2));
  const Vec3 a = center + size * random.in_cube();
  Vec3 b = a;
  Vec3 c = a;
  RealVec normal;
  do {
    b = center + size * random.in_cube();
    c = center + size * random.in_cube();
    if (random.one_in(4)) b.y = a.y, c.y = a.y;
    normal = cross(RealVec(b) - RealVec(a), RealVec(c) - RealVec(a));
  } while (!(length(normal) > 0.05 * size * size));
  const RealVec n = normalized(normal);
  const RealVec ra(a);
  const RealVec rb(b);
  const RealVec rc(c);
  return {.primitive = Triangle{.a = a, .b = b, .c = c},
          .center = center,
          .size = size,
          .candidates = [=](const RealRay& ray) { return plane_roots(ray, n, ra); },
          .field = [=](const RealVec& p) { return dot(n, p - ra); },
          .on_surface =
              [=](const RealVec& p) {
                return dot(n, cross(rb - ra, p - ra)) >= 0 && dot(n, cross(rc - rb, p - rb)) >= 0 &&
                       dot(n, cross(ra - rc, p - rc)) >= 0;
              }};
}

std::size_t hits(const Triangle& triangle, const core::ObjectRay& ray) {
  core::CrossingList result;
  core::make_shape(triangle)->crossings(ray, result);
  return result.size();
}

}  // namespace

TEST_CASE("triangle: crossings are the true ones within their error") {
  check_against_oracle(random_triangle, 100000);
}
TEST_CASE("triangle: powers of two scale it to the bit") {
  check_scaling(random_triangle, 2000);
}
TEST_CASE("triangle: a ray turned round meets the same points") {
  check_reversal(random_triangle, 20000);
}
TEST_CASE("triangle: points, normals and (u, v)") {
  check_surface_points(random_triangle, 10000, true);
}
TEST_CASE("triangle: a ray that starts on it does not meet it again") {
  check_starts(random_triangle, 50000, true);
}

TEST_CASE("triangle: no ray slips between triangles that share an edge or a corner") {
  Random random(17);
  for (int i = 0; i < 3000; ++i) {
    // This is a fan of six about a middle corner, slightly out of plane.
    const Vec3 middle = random.in_cube();
    Vec3 rim[6];
    for (int k = 0; k < 6; ++k) {
      const double angle = k + 0.3 * random.uniform(0, 1);
      rim[k] = middle + Vec3(std::cos(angle), std::sin(angle), random.uniform(-0.2, 0.2));
    }
    const int at = static_cast<int>(random.bits() % 6);
    const double share = random.one_in(3) ? 0 : random.uniform(0, 0.9);
    const Vec3 target = middle + share * (rim[at] - middle);
    core::ObjectRay ray;
    ray.direction = Vec3(0.3 * random.uniform(-1, 1), 0.3 * random.uniform(-1, 1), 1);
    ray.origin = target - ray.direction * random.power_of_ten(-1, 4);
    std::size_t count = 0;
    for (int k = 0; k < 6; ++k) {
      count += hits(Triangle{.a = middle, .b = rim[k], .c = rim[(k + 1) % 6]}, ray);
    }
    REQUIRE(count >= 1);
  }
}

TEST_CASE("triangle: rays exactly through a corner or an edge hit") {
  CHECK(hits(Triangle{}, {.origin = {0, 0, -3}, .direction = {0, 0, 1}}) == 1);
  CHECK(hits(Triangle{}, {.origin = {1, 0, -3}, .direction = {0, 0, 1}}) == 1);
  CHECK(hits(Triangle{}, {.origin = {0.5, 0.5, -3}, .direction = {0, 0, 1}}) == 1);
  CHECK(hits(Triangle{}, {.origin = {0.5, 0.5 + 0x1p-52, -3}, .direction = {0, 0, 1}}) == 0);
  CHECK(hits(Triangle{}, {.origin = {-0x1p-80, 0.5, -3}, .direction = {0, 0, 1}}) == 0);
}

TEST_CASE("triangle: a sliver has the right normal") {
  const Triangle sliver{
      .a = {0.1, 0.1, 0.1}, .b = {0.3, 0.3, 0.3}, .c = {0.7, 0.7, 0.7000000000000001}};
  const auto shape = core::make_shape(sliver);
  const RealVec a(sliver.a);
  const RealVec expected = normalized(cross(RealVec(sliver.b) - a, RealVec(sliver.c) - a));
  const RealVec normal(
      shape->surface_point({.origin = sliver.a, .direction = {1, 0, 0}}, {}).normal);
  CHECK(length(normal - expected) < 1e-15);
}

TEST_CASE("triangle: (u, v) are the weights of b and c") {
  const Triangle triangle{.a = {1, 2, 3}, .b = {4, 2, 1}, .c = {0, 7, 2}};
  const auto shape = core::make_shape(triangle);
  const Vec3 p = 0.5 * triangle.a + 0.2 * triangle.b + 0.3 * triangle.c;
  const core::SurfacePoint point = shape->surface_point({.origin = p, .direction = {0, 0, 1}}, {});
  CHECK(point.u == doctest::Approx(0.2).epsilon(1e-14));
  CHECK(point.v == doctest::Approx(0.3).epsilon(1e-14));
}
