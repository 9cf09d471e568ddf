// The evaluation of CSG objects by trees of boxes is compared with the plain one, and its cost is
// checked.
#include "core/csg/evaluate.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "core/math/vector.hpp"
#include "csg/continued_ray.hpp"
#include "csg/plain_evaluation.hpp"
#include "support/solids.hpp"

using namespace crt;
using namespace crt::test;
using core::CompiledScene;
using core::CsgEvaluation;
using core::CsgHit;
using core::CsgObject;
using core::CsgProgram;
using core::CsgWorkspace;
using core::WorldRay;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

CompiledScene compiled(const Entity& entity, Precision precision = Precision::standard) {
  return core::compile(std::span(&entity, 1), precision);
}

/// Compares along one ray. Returns how many hits there are.
std::size_t compare(const CompiledScene& scene, const WorldRay& ray, CsgWorkspace& work) {
  std::size_t hits = 0;
  for (const CsgObject& object : csg_objects(scene)) {
    const PlainEvaluation plain = evaluate_plainly(scene, object, ray);
    CsgEvaluation evaluation(object, ray, work);
    REQUIRE(evaluation.starts_inside() == plain.starts_inside);
    CsgHit hit;
    for (const CsgHit& expected : plain.hits) {
      REQUIRE(evaluation.next(hit));
      REQUIRE(hit.t == expected.t);
      REQUIRE(hit.t_low == expected.t_low);
      REQUIRE(hit.error == expected.error);
      REQUIRE(hit.leaf == expected.leaf);
      REQUIRE(hit.face == expected.face);
      REQUIRE(hit.entering == expected.entering);
      ++hits;
    }
    REQUIRE_FALSE(evaluation.next(hit));
  }
  return hits;
}

WorldRay random_ray(SolidMaker& make) {
  WorldRay ray;
  const bool on_grid = make.integer(0, 2) == 0;
  if (on_grid) {
    ray.origin = make.grid_point() * 2.0;
    do ray.direction = make.grid_point();
    while (ray.direction == Vec3(0));
  } else {
    ray.origin = {make.real(-9, 9), make.real(-9, 9), make.real(-9, 9)};
    ray.direction = Vec3(make.real(-3, 3), make.real(-3, 3), make.real(-3, 3)) - ray.origin;
  }
  switch (make.integer(0, 3)) {
    case 0:
      ray.t_min = -infinity;
      break;
    case 1:
      ray.t_min = make.real(-1, 2);
      ray.t_max = ray.t_min + make.real(0, 2);
      break;
    default:
      break;
  }
  return ray;
}

/// Returns a plate with n by n holes in it, across y.
Entity plate_with_holes(int n) {
  std::vector<Entity> holes;
  for (int x = 0; x < n; ++x) {
    for (int z = 0; z < n; ++z) {
      const Vec3 place{x + 0.5, 0, z + 0.5};
      holes.emplace_back(
          Cylinder{.from = place - Vec3(0, 2, 0), .to = place + Vec3(0, 2, 0), .radius = 0.3});
    }
  }
  return csg_difference(Box{.corner_a = {0, -1, 0}, .corner_b = {n * 1.0, 1, n * 1.0}}, holes);
}

/// Returns spheres one within the other, every second one cut out of the one before.
Entity shells(int n) {
  Entity solid = Sphere{.radius = 1};
  for (int i = 1; i < n; ++i) {
    const Sphere next{.radius = 1.0 + i};
    solid = csg_difference(next, std::vector<Entity>{solid});
  }
  return solid;
}

/// Returns nested operations, deep enough that paths take the place of counters.
Entity chain(SolidMaker& make, int length) {
  Entity result = make.leaf().entity();
  for (int i = 0; i < length; ++i) {
    const Entity other = make.tree(make.integer(0, 9) == 0 ? 2 : 0).entity();
    switch (make.integer(0, 8)) {
      case 0:
        result = result ^ (other + make.leaf().entity());
        break;
      case 1:
        result = other - result;
        break;
      case 2:
      case 3:
      case 4:
        result = result + other;
        break;
      default:
        result = result - other;
    }
  }
  return result;
}

