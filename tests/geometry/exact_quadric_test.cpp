#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/exact_tools.hpp"
#include "geometry/quadrics.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// A WholeQuadric has small whole coefficients.
struct WholeQuadric {
  WholeVec squares, products, linear;
  Whole constant = 0;

  Quadric quadric() const {
    return {.squares = as_vec3(squares),
            .products = as_vec3(products),
            .linear = as_vec3(linear),
            .constant = static_cast<double>(constant)};
  }
  WholeVec curved(const WholeVec& v) const {
    const auto& [xy, xz, yz] = products;
    return {2 * squares[0] * v[0] + xy * v[1] + xz * v[2],
            xy * v[0] + 2 * squares[1] * v[1] + yz * v[2],
            xz * v[0] + yz * v[1] + 2 * squares[2] * v[2]};
  }
};

WholeQuadric small_quadric(Random& random) {
  while (true) {
    WholeQuadric whole{.squares = small_vector(random, 2),
                       .products = small_vector(random, 2),
                       .linear = small_vector(random, 3)};
    if (random.one_in(2)) whole.products = {0, 0, 0};
    if (random.one_in(3)) whole.linear = {0, 0, 0};
    whole.constant = small_vector(random, 4)[0];
    try {
      core::validate(whole.quadric());
      return whole;
    } catch (const std::exception&) {
      continue;
    }
  }
}

struct Found {
  core::CrossingList list;
  bool starts_inside = false;
};

Found found_by(const Primitive& primitive, const WholeRay& ray) {
  const core::Placement placement{core::PreciseTransform(ray.transform())};
  const Vec3 origin = as_vec3(ray.world_origin);
  const Vec3 direction = as_vec3(ray.world_direction);
  const core::ObjectRay object_ray = placement.to_object(origin, direction);
  Found result;
  result.starts_inside = core::make_exact_shape(primitive)->crossings(
      placement.to_object_exactly(origin, direction, object_ray), result.list);
  return result;
}

}  // namespace

TEST_CASE("exact quadric: whole-number lines that miss, touch, lie within and hit are separated") {
  Random random(1);
  int touching = 0;
  int within = 0;
  int once = 0;
  int twice = 0;
  for (int i = 0; i < 60000; ++i) {
    const WholeQuadric whole = small_quadric(random);
    const WholeRay ray = small_ray(random);
    // These are coefficients of 2 f times the square of the weight.
    const WholeVec linear = ray.weight * whole.linear;
    WholeVec slope = whole.curved(ray.origin);
    for (std::size_t axis = 0; axis < 3; ++axis) slope[axis] += linear[axis];
    const Whole a = dot(ray.direction, whole.curved(ray.direction));
    const Whole b = dot(ray.direction, slope);
    const Whole c = dot(ray.origin, slope) + dot(ray.origin, linear) +
                    2 * whole.constant * ray.weight * ray.weight;
    const Whole discriminant = b * b - a * c;
    const auto [found, starts_inside] = found_by(whole.quadric(), ray);
    if (a == 0 && b == 0) {
      ++within;
      REQUIRE(found.empty());
      REQUIRE(starts_inside == (c < 0));
    } else if (a == 0) {
      ++once;
      REQUIRE(found.size() == 1);
      REQUIRE(found[0].entering == (b < 0));
      REQUIRE(starts_inside == (b > 0));
      REQUIRE(is_last_bit(found[0], static_cast<Real>(-c) / static_cast<Real>(2 * b)));
    } else if (discriminant <= 0) {
      touching += discriminant == 0 ? 1 : 0;
      REQUIRE(found.empty());
      REQUIRE(starts_inside == (a < 0));
    } else {
      ++twice;
      const Real root = square_root(static_cast<Real>(discriminant));
      const Real q = b > 0 ? -(static_cast<Real>(b) + root) : root - static_cast<Real>(b);
      const Real one = q / static_cast<Real>(a);
      const Real other = static_cast<Real>(c) / q;
      REQUIRE(found.size() == 2);
      REQUIRE(starts_inside == (a < 0));
      REQUIRE(found[0].entering == (a > 0));
      REQUIRE(found[1].entering == (a < 0));
      REQUIRE(is_last_bit(found[0], one < other ? one : other));
      REQUIRE(is_last_bit(found[1], one < other ? other : one));
    }
  }
  CHECK(touching > 100);
  CHECK(within > 100);
  CHECK(once > 1000);
  CHECK(twice > 10000);
}

