// Glass stands on a table, water in a glass, labels on a bottle. Faces that coincide look as if one
// were sunk into the other by a hair.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "extremes/support.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr double hair = 1e-7;

struct Pair {
  std::string name;
  std::vector<Entity> touching;
  std::vector<Entity> sunk;
};

Material clear() {
  Material material = glass(1.5);
  material.transparency = 0.9;
  material.absorption = {0.3, 0.1, 0.05};
  return material;
}

Material drink() {
  Material material = glass(1.33);
  material.absorption = {0.05, 0.6, 1.6};
  return material;
}

Material wood() {
  return {.color = Color{0.8, 0.6, 0.4}, .reflectivity = 0.1};
}

Entity table() {
  return Box{.corner_a = {-3, -0.3, -3}, .corner_b = {3, 0, 3}, .material = wood()};
}

Entity block(double low) {
  return Box{.corner_a = {-0.7, low, -0.6}, .corner_b = {0.6, 0.9, 0.5}, .material = clear()};
}

/// Makes a tumbler whose inside has the given radius and bottom.
Entity tumbler() {
  return Entity(
             Cylinder{.from = {0, 0, 0}, .to = {0, 1.2, 0}, .radius = 0.6, .material = clear()}) -
         Entity(
             Cylinder{.from = {0, 0.2, 0}, .to = {0, 1.2, 0}, .radius = 0.5, .material = clear()});
}

Entity filling(double wider) {
  return Cylinder{
      .from = {0, 0.2 - wider, 0}, .to = {0, 0.9, 0}, .radius = 0.5 + wider, .material = drink()};
}

Entity goblet() {
  return (Entity(Sphere{.center = {0, 0.7, 0}, .radius = 0.7, .material = clear()}) -
          Entity(Sphere{.center = {0, 0.7, 0}, .radius = 0.6, .material = clear()})) -
         Entity(Plane{.normal = {0, -1, 0}, .position = {0, 1, 0}, .material = clear()});
}

Entity punch(double wider) {
  return Entity(Sphere{.center = {0, 0.7, 0}, .radius = 0.6 + wider, .material = drink()}) ^
         Entity(Plane{.position = {0, 0.8, 0}, .material = drink()});
}

/// Makes a block of index 1. Behind a label a hair away glass would mirror what is there.
Entity foggy_block() {
  Material fog = clear();
  fog.refractive_index = 1;
  return Box{.corner_a = {-0.7, 0, -0.6}, .corner_b = {0.6, 0.9, 0.5}, .material = fog};
}

/// Makes a label, which has gaps.
Entity label(double before) {
  Material stripes{.color = Pattern(Stripes{
                       .color_a = {0.9, 0.1, 0.1, 1}, .color_b = {1, 1, 1, 0}, .scale = 0.31})};
  return Disc{.center = {0.05, 0.45, -0.6 - before},
              .normal = {0, 0, -1},
              .radius = 0.3,
              .material = stripes};
}

std::vector<Pair> pairs() {
  const Entity cup =
      Cone{.from = {0, 0, 0}, .to = {0, 1, 0}, .radius = 0.4, .radius2 = 0.7, .material = clear()};
  const Entity sunk_cup = Cone{
      .from = {0, -hair, 0}, .to = {0, 1, 0}, .radius = 0.4, .radius2 = 0.7, .material = clear()};
  return {
      {"a block of glass on a table", {table(), block(0)}, {table(), block(-hair)}},
      {"a table under a block of glass", {block(0), table()}, {block(-hair), table()}},
      {"a cone of glass on a table", {table(), cup}, {table(), sunk_cup}},
      {"a tumbler filled to its walls",
       {table(), tumbler(), filling(0)},
       {table(), tumbler(), filling(hair)}},
      {"what fills a tumbler to its walls", {filling(0), tumbler()}, {filling(hair), tumbler()}},
      {"a goblet filled to its walls", {goblet(), punch(0)}, {goblet(), punch(hair)}},
      {"a label on a block", {foggy_block(), label(0)}, {foggy_block(), label(hair)}},
      {"a block behind a label", {label(0), foggy_block()}, {label(hair), foggy_block()}}};
}