/// Returns deep shells with a hole down to the core.
Entity alternating(int n) {
  return shells(n) - Cylinder{.from = {0, 0, 0}, .to = {0, 2.0 * n, 0}, .radius = 0.5};
}

}  // namespace

TEST_CASE(
    "a ray that starts on a face is on the side that it is said to be on, however flat it goes") {
  SolidMaker make(7);
  CsgWorkspace work;
  constexpr std::uint32_t upper_y = 3;
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 size(make.real(1, 3), make.real(1, 3), make.real(1, 3));
    const Vec3 corner(make.real(-9, 9), make.real(-9, 9), make.real(-9, 9));
    const Entity hole = Box{.corner_a = corner, .corner_b = corner + size};
    const bool is_cutter = trial % 2 == 0;
    const Vec3 around(1);
    const CompiledScene scene = compiled(
        is_cutter
            ? csg_difference(Box{.corner_a = corner - around, .corner_b = corner + size + around},
                             std::vector<Entity>{hole})
            : hole ^ Sphere{corner, 20});
    const CsgObject object = csg_objects(scene).front();
    // The ray starts on the hole's upper face, but for some last bits, and goes into it.
    WorldRay ray;
    ray.origin = corner + Vec3(0.5, 1, 0.5) * size;
    const double away = trial % 3 == 0 ? -infinity : infinity;
    for (int ulps = make.integer(0, 3); ulps > 0; --ulps)
      ray.origin.y = std::nextafter(ray.origin.y, away);
    ray.direction = {make.real(-1, 1), -std::exp2(make.real(-80, 0)), make.real(-1, 1)};
    std::uint32_t leaf = object.first_leaf;
    while (scene.leaves[leaf].face_count != 6 || scene.leaves[leaf].complemented != is_cutter)
      ++leaf;
    const core::FaceSurface& surface = scene.face_surfaces[scene.leaves[leaf].first_face + upper_y];
    ray.start = {.leaf = leaf,
                 .face = upper_y,
                 .surface = surface.surface,
                 .side = surface.flipped ? core::Side::outside : core::Side::inside,
                 .t_error = core::start_rounding * core::largest_component(ray.origin)};
    CsgEvaluation evaluation(object, ray, work);
    REQUIRE(evaluation.starts_inside() == !is_cutter);
    CsgHit hit;
    REQUIRE(evaluation.next(hit));
    REQUIRE(hit.entering == is_cutter);
    REQUIRE(hit.t > 0.01);
  }
}

TEST_CASE("the tree of boxes agrees with the plain evaluation to the bit") {
  std::size_t hits = 0;
  CsgWorkspace work;
  for (std::uint32_t seed = 0; seed < 600; ++seed) {
    SolidMaker make(seed);
    const Solid solid = make.tree(4);
    const Precision precision = seed % 4 == 3 ? Precision::exact : Precision::standard;
    const CompiledScene scene = compiled(solid.entity(), precision);
    CAPTURE(seed);
    for (int i = 0; i < 100; ++i) hits += compare(scene, random_ray(make), work);
  }
  CHECK(hits > 10000);
}

TEST_CASE("rays that start on the object agree with the plain evaluation to the bit") {
  std::size_t hits = 0;
  CsgWorkspace work;
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    SolidMaker make(seed);
    const CompiledScene scene = compiled(make.tree(4).entity());
    CAPTURE(seed);
    for (int i = 0; i < 30; ++i) {
      const WorldRay ray = random_ray(make);
      for (const CsgObject& object : csg_objects(scene)) {
        for (const CsgHit& hit : evaluate_plainly(scene, object, ray).hits) {
          const Vec3 direction = make.integer(0, 1) == 0 ? ray.direction : make.grid_point();
          if (direction == Vec3(0)) continue;
          for (const core::Side side : {core::Side::outside, core::Side::inside}) {
            hits += compare(scene, continued(scene, object, ray, hit, direction, side), work);
          }
        }
      }
    }
  }
  CHECK(hits > 2000);
}