TEST_CASE("exact quadric: one ulp decides beside a tangent, a ruling and an apex") {
  const Quadric waist{.squares = {1, 1, -1}, .constant = -1};
  const Quadric cone{.squares = {1, 1, -1}, .constant = 0};
  for (const double far : {1.0, 1e3, 1e9, 1e15}) {
    const auto count = [&](const Quadric& quadric, const Vec3& at, const Vec3& along) {
      return exact_crossings(quadric, {}, at - far * along, along).size();
    };
    const Vec3 ruling(0, 1, 1);
    CHECK(count(waist, {1, 0, 0}, ruling) == 0);
    CHECK(count(waist, {1 - 0x1p-53, 0, 0}, ruling) == 0);
    CHECK(count(waist, {1, 0, 0}, {0, 1, 0}) == 0);
    CHECK(count(waist, {1 - 0x1p-53, 0, 0}, {0, 1, 0}) == 2);
    CHECK(count(waist, {1 + 0x1p-52, 0, 0}, {0, 1, 0}) == 0);
    CHECK(count(cone, {0, 0, 0}, {3, 4, 2}) == 0);
    CHECK(count(cone, {0, 0, 0x1p-52}, {3, 4, 0}) == 2);
    CHECK(count(cone, {0, 0, 0x1p-1000}, {1, 0, 0}) == 2);
  }
  CHECK(exact_crossings(waist, {}, {1, 0x1p-30, 0}, {0, 1, 1}).size() == 1);
  CHECK(exact_crossings(waist, {}, {1, 0x1p-300, -1}, {0, 1, 1}).size() == 1);
}

TEST_CASE("exact quadric: t is right to the last bit at any distance, grazing too") {
  Random random(2);
  int hits = 0;
  for (int i = 0; i < 30000; ++i) {
    const PlacedQuadric placed = random_quadric(random);
    const Vec3 direction = random.direction();
    const Vec3 target = placed.center + (0.9 * placed.size) * random.in_cube();
    const Vec3 origin = target - direction * (placed.size * random.power_of_ten(-1, 4));
    const QuadricTerms terms(placed.quadric, RealVec(origin), RealVec(direction));
    const Real square = terms.b * terms.b;
    const Real discriminant = square - terms.a * terms.c;
    if (magnitude(discriminant) < 1e-20 * square || magnitude(terms.a) == 0) continue;
    const core::CrossingList found = exact_crossings(placed.quadric, {}, origin, direction);
    REQUIRE(found.size() == (discriminant > 0 ? 2 : 0));
    if (found.empty()) continue;
    ++hits;
    const Real half = square_root(discriminant);
    const Real q = terms.b > 0 ? -(terms.b + half) : half - terms.b;
    const Real one = q / terms.a;
    const Real other = terms.c / q;
    for (std::size_t k = 0; k < 2; ++k) {
      const Real truth = (one < other) == (k == 0) ? one : other;
      const Real ulp = std::nextafter(std::abs(found[k].t), HUGE_VAL) - std::abs(found[k].t);
      REQUIRE(magnitude(Real{found[k].t} - truth) <= 0.51 * ulp);
    }
  }
  CHECK(hits > 10000);
}

TEST_CASE("exact quadric: a ray that starts on it meets it again where the identity says") {
  Random random(3);
  for (int i = 0; i < 10000; ++i) {
    const PlacedQuadric placed = random_quadric(random);
    const Vec3 direction = random.direction();
    const Vec3 aim = placed.center + (0.5 * placed.size) * random.in_cube();
    const core::ObjectRay first{.origin = aim - placed.size * direction, .direction = direction};
    const auto shape = core::make_shape(placed.quadric);
    core::CrossingList crossings;
    shape->crossings(first, crossings);
    for (const core::Crossing& crossing : crossings) {
      const core::SurfacePoint point = shape->surface_point(first, crossing);
      const Vec3 d = random.direction();
      if (std::abs(glm::dot(point.normal, d)) < 1e-3) continue;
      const bool inwards = glm::dot(point.normal, d) < 0;
      const core::FaceStart start{.face = 0,
                                  .side = inwards ? core::Side::inside : core::Side::outside};
      const auto found = exact_crossings(placed.quadric, {}, point.position, d, start);
      const QuadricTerms terms(placed.quadric, RealVec(point.position), RealVec(d));
      if (magnitude(terms.a) * placed.size < magnitude(terms.b) * Real{1e-9}) continue;
      const Real other = -2 * terms.b / terms.a;
      if (magnitude(other) < Real{1e-9} * placed.size) continue;
      REQUIRE(found.size() == 2);
      const std::size_t place = other > 0 ? 0 : 1;
      REQUIRE(found[place].t == 0);
      REQUIRE(found[place].entering == inwards);
      REQUIRE(is_last_bit(found[1 - place], other));
    }
  }
}
