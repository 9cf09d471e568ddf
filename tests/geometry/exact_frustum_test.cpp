#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/exact_tools.hpp"

using namespace crt;
using namespace crt::test;

namespace {

struct WholeCone {
  WholeVec from, to;
  Whole from_radius = 1;
  Whole to_radius = 1;

  Primitive primitive() const {
    if (from_radius == to_radius) {
      return Cylinder{
          .from = as_vec3(from), .to = as_vec3(to), .radius = static_cast<double>(from_radius)};
    }
    return Cone{.from = as_vec3(from),
                .to = as_vec3(to),
                .radius = static_cast<double>(from_radius),
                .radius2 = static_cast<double>(to_radius)};
  }
};

WholeCone small_cone(Random& random) {
  WholeCone cone;
  cone.from = small_vector(random, 3);
  do cone.to = small_vector(random, 3);
  while (cone.to == cone.from);
  cone.from_radius = 1 + static_cast<Whole>(random.bits() % 4);
  cone.to_radius = random.one_in(3) ? cone.from_radius : static_cast<Whole>(random.bits() % 4);
  return cone;
}

/// A Span is where the line enters and leaves. It is found by asking on which side of every root of
/// the two planes and of the double cone it is inside.
struct Span {
  bool hit = false;
  Real enter = 0, leave = 0;
};

Span true_span(const WholeCone& cone, const WholeRay& ray) {
  const WholeVec axis = cone.to - cone.from;
  const Whole length2 = dot(axis, axis);
  const WholeVec offset = ray.origin - ray.weight * cone.from;
  const Whole z0 = dot(offset, axis);
  const Whole z1 = dot(ray.direction, axis);
  const Whole growth = cone.to_radius - cone.from_radius;
  const WholeVec across = cross(offset, axis);
  const WholeVec turning = cross(ray.direction, axis);
  const Whole s0 = ray.weight * cone.from_radius * length2 + growth * z0;
  const Whole s1 = growth * z1;
  const Whole a = length2 * dot(turning, turning) - s1 * s1;
  const Whole b = length2 * dot(across, turning) - s0 * s1;
  const Whole c = length2 * dot(across, across) - s0 * s0;

  std::vector<Real> places;
  if (z1 != 0) {
    places.push_back(static_cast<Real>(-z0) / static_cast<Real>(z1));
    places.push_back(static_cast<Real>(ray.weight * length2 - z0) / static_cast<Real>(z1));
  }
  const Whole discriminant = b * b - a * c;
  if (a != 0 && discriminant >= 0) {
    const Real root = square_root(static_cast<Real>(discriminant));
    const Real q = b > 0 ? -(static_cast<Real>(b) + root) : root - static_cast<Real>(b);
    places.push_back(q / static_cast<Real>(a));
    if (q != 0) places.push_back(static_cast<Real>(c) / q);
  } else if (a == 0 && b != 0) {
    places.push_back(static_cast<Real>(-c) / static_cast<Real>(2 * b));
  }
  std::sort(places.begin(), places.end());
  const auto inside = [&](Real t) {
    const Real z = static_cast<Real>(z0) + t * static_cast<Real>(z1);
    const Real g = static_cast<Real>(c) + t * (2 * static_cast<Real>(b) + t * static_cast<Real>(a));
    return z > 0 && z < static_cast<Real>(ray.weight * length2) && g < 0;
  };
  Span result;
  constexpr Real same = 1e-20;  // far less than the distance of any two roots of numbers so small
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    if (places[i + 1] - places[i] < same * (1 + magnitude(places[i]))) continue;
    if (!inside((places[i] + places[i + 1]) / 2)) continue;
    if (!result.hit) result.enter = places[i];
    result.leave = places[i + 1];
    result.hit = true;
  }
  return result;
}

}  // namespace

TEST_CASE("exact cylinder and cone: whole-number lines that miss, touch and hit are separated") {
  Random random(1);
  int hits = 0;
  for (int i = 0; i < 60000; ++i) {
    const WholeRay ray = small_ray(random);
    const WholeCone cone = small_cone(random);
    const Span truth = true_span(cone, ray);
    const core::CrossingList found = exact_crossings(cone.primitive(), ray);
    CAPTURE(i);
    REQUIRE(found.size() == (truth.hit ? 2 : 0));
    if (!truth.hit) continue;
    ++hits;
    REQUIRE(is_last_bit(found[0], truth.enter));
    REQUIRE(is_last_bit(found[1], truth.leave));
    REQUIRE(found[0].entering);
    REQUIRE_FALSE(found[1].entering);
  }
  CHECK(hits > 10000);
}

