#include "core/geometry/capsule/capsule.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "geometry/frustum_oracle.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Returns the roots of the line with the sphere about `center`.
std::vector<Real> sphere_roots(const RealRay& ray, const RealVec& center, Real radius) {
  const RealVec offset = ray.origin - center;
  return quadratic_roots(dot(ray.direction, ray.direction), dot(ray.direction, offset),
                         dot(offset, offset) - radius * radius);
}

Real distance_from(const Capsule& capsule, const RealVec& p) {
  const RealVec from(capsule.from);
  const RealVec axis = RealVec(capsule.to) - from;
  const Real share = dot(p - from, axis) / dot(axis, axis);
  return length(p - (from + std::clamp<Real>(share, 0, 1) * axis));
}

Subject random_capsule(Random& random) {
  const double size = random.power_of_ten(-6, 6);
  const Vec3 from = random.in_cube() * (size * random.power_of_ten(-2, 2));
  const double height = size * random.power_of_ten(-2, 0);
  const double radius = size * random.power_of_ten(-2, 0);
  const Capsule capsule{.from = from, .to = from + random.direction() * height, .radius = radius};
  return {.primitive = capsule,
          .center = 0.5 * capsule.from + 0.5 * capsule.to,
          .size = std::max(height, radius),
          .candidates =
              [=](const RealRay& ray) {
                std::vector<Real> all =
                    FrustumOracle(capsule.from, capsule.to, radius, radius).candidates(ray);
                for (const Vec3& center : {capsule.from, capsule.to}) {
                  const auto roots = sphere_roots(ray, RealVec(center), radius);
                  all.insert(all.end(), roots.begin(), roots.end());
                }
                return all;
              },
          .field = [=](const RealVec& p) { return distance_from(capsule, p) - radius; }};
}

core::CrossingList crossings(const Primitive& primitive, const core::ObjectRay& ray) {
  core::CrossingList result;
  core::make_shape(primitive)->crossings(ray, result);
  return result;
}

/// Returns the faces that are crossed, as digits.
int faces(const core::CrossingList& list) {
  int result = 0;
  for (const core::Crossing& crossing : list) {
    result = 10 * result + static_cast<int>(crossing.face);
  }
  return result;
}

}  // namespace

TEST_CASE("capsule: crossings are the true ones within their error") {
  check_against_oracle(random_capsule, 50000);
}
TEST_CASE("capsule: powers of two scale it to the bit") {
  check_scaling(random_capsule, 2000);
}
TEST_CASE("capsule: a ray turned round meets the same points") {
  check_reversal(random_capsule, 20000);
}
TEST_CASE("capsule: points, normals and (u, v)") {
  check_surface_points(random_capsule, 10000, true);
}
TEST_CASE("capsule: a ray that starts on it obeys its side") {
  check_starts(random_capsule, 100000, true);
}

TEST_CASE("capsule: each part of it is met where it is") {
  const Capsule capsule{.from = {0, 0, 0}, .to = {0, 4, 0}, .radius = 1};
  const auto across = crossings(capsule, {.origin = {-5, 1, 0}, .direction = {1, 0, 0}});
  REQUIRE(across.size() == 2);
  CHECK(faces(across) == 0);
  CHECK(across[0].t == 4);
  CHECK(across[1].t == 6);
  const auto along = crossings(capsule, {.origin = {0, -5, 0}, .direction = {0, 1, 0}});
  REQUIRE(along.size() == 2);
  CHECK(faces(along) == 12);
  CHECK(along[0].t == 4);
  CHECK(along[1].t == 10);
  CHECK(along[0].root == 0);
  CHECK(along[1].root == 1);
  const auto below = crossings(capsule, {.origin = {-5, -0.6, 0}, .direction = {1, 0, 0}});
  REQUIRE(below.size() == 2);
  CHECK(faces(below) == 11);
  CHECK(below[0].t == doctest::Approx(4.2).epsilon(1e-15));
  CHECK(below[1].t == doctest::Approx(5.8).epsilon(1e-15));
  CHECK(faces(crossings(capsule, {.origin = {-5, 4.6, 0}, .direction = {1, 0, 0}})) == 22);
  CHECK(faces(crossings(capsule, {.origin = {-2, 2, 0}, .direction = {1, 1.2, 0}})) == 2);
}

