// What a scene has twice at one place counts once.
#include <doctest/doctest.h>

#include <vector>

#include "core/compile/compile.hpp"
#include "core/prepare/prepared_data.hpp"

using namespace crt;
using namespace crt::core;

namespace {

const Entity ball = Sphere{};
const Entity cutter = Sphere{.center = {0.5, 0, -0.5}, .radius = 0.8};
const Entity far_ball = Sphere{.center = {9, 0, 0}};

Entity moved(const Entity& entity, double x) {
  return entity.transformed({.translation = {x, 0, 0}});
}

std::size_t leaves_of(std::vector<Entity> entities) {
  return compile(entities).leaves.size();
}

}  // namespace

TEST_CASE("equal entities of a scene are one object, with the first one's number") {
  const std::vector<Entity> many(300'000, ball);
  const CompiledScene scene = compile(many);
  CHECK(scene.objects.size() == 1);
  CHECK(scene.leaves.size() == 1);
  CHECK(scene.leaves[0].entity_id == 0);
}

TEST_CASE("the numbers of other entities do not shift") {
  const CompiledScene scene =
      compile(std::vector<Entity>{ball, far_ball, ball, cutter, far_ball.with_id(7)});
  REQUIRE(scene.leaves.size() == 3);
  CHECK(scene.leaves[0].entity_id == 0);
  CHECK(scene.leaves[1].entity_id == 1);
  CHECK(scene.leaves[2].entity_id == 3);
}

TEST_CASE("what other rays pass is no duplicate") {
  CHECK(leaves_of({ball, ball.with_visible(false), ball.with_shadow(false), ball.with_shadow(false),
                   ball.with_shadow(true)}) == 3);
}

TEST_CASE("what was made anew with equal numbers is equal") {
  CHECK(leaves_of({Sphere{.radius = 2}, Sphere{.radius = 2}, Sphere{.radius = 3}}) == 2);
  CHECK(leaves_of({moved(ball, 0.25), moved(Sphere{}, 0.25), moved(ball, 0.5)}) == 2);
  CHECK(leaves_of({Triangle{}, Triangle{}, Triangle{.c = {1, 1, 0}}}) == 2);
  CHECK(leaves_of({Disc{}, Disc{}, Disc{.radius = 2}, Plane{}, Plane{}}) == 3);
}

TEST_CASE("equal parts of a union or an intersection, or equal cutters, are one") {
  const std::vector<Entity> many(5000, ball);
  CHECK(leaves_of({csg_union(many)}) == 1);
  CHECK(leaves_of({csg_intersection(many)}) == 1);
  CHECK(leaves_of({csg_difference(cutter, many)}) == 2);
  Entity united = cutter;
  Entity common = cutter;
  for (int i = 0; i < 5000; ++i) {
    united = united + ball;
    common = common ^ ball;
  }
  CHECK(leaves_of({united}) == 2);
  CHECK(leaves_of({common}) == 2);
  CHECK(compile(std::vector<Entity>{csg_union(many)}).programs.empty());
}

TEST_CASE("equal trees are one, deep inside of others as well") {
  const Entity cut = ball - cutter;
  CHECK(leaves_of({cut, cut, Sphere{} - cutter}) == 2);
  CHECK(leaves_of({(cut + far_ball) + (Sphere{} - cutter)}) == 3);
  const Entity box = Box{.corner_a = {-2, -2, -2}, .corner_b = {0.1, 2, 2}};
  CHECK(leaves_of({box - ((cut + moved(ball, 0.5)) ^ (moved(ball, 0.5) + cut))}) == 4);
  // These two are not equal, as what is cut from what differs.
  CHECK(leaves_of({cut, cutter - ball}) == 4);
}

TEST_CASE("an entity united with itself again and again is one") {
  Entity doubled = ball;
  for (int i = 0; i < 25; ++i) doubled = doubled + doubled;
  CHECK(leaves_of({doubled}) == 1);
  Entity common = ball;
  for (int i = 0; i < 25; ++i) common = common ^ common;
  CHECK(leaves_of({common}) == 1);
}

TEST_CASE("equal shapes of different materials are one only where none lets light through") {
  const auto with = [](const Material& material) { return ball.with_material(material); };
  const Material red = {.color = Color{1, 0, 0}};
  const Material mirror = {.reflectivity = 0.5};
  const Material glass = {.transparency = 0.5};
  CHECK(leaves_of({with(red), with(mirror)}) == 1);
  CHECK(leaves_of({with(glass), with(red)}) == 2);
  const SharedMaterial shared = glass;
  CHECK(leaves_of({ball.with_material(shared), ball.with_material(shared)}) == 1);
  // Of the parts of one solid the first is seen, whatever their materials are.
  CHECK(leaves_of({with(glass) + with(red)}) == 1);
  CHECK(compile(std::vector<Entity>{with(glass) + with(red)}).materials->of_leaves[0] == 0);
}

TEST_CASE("a ray crosses what is there twice once, and finds the first") {
  Scene scene;
  scene.entities = {far_ball, ball.with_id(5), cutter - ball, ball.with_id(6)};
  const PreparedData prepared(scene);
  RayWorkspace work;
  std::vector<RayHit> hits;
  const WorldRay ray{.origin = {-0.5, 0, -5}, .direction = {0, 0, 1}};
  prepared.crossings(ray, hits, work);
  REQUIRE(hits.size() == 2);
  CHECK(prepared.entity_id(hits[0]) == 5);
  CHECK(prepared.entity_id(hits[1]) == 5);
}
