// These tests check which faces of a large height field are found to coincide with others.
#include <doctest/doctest.h>

#include <cstdint>
#include <random>
#include <vector>

#include "core/compile/compile.hpp"
#include "core/geometry/height_field/facets.hpp"
#include "crt/prepared_scene.hpp"
#include "crt/query.hpp"
#include "crt/scene.hpp"
#include "crt/transform.hpp"
#include "support/scene_of.hpp"

using namespace crt;
using namespace crt::core;
using crt::test::scene_of;

namespace {

constexpr std::uint32_t side = 200;

/// Returns a field that is level for the first half of the columns, and a ramp then. Its cells are
/// unit squares, and its heights go up to 4.
HeightField ramp() {
  std::vector<double> heights;
  for (std::uint32_t row = 0; row < side; ++row) {
    for (std::uint32_t column = 0; column < side; ++column) {
      heights.push_back(column < side / 2 ? 0.5 : 0.5 + (column - (side / 2 - 1.0)) / 256);
    }
  }
  return {.heights = make_height_grid(heights, side, side),
          .corner_a = {0, 0, 0},
          .corner_b = {side - 1, 4, side - 1}};
}

std::uint32_t face_of(std::uint32_t column, std::uint32_t row) {
  return HeightFacets::first_of_cells + 2 * (row * (side - 1) + column);
}

}  // namespace

TEST_CASE("facets of a large field are listed where a face of another solid is in their plane") {
  const Box box{.corner_a = {10, 2, 10}, .corner_b = {20, 5, 20}};
  const Plane plane{.normal = {-1, 64, 0}, .position = {side / 2 - 1, 2, 0}};
  for (const bool is_moved : {false, true}) {
    const Transform map = is_moved ? translate({1, 8, -2}) : Transform{};
    for (const Precision tier : {Precision::standard, Precision::exact}) {
      std::vector<Entity> entities;
      for (const Entity& entity : {Entity(ramp()), Entity(box), Entity(plane)}) {
        entities.push_back(entity.transformed(map));
      }
      const CompiledScene scene = compile(entities, tier);
      REQUIRE(scene.leaves.size() == 3);
      const Leaf& field = scene.leaves[0];
      REQUIRE(field.unlisted != nullptr);
      const auto surface = [&](const Leaf& leaf, std::uint32_t face) {
        return leaf.surface_of(face, scene.face_surfaces).surface;
      };
      constexpr std::uint32_t box_bottom = 2;
      CHECK(surface(field, face_of(15, 15)) == surface(scene.leaves[1], box_bottom));
      CHECK(surface(field, face_of(15, 15) + 1) == surface(field, face_of(10, 19)));
      CHECK(surface(field, face_of(150, 3)) == surface(scene.leaves[2], 0));
      CHECK(surface(field, face_of(150, 3)) == surface(field, face_of(120, 190) + 1));
      CHECK(surface(field, face_of(150, 3)) != surface(field, face_of(15, 15)));
      CHECK(surface(field, face_of(60, 60)) != surface(field, face_of(15, 15)));
      CHECK(surface(field, face_of(60, 60)) >= scene.face_surfaces.size());
      // All of the ramp, and the cells that touch the box.
      CHECK(field.unlisted->some.size() == 2 * (100 * 199 + 12 * 12));
      CHECK(scene.face_surfaces.size() == 5 + 6 + 1 + field.unlisted->some.size());
    }
  }
}

TEST_CASE("a large field by itself lists only its sides and its bottom") {
  const CompiledScene scene = compile(std::vector<Entity>{ramp()});
  CHECK(scene.leaves[0].shape->face_count() == 5 + 2 * 199 * 199);
  CHECK(scene.face_surfaces.size() == 5);
}

TEST_CASE("a large field is cut flush like a box") {
  const Box cutter{.corner_a = {10, 2, 10}, .corner_b = {20, 1, 20}};
  const Box block{.corner_a = {30, 2, 30}, .corner_b = {40, 3, 40}};
  const Entity flush = Entity(ramp()) - cutter + block;
  const Entity same = Entity(Box{.corner_a = {0, 0, 0}, .corner_b = {99, 2, 199}}) - cutter + block;
  std::mt19937 engine(1);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  for (const Precision tier : {Precision::standard, Precision::exact}) {
    const PreparedScene flush_scene = scene_of(flush, tier);
    const PreparedScene same_scene = scene_of(same, tier);
    for (int i = 0; i < 100; ++i) {
      const double x = between(5, 45);
      const double z = between(5, 45);
      const Ray ray{.origin = {x, 30, z}, .direction = {0, -28, between(-5, 15)}};
      const std::vector<Hit> hits = crossings(flush_scene, ray);
      const std::vector<Hit> expected = crossings(same_scene, ray);
      REQUIRE(hits.size() == expected.size());
      for (std::size_t k = 0; k < hits.size(); ++k) REQUIRE(hits[k].t == expected[k].t);
    }
  }
}