TEST_CASE("capsule: lines along the side and tangents of the tips do not enter") {
  const Capsule capsule{.from = {0, 0, 0}, .to = {0, 4, 0}, .radius = 1};
  CHECK(crossings(capsule, {.origin = {1, -5, 0}, .direction = {0, 1, 0}}).empty());
  CHECK(crossings(capsule, {.origin = {-5, 5, 0}, .direction = {1, 0, 0}}).empty());
  CHECK(crossings(capsule, {.origin = {-5, -1, 0}, .direction = {1, 0, 0}}).empty());
  CHECK(crossings(capsule, {.origin = {-5, 0, 1}, .direction = {1, 0, 0}}).empty());
  CHECK(crossings(capsule, {.origin = {1 - 0x1p-53, -5, 0}, .direction = {0, 1, 0}}).size() == 2);
}

TEST_CASE("capsule: a ray through a seam goes in and out once") {
  Random random(21);
  int at_seams = 0;
  for (int i = 0; i < 200000; ++i) {
    const Subject subject = random_capsule(random);
    const auto& capsule = std::get<Capsule>(subject.primitive);
    const Vec3 axis = glm::normalize(capsule.to - capsule.from);
    const Vec3 out = glm::normalize(glm::cross(axis, random.in_cube()));
    const Vec3& center = random.one_in(2) ? capsule.from : capsule.to;
    Vec3 direction = random.direction();
    // Half of the rays come nearly along the side, or graze it.
    if (random.one_in(2)) {
      direction = (random.one_in(2) ? axis : glm::cross(axis, out)) +
                  random.power_of_ten(-17, -1) * random.in_cube();
    }
    const double distance = random.one_in(4) ? 0 : subject.size * random.power_of_ten(-3, 3);
    const Vec3 target = center + capsule.radius * out;
    const core::ObjectRay ray{.origin = target - distance * direction, .direction = direction};
    const core::CrossingList found = crossings(capsule, ray);
    REQUIRE((found.empty() || found.size() == 2));
    const double squareness = std::abs(glm::dot(out, direction)) / glm::length(direction);
    if (squareness > 1e-4) REQUIRE(found.size() == 2);
    if (found.empty()) continue;
    REQUIRE(found[0].entering);
    REQUIRE_FALSE(found[1].entering);
    REQUIRE(found[0].t < found[1].t);
    if (squareness < 1e-4) continue;
    // One of the two is at the seam, where both surfaces have the same root to rounding.
    const RealRay real(ray);
    for (const core::Crossing& crossing : found) {
      const Real off = distance_from(capsule, real.at(crossing.t)) - Real(capsule.radius);
      const double far = glm::length(ray.origin) + 8 * subject.size;
      REQUIRE(magnitude(off) <= 0x1p-50 * far);
      at_seams += std::abs(crossing.t - distance) <= 1e-9 * subject.size ? 1 : 0;
    }
  }
  CHECK(at_seams > 100000);
}

TEST_CASE("capsule: lines next to a ruling keep their digits") {
  Random random(22);
  for (int i = 0; i < 20000; ++i) {
    const Subject subject = random_capsule(random);
    const auto& capsule = std::get<Capsule>(subject.primitive);
    const Vec3 axis = glm::normalize(capsule.to - capsule.from);
    const Vec3 aside = glm::normalize(glm::cross(axis, random.in_cube()));
    core::ObjectRay ray;
    ray.direction = axis + random.power_of_ten(-12, -1) * aside;
    ray.origin = capsule.from + capsule.radius * random.uniform(0, 1) * aside -
                 random.uniform(-2, 50) * subject.size * ray.direction;
    const RealRay real(ray);
    const std::vector<Real> candidates = subject.candidates(real);
    for (const core::Crossing& crossing : crossings(capsule, ray)) {
      Real nearest = 1e300;
      for (const Real root : candidates) nearest = std::min(nearest, magnitude(root - crossing.t));
      REQUIRE(nearest <= crossing.error);
    }
  }
}