Image taken(std::vector<Entity> entities, const Transform& placed, int side, Precision precision) {
  Scene scene = dark_scene();
  scene.background = GradientBackground{};
  scene.settings.width = 24;
  scene.settings.height = 24;
  scene.settings.recursion_depth = 24;
  scene.settings.min_weight = 1.0 / 4096;
  scene.settings.precision = precision;
  for (Entity& entity : entities) entity = entity.transformed(placed);
  scene.entities = std::move(entities);
  const auto place = [&](const Vec3& p) { return apply(placed, p); };
  scene.lights = {PointLight{.origin = place({3, 5, -4})},
                  PointLight{.origin = place({-4, 3, 1}), .color = grey(0.5)}};
  Random random(static_cast<unsigned>(side));
  Vec3 from = random.direction();
  from.y = side == 0 ? 0.1 : std::abs(from.y);
  if (side == 1) from = Vec3(0, 0.3, -1);
  scene.camera = {
      .position = place(4.0 * from + Vec3(0, 0.4, 0)), .pointing = place({0, 0.4, 0}), .fov = 0.6};
  return render(prepare(scene), {.threads = 1});
}

}  // namespace

TEST_CASE("glass on tables, water in glasses and labels have no speckles") {
  Transform far = rotate_degrees({33, 5, 67});
  far.translation = {30, -70, 20};
  for (const Pair& pair : pairs()) {
    for (const Transform& placed : {Transform{}, rotate_degrees({17, 71, 41}), far}) {
      for (int side = 0; side < 6; ++side) {
        const Image reference = taken(pair.sunk, placed, side, Precision::standard);
        for (const Precision precision : {Precision::standard, Precision::exact}) {
          CAPTURE(pair.name);
          CAPTURE(side);
          CAPTURE(placed.translation.x);
          CAPTURE(placed.row_x.y);
          CHECK(speckles(taken(pair.touching, placed, side, precision), reference) == 0);
        }
      }
    }
  }
}

TEST_CASE("glass in glass has the same bytes for any number of threads") {
  Scene scene;
  scene.settings.width = 40;
  scene.settings.height = 40;
  scene.background = GradientBackground{};
  scene.lights = {PointLight{.origin = {3, 5, -4}}};
  scene.entities = {table(), filling(0), tumbler(), label(0)};
  for (Entity& entity : scene.entities) entity = entity.transformed(rotate_degrees({10, 20, 30}));
  scene.camera = {.position = {0.3, 1.5, -4}, .pointing = {0, 0.5, 0}, .fov = 0.6};
  const PreparedScene prepared = prepare(scene);
  const Image reference = render(prepared, {.threads = 1});
  for (const int threads : {2, 7}) {
    const Image image = render(prepared, {.threads = threads});
    CHECK(same_pixels(image, reference));
    CHECK(image.stats().refraction_rays == reference.stats().refraction_rays);
    CHECK(image.stats().media_changes == reference.stats().media_changes);
  }
}

TEST_CASE("thousands of solids at one place are seen, and seen through, in the end") {
  Scene scene = dark_scene();
  scene.settings.width = 6;
  scene.settings.height = 6;
  scene.settings.recursion_depth = 8;
  scene.background = SolidBackground{{1, 1, 1}};
  scene.lights = {PointLight{.origin = {3, 5, -4}}};
  Material fog = glass(1);
  fog.absorption = grey(0.1);
  for (int i = 0; i < 3000; ++i) scene.entities.emplace_back(Sphere{.material = fog});
  scene.entities.emplace_back(Sphere{.center = {0, -2, 0}, .radius = 0.5, .material = wood()});
  // The scene is seen from outside and from within.
  for (const Vec3& eye : {Vec3(0, 0, -3), Vec3(0, 0, 0)}) {
    const double length = eye.z < 0 ? 2 : 1;
    CHECK(seen(scene, eye, {0, 0, 1}).r == doctest::Approx(std::exp(-0.1 * length)).epsilon(1e-6));
  }
  CHECK(seen(scene, {0.3, -1.8, -2}, {0, -2, 0}).r > 0.05);
}