TEST_CASE("large objects agree with the plain evaluation to the bit") {
  CsgWorkspace work;
  for (const Entity& entity : {plate_with_holes(12), shells(60)}) {
    const CompiledScene scene = compiled(entity);
    REQUIRE(scene.programs.size() == 1);
    SolidMaker make(7);
    std::size_t hits = 0;
    for (int i = 0; i < 500; ++i) {
      const WorldRay ray = random_ray(make);
      hits += compare(scene, ray, work);
    }
    CHECK(hits > 500);
  }
}

TEST_CASE("deep chains of operations agree with the plain evaluation to the bit") {
  CsgWorkspace work;
  std::size_t hits = 0;
  std::size_t deep = 0;
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    SolidMaker make(1000 + seed);
    const Precision precision = seed % 4 == 3 ? Precision::exact : Precision::standard;
    const CompiledScene scene = compiled(chain(make, make.integer(100, 300)), precision);
    CAPTURE(seed);
    for (const CsgProgram* const program : scene.programs) deep += !program->paths.empty();
    for (int i = 0; i < 40; ++i) {
      const WorldRay ray = random_ray(make);
      hits += compare(scene, ray, work);
      for (const CsgObject& object : csg_objects(scene)) {
        for (const CsgHit& hit : evaluate_plainly(scene, object, ray).hits) {
          const core::Side side =
              make.integer(0, 1) == 0 ? core::Side::outside : core::Side::inside;
          hits += compare(scene, continued(scene, object, ray, hit, ray.direction, side), work);
        }
      }
    }
  }
  CHECK(deep > 40);
  CHECK(hits > 1500);
}

TEST_CASE("a hundred shells agree with the plain evaluation to the bit") {
  const CompiledScene scene = compiled(alternating(100));
  REQUIRE(scene.programs.size() == 1);
  REQUIRE_FALSE(scene.programs[0]->paths.empty());
  CsgWorkspace work;
  SolidMaker make(3);
  std::size_t hits = 0;
  for (int i = 0; i < 60; ++i) {
    WorldRay ray = random_ray(make);
    if (i % 2 == 0)
      ray = {.origin = {make.real(-1, 1), 300, make.real(-1, 1)}, .direction = {0, -1, 0}};
    hits += compare(scene, ray, work);
  }
  CHECK(hits > 2000);
}

TEST_CASE("a ray asks the holes that it comes near, however many there are") {
  // The ray goes slanted through the top of the plate to a hole's wall.
  const WorldRay ray{.origin = {5.1, 4, 5.5}, .direction = {0.4, -3, 0.1}};
  std::uint64_t events = 0;
  for (const int n : {10, 100}) {
    const CompiledScene scene = compiled(plate_with_holes(n));
    CsgWorkspace work;
    CsgEvaluation evaluation(csg_objects(scene)[0], ray, work);
    CsgHit hit;
    while (evaluation.next(hit)) continue;
    if (n == 10) events = work.events;
    CHECK(work.events > 0);
    CHECK(work.events <= events);
  }
}

TEST_CASE("what lies behind the first hit is not asked") {
  const CompiledScene scene = compiled(plate_with_holes(30));
  // The ray goes along the plate, through all holes of a row. The first hit is its side.
  const WorldRay ray{.origin = {-5, 0.1, 3.5}, .direction = {1, 0, 0}};
  CsgWorkspace work;
  CsgEvaluation evaluation(csg_objects(scene)[0], ray, work);
  CsgHit hit;
  REQUIRE(evaluation.next(hit));
  CHECK(hit.t == 5);
  CHECK(work.events <= 4);
  while (evaluation.next(hit)) continue;
  CHECK(work.events == 62);
}