TEST_CASE(
    "exact cylinder: one ulp decides at the silhouette and at the rim, in a turned space as well") {
  const Transform turn{
      {3, -4, 0}, {4, 3, 0}, {0, 0, 5}, {0, 0, 0}};  // a turn by the triangle of three, four and
                                                     // five, and a scaling by five
  const Cylinder cylinder{.from = {0, 0, -1}, .to = {0, 0, 1}, .radius = 1};
  for (const double far : {1.0, 1e3, 1e9, 1e15}) {
    // These rays pass the side, across the axis.
    const auto past = [&](double x, double z) {
      return exact_crossings(cylinder, turn, {x, -far, z}, {0, 1, 0}).size();
    };
    CHECK(past(5, 0) == 0);
    CHECK(past(std::nextafter(5, 0), 0) == 2);
    CHECK(past(0, 5) == 0);
    CHECK(past(0, std::nextafter(5, 0)) == 2);
    // These rays are along the axis, three and four from it.
    const auto along = [&](double x) {
      return exact_crossings(cylinder, turn, {x, 4, -far}, {0, 0, 1}).size();
    };
    CHECK(along(3) == 0);
    CHECK(along(std::nextafter(3, 0)) == 2);
    CHECK(along(std::nextafter(3, 4)) == 0);
  }
}

TEST_CASE("exact cone: a line through the apex goes in only between the directions of its side") {
  const Cone cone{.from = {0, 0, 0}, .to = {0, 0, 1}, .radius = 1, .radius2 = 0};
  for (const double far : {1.0, 0x1p30}) {
    const auto through_apex = [&](double slope) {
      return exact_crossings(cone, {}, {-far, 0, 1 + slope * far}, {1, 0, -slope}).size();
    };
    CHECK(through_apex(0x1p-20) == 0);
    CHECK(through_apex(1) == 0);  // along the side itself
    CHECK(through_apex(1 + 0x1p-20) == 2);
  }
  CHECK(exact_crossings(cone, {}, {0, 0, 5}, {0, 0, -1}).size() == 2);
  CHECK(exact_crossings(cone, {}, {-3, 0, 1}, {1, 0, 0}).empty());
  CHECK(exact_crossings(cone, {}, {-3, 0, std::nextafter(1, 0)}, {1, 0, 0}).size() == 2);
}

TEST_CASE("exact cylinder and cone: powers of two scale them to the bit") {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Cone cone{.from = random.in_cube(),
                    .to = random.in_cube(),
                    .radius = random.uniform(0.1, 1),
                    .radius2 = random.one_in(3) ? 0 : random.uniform(0.1, 1)};
    const Vec3 direction = random.direction();
    const Vec3 origin = random.in_cube() * 4.0;
    const auto here = exact_crossings(cone, {}, origin, direction);
    for (const int power : {-300, -1, 300}) {
      const double factor = std::ldexp(1.0, power);
      const Cone scaled{.from = cone.from * factor,
                        .to = cone.to * factor,
                        .radius = cone.radius * factor,
                        .radius2 = cone.radius2 * factor};
      const auto there = exact_crossings(scaled, {}, origin * factor, direction);
      REQUIRE(here.size() == there.size());
      for (std::size_t k = 0; k < here.size(); ++k) REQUIRE(here[k].t * factor == there[k].t);
    }
  }
}

TEST_CASE(
    "exact cylinder and cone: a ray that starts on the side meets the rest as the standard tier "
    "has it") {
  Random random(4);
  int compared = 0;
  for (int i = 0; i < 20000; ++i) {
    const Cone cone{.from = {0, 0, 0},
                    .to = {0, 0, random.uniform(0.5, 2)},
                    .radius = 1,
                    .radius2 = random.one_in(3) ? 1 : random.uniform(0, 2)};
    const double height = random.uniform(0, 1);
    const double angle = random.uniform(0, 6.28);
    const double radius = cone.radius + (cone.radius2 - cone.radius) * height;
    const Vec3 point{radius * std::cos(angle), radius * std::sin(angle), height * cone.to.z};
    const Vec3 normal = glm::normalize(
        Vec3(std::cos(angle) * cone.to.z, std::sin(angle) * cone.to.z, cone.radius - cone.radius2));
    const Vec3 direction = random.direction();
    if (std::abs(glm::dot(direction, normal)) < 1e-6) continue;
    const bool inwards = glm::dot(direction, normal) < 0;
    const core::FaceStart start{.face = 0,
                                .side = inwards ? core::Side::inside : core::Side::outside};
    const core::CrossingList found = exact_crossings(cone, {}, point, direction, start);
    core::ObjectRay ray{.origin = point, .direction = direction};
    ray.start = start;
    core::CrossingList standard;
    core::make_shape(cone)->crossings(ray, standard);
    CAPTURE(i);
    REQUIRE(found.size() == standard.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      REQUIRE(found[k].face == standard[k].face);
      REQUIRE(found[k].entering == standard[k].entering);
      REQUIRE(found[k].root == standard[k].root);
      REQUIRE((found[k].t == 0) == (standard[k].t == 0));
      REQUIRE(std::abs(found[k].t - standard[k].t) <= standard[k].error + 1e-12);
      ++compared;
    }
  }
  CHECK(compared > 20000);
}