TEST_CASE("capsule: its faces cross rays at the bits of the sphere and the cylinder they are of") {
  Random random(23);
  int same = 0;
  for (int i = 0; i < 5000; ++i) {
    const Subject subject = random_capsule(random);
    const auto& [from, to, radius, material] = std::get<Capsule>(subject.primitive);
    const Vec3 direction = random.direction();
    const core::ObjectRay ray{
        .origin = subject.center + subject.size * random.in_cube() - 5 * subject.size * direction,
        .direction = direction};
    const core::CrossingList parts[] = {
        crossings(Cylinder{.from = from, .to = to, .radius = radius}, ray),
        crossings(Sphere{.center = from, .radius = radius}, ray),
        crossings(Sphere{.center = to, .radius = radius}, ray)};
    for (const core::Crossing& crossing : crossings(subject.primitive, ray)) {
      const core::CrossingList& part = parts[crossing.face];
      const auto equal = [&](const core::Crossing& other) {
        return other.face == 0 && other.t == crossing.t && other.root == crossing.root;
      };
      REQUIRE(std::count_if(part.begin(), part.end(), equal) == 1);
      ++same;
    }
  }
  CHECK(same > 1000);
}

TEST_CASE("capsule: v goes from tip to tip by the length of the way, without a jump at the seams") {
  const Capsule capsule{.from = {0, 1, 0}, .to = {0, 3, 0}, .radius = 1};
  const auto shape = core::make_shape(capsule);
  const auto at = [&](double height, double radial) {
    const core::ObjectRay ray{.origin = {-5, height, radial}, .direction = {1, 0, 0}};
    core::CrossingList list;
    shape->crossings(ray, list);
    REQUIRE(!list.empty());
    return shape->surface_point(ray, list[0]);
  };
  const double way = std::numbers::pi + 2;
  CHECK(at(2, 0).v == doctest::Approx(0.5).epsilon(1e-15));
  CHECK(at(1.5, 0).v == doctest::Approx((std::numbers::pi / 2 + 0.5) / way).epsilon(1e-14));
  CHECK(at(1 - 1e-9, 0).v == doctest::Approx(at(1 + 1e-9, 0).v).epsilon(1e-8));
  CHECK(at(3 - 1e-9, 0).v == doctest::Approx(at(3 + 1e-9, 0).v).epsilon(1e-8));
  CHECK(at(1e-12, 0).v < 1e-5);
  CHECK(at(4 - 1e-12, 0).v > 1 - 1e-5);
  CHECK(at(0.5, 0.5).u ==
        doctest::Approx(at(1.5, at(0.5, 0.5).normal.z /
                                    std::hypot(at(0.5, 0.5).normal.x, at(0.5, 0.5).normal.z))
                            .u));
}

TEST_CASE("capsule: its box is tight") {
  const core::Bounds box =
      core::make_shape(Capsule{.from = {0, 0, 0}, .to = {3, 4, 0}, .radius = 0.5})->bounds();
  CHECK(box.lower.x == doctest::Approx(-0.5).epsilon(1e-14));
  CHECK(box.upper.x == doctest::Approx(3.5).epsilon(1e-14));
  CHECK(box.upper.y == doctest::Approx(4.5).epsilon(1e-14));
  CHECK(box.upper.z == doctest::Approx(0.5).epsilon(1e-14));
}

TEST_CASE("capsule: extreme shapes give finite answers") {
  const Capsule needle{.from = {0, -1e100, 0}, .to = {0, 1e100, 0}, .radius = 1e-100};
  CHECK(crossings(needle, {.origin = {-1, 5, 0}, .direction = {1, 0, 0}}).size() <= 2);
  CHECK(crossings(needle, {.origin = {-1e-99, 5, 0}, .direction = {1, 0, 0}}).size() == 2);
  const Capsule ball{.from = {0, 0, 0}, .to = {0, 1e-100, 0}, .radius = 1e100};
  const auto through = crossings(ball, {.origin = {0, 2e100, 0}, .direction = {0, -1, 0}});
  REQUIRE(through.size() == 2);
  CHECK(through[0].t == 1e100);
  CHECK(through[1].t == doctest::Approx(3e100).epsilon(1e-15));
}
