// The densities of solids are those of their materials.
#include <doctest/doctest.h>

#include <limits>
#include <vector>

#include "crt/error.hpp"
#include "crt/measure.hpp"
#include "crt/primitives.hpp"
#include "crt/settings.hpp"
#include "crt/transform.hpp"

using namespace crt;

namespace {

const Material steel{.density = 7850};
const PrincipledMaterial resin{.density = 1150};

Entity cube(double at) {
  return Box{.corner_a = {at, 0, 0}, .corner_b = {at + 1, 1, 1}};
}

}  // namespace

TEST_CASE("a solid has the density of its material, of either kind") {
  CHECK(density(cube(0)) == 0);
  CHECK(density(Sphere{.material = steel}) == 7850);
  CHECK(density(cube(0).with_material(resin)) == 1150);
  CHECK(density(cube(0).with_material(steel).transformed(scale({2, 2, 2})).with_id(7)) == 7850);
  // The innermost material holds.
  CHECK(density(cube(0).with_material(steel).with_material(resin)) == 7850);
  CHECK(density((cube(0) + cube(3)).with_material(steel)) == 7850);
  CHECK(density(empty_entity()) == 0);
}

TEST_CASE("what cuts a solid has no part in its density") {
  const Entity plate = cube(0).with_material(steel);
  CHECK(density(plate - cube(0.5)) == 7850);
  CHECK(density(plate - cube(0.5).with_material(resin)) == 7850);
  CHECK(density(plate ^ cube(0.5).with_material(resin)) == 7850);
}

TEST_CASE("parts of different densities have none together") {
  const Entity plate = cube(0).with_material(steel);
  CHECK_THROWS_AS(density(plate + cube(3).with_material(resin)), Error);
  CHECK_THROWS_AS(density(plate + cube(3)), Error);
  CHECK(density(plate + cube(3).with_material(steel)) == 7850);
}

TEST_CASE("a tree that holds a part many million times has its density at once") {
  Entity tree = cube(0);
  for (int i = 0; i < 60; ++i) tree = tree + tree.transformed(translate({2, 0, 0}));
  CHECK(density(tree.with_material(steel)) == 7850);
}

TEST_CASE("a density is at least 0 and finite") {
  for (const double wrong :
       {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    CHECK_THROWS_AS(SharedMaterial(Material{.density = wrong}), Error);
    CHECK_THROWS_AS(SharedMaterial(PrincipledMaterial{.density = wrong}), Error);
  }
}

TEST_CASE("units are so many metres") {
  CHECK(metres_of(Unit::m) == 1);
  CHECK(metres_of(Unit::cm) == 0.01);
  CHECK(metres_of(Unit::mm) == 0.001);
  CHECK(metres_of(Unit::in) == 0.0254);
}
