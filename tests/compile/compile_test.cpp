// These tests compile scenes, however large or deep, on any number of threads.
#include "core/compile/compile.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/compile/surface_table.hpp"
#include "core/entity/entity_node.hpp"
#include "crt/query.hpp"
#include "support/same_scene.hpp"

using namespace crt;
using namespace crt::core;

namespace {

class Random {
 public:
  double real(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3 point(double size) { return {real(-size, size), real(-size, size), real(-size, size)}; }
  Entity ball(double size, double radius) {
    return Sphere{.center = point(size), .radius = radius};
  }
  std::vector<Entity> balls(int count, double size, double radius) {
    std::vector<Entity> result;
    for (int i = 0; i < count; ++i) result.push_back(ball(size, radius));
    return result;
  }

 private:
  std::mt19937 engine_{1};
};

/// Makes enough of everything that more than one thread has work.
std::vector<Entity> mixed_entities() {
  Random random;
  std::vector<Entity> entities = random.balls(20'000, 50, 0.1);
  const Entity block = Box{.corner_a = {-9, -9, -9}, .corner_b = {9, 9, 9}};
  entities.push_back(csg_difference(block, random.balls(20'000, 9, 0.2)));
  entities.push_back(csg_union(random.balls(20'000, 9, 0.05)));
  for (int i = 0; i < 3000; ++i) {
    const Entity pair = random.ball(1, 1) ^ random.ball(1, 1);
    entities.push_back(
        (pair - Box{}).transformed(rotate_degrees(random.point(180))).with_material(Material{}));
    entities.push_back(Entity(Box{}).transformed(translate(random.point(3))));
  }
  Entity chain = block;
  for (int i = 0; i < 10'000; ++i) {
    const Entity ball = random.ball(9, 1);
    chain = i % 2 == 0 ? chain - ball : chain + ball;
  }
  entities.push_back(chain);
  return entities;
}

}  // namespace

TEST_CASE("a scene is compiled to the same on any number of threads") {
  const std::vector<Entity> entities = mixed_entities();
  const CompiledScene scene = compile(entities, Precision::standard, 1);
  CHECK(scene.leaves.size() > 80'000);
  for (const int threads : {0, 2, 5}) {
    const CompiledScene other = compile(entities, Precision::standard, threads);
    CHECK(test::same_scene(scene, other));
    CHECK(test::same_materials(*scene.materials, *other.materials));
    CHECK(scene.stores[0]->placements.size() == other.stores[0]->placements.size());
  }
}

TEST_CASE("faces are on one surface if the surfaces agree, among very many") {
  // The union has each ball three times, brought to its place by different transforms, and one of
  // each stands alone.
  Random random;
  const std::vector<Entity> balls = random.balls(10'000, 9, 1);
  std::vector<Entity> parts = balls;
  for (const double moved : {0.5, 1.0}) {
    for (const Entity& ball : balls) {
      const auto& sphere = std::get<Sphere>(std::get<Primitive>(ball.node().content));
      const Vec3 offset = moved * sphere.center;
      const Entity begun = Sphere{.center = sphere.center - offset, .radius = sphere.radius};
      parts.push_back(begun.transformed({.translation = offset}));
    }
  }
  std::vector<Entity> entities{csg_union(parts)};
  entities.insert(entities.end(), balls.begin(), balls.end());
  const CompiledScene scene = compile(entities);
  REQUIRE(scene.objects.size() == 10'001);
  REQUIRE(scene.programs[0]->shared_surfaces == 10'000);
  std::vector<bool> seen(10'000, false);
  for (std::uint32_t ball = 0; ball < 10'000; ++ball) {
    for (std::uint32_t copy = 0; copy < 4; ++copy) {
      const FaceSurface& face = scene.face_surfaces[scene.leaves[ball + copy * 10'000].first_face];
      REQUIRE(face.surface == scene.face_surfaces[scene.leaves[ball].first_face].surface);
      if (copy == 3) {
        REQUIRE(face.shared == FaceSurface::not_shared);  // not in its own object
      } else {
        REQUIRE(face.shared == scene.face_surfaces[scene.leaves[ball].first_face].shared);
      }
    }
    const std::uint32_t shared = scene.face_surfaces[scene.leaves[ball].first_face].shared;
    REQUIRE(shared < 10'000);
    REQUIRE_FALSE(seen[shared]);
    seen[shared] = true;
  }
}

TEST_CASE("surfaces whose hashes agree by chance are different surfaces") {
  const Sphere a{.center = {1, 2, 0}};
  const Sphere b{.center = {117699.125, -0x1.b630a802b630ap+3, 0}};
  const auto hash = [](const Sphere& ball) {
    return canonical_surface(make_shape(ball)->surface(0), Placement()).hash();
  };
  REQUIRE(hash(a) == hash(b));
  const CompiledScene scene = compile(std::vector<Entity>{a, b, a, b, a});
  const auto surface = [&](std::size_t leaf) {
    return scene.face_surfaces[scene.leaves[leaf].first_face].surface;
  };
  CHECK(surface(0) != surface(1));
  CHECK(surface(0) == surface(2));
  CHECK(surface(0) == surface(4));
  CHECK(surface(1) == surface(3));
}

TEST_CASE("a hundred thousand operations in one another are compiled") {
  for (const bool first : {true, false}) {
    Random random;
    Entity chain = Box{.corner_a = {-9, -9, -9}, .corner_b = {9, 9, 9}};
    for (int i = 0; i < 100'000; ++i) {
      const Entity ball = random.ball(9, 0.3);
      if (first) {
        chain = i % 2 == 0 ? chain - ball : chain + ball;
      } else {
        chain = i % 2 == 0 ? ball - chain : ball + chain;
      }
    }
    CHECK(chain.primitive_count() == 100'001);
    CHECK(compile(std::span(&chain, 1)).leaves.size() == 100'001);
  }
}

TEST_CASE("parts that come apart one by one only take no longer for that") {
  // Around a core, slabs lie on six sides in turn. Each plane that misses all boxes has only one of
  // them behind it.
  std::vector<Entity> parts{Sphere{}};
  double size = 1;
  for (int i = 0; i < 20'000; ++i) {
    const double next = size * (1 + 0x1p-8);
    const int axis = i / 2 % 3;
    const double sign = i % 2 == 0 ? 1 : -1;
    Vec3 near{-size, -size, -size};
    Vec3 far{size, size, size};
    near[axis] = sign * (size + next) / 2;
    far[axis] = sign * next;
    parts.emplace_back(Box{.corner_a = near, .corner_b = far});
    size = next;
  }
  const Entity all = csg_union(parts);
  const CompiledScene scene = compile(std::span(&all, 1));
  CHECK(scene.leaves.size() == parts.size());
  CHECK(scene.objects.size() > 10);
}

TEST_CASE("a bounding box holds all that rays meet of an entity") {
  Random random;
  std::vector<Entity> entities = {
      csg_union(random.balls(30, 5, 0.4)),
      csg_difference(Box{}, random.balls(10, 1, 0.4)),
      Entity(Torus{}).transformed(rotate_degrees({20, 50, 110})).transformed(scale({1, 3, 0.2})),
      Entity(Cone{}) ^ random.ball(0.5, 0.8),
      Capsule{.from = {1e9, 0, 0}, .to = {1e9, 5, 3}},
      Disc{.normal = {1, 2, 3}}};
  for (const Entity& entity : entities) {
    const BoundingBox box = bounding_box(entity);
    REQUIRE(box.lower.x <= box.upper.x);
    const Vec3 middle = (box.lower + box.upper) * 0.5;
    Scene scene;
    scene.entities = {entity};
    const PreparedScene prepared = prepare(scene);
    std::size_t found = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vec3 origin = middle + random.point(20);
      const Vec3 direction = middle + random.point(1) - origin;
      for (const Hit& hit : crossings(prepared, {.origin = origin, .direction = direction})) {
        const double rounding = 1e-15 * (std::abs(origin.x) + 100);
        for (int axis = 0; axis < 3; ++axis) {
          REQUIRE(hit.position[axis] >= box.lower[axis] - rounding);
          REQUIRE(hit.position[axis] <= box.upper[axis] + rounding);
        }
        ++found;
      }
    }
    CHECK(found > 100);
  }
}

TEST_CASE("bounding boxes are empty or infinite where entities are, and narrow where CSG cuts") {
  const BoundingBox nothing = bounding_box(empty_entity());
  CHECK(nothing.lower == Vec3(infinity));
  CHECK(nothing.upper == Vec3(-infinity));
  const BoundingBox half = bounding_box(Plane{.position = {0, 3, 0}});
  CHECK(half.lower.x == -infinity);
  CHECK(half.upper.x == infinity);
  CHECK(half.lower.y == -infinity);
  const BoundingBox common =
      bounding_box(Entity(Box{}) ^ Box{.corner_a = {0.5, -9, -9}, .corner_b = {9, 9, 9}});
  CHECK(common.lower.x == doctest::Approx(0.5));
  CHECK(common.upper.x == doctest::Approx(1));
  const BoundingBox apart = bounding_box(Entity(Box{}) + Sphere{.center = {0, 10, 0}});
  CHECK(apart.lower.y == doctest::Approx(-1));
  CHECK(apart.upper.y == doctest::Approx(11));
}
