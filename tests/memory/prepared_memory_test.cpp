// These tests compare the memory that a prepared scene reports with the memory that it takes.
#include <doctest/doctest.h>

#include "memory/counting_new.hpp"
#include "memory/scenes.hpp"

using namespace crt;
using namespace crt::test;

namespace {

Scene scene_of(std::vector<Entity> entities) {
  Scene scene;
  scene.entities = std::move(entities);
  scene.settings = {.width = 16, .height = 12};
  return scene;
}

MemoryUse memory_of(std::vector<Entity> entities) {
  return prepare(scene_of(std::move(entities))).memory();
}

/// Prepares and says how much of what was taken is still there.
std::int64_t taken_for(const Scene& scene, MemoryUse& claimed) {
  const std::int64_t before = bytes_in_use();
  const PreparedScene prepared = prepare(scene);
  const std::int64_t taken = bytes_in_use() - before;
  claimed = prepared.memory();
  return taken;
}

double ratio(std::uint64_t a, std::uint64_t b) {
  return static_cast<double>(a) / static_cast<double>(b);
}

/// Makes some of everything, so that each kind of part has a share in which a mistake would show.
std::vector<Entity> mixed_entities(int count) {
  std::vector<Entity> entities = balls(count, 0.01);
  for (const Entity& ball : balls(count, 0.1, 2)) {
    entities.push_back(
        (ball - Box{.corner_a = {-5, 0, -5}}).transformed(rotate_degrees({10, 20, 30})));
    entities.push_back(
        Entity(Cylinder{})
            .transformed(translate({0, 0.5 + static_cast<double>(entities.size()), 0})));
  }
  entities.push_back(csg_difference(block, balls(count, 0.1, 3)));
  return entities;
}

}  // namespace

TEST_CASE("the memory that a prepared scene reports is what was taken for it") {
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    Scene scene = scene_of(mixed_entities(5000));
    scene.settings.precision = precision;
    prepare(scene);  // what libraries take once and for all is not of any scene
    MemoryUse claimed;
    const std::int64_t taken = taken_for(scene, claimed);
    // Embree's own memory does not come from operator new, or only partly.
    const double without_tree =
        static_cast<double>(claimed.primitives + claimed.csg + claimed.materials);
    CHECK(static_cast<double>(taken) >= 0.99 * without_tree);
    CHECK(static_cast<double>(taken) <= 1.03 * static_cast<double>(claimed.total()));
  }
}

TEST_CASE("where Embree has next to nothing to do, the report agrees to some per cent") {
  const Scene scene = scene_of({csg_difference(block, balls(50'000, 0.1))});
  prepare(scene);
  MemoryUse claimed;
  const std::int64_t taken = taken_for(scene, claimed);
  CHECK(static_cast<double>(taken) ==
        doctest::Approx(static_cast<double>(claimed.total())).epsilon(0.03));
  CHECK(claimed.csg > claimed.tree);
}

TEST_CASE("twice the spheres take about twice the memory") {
  const MemoryUse one = memory_of(balls(20'000, 0.01));
  const MemoryUse two = memory_of(balls(40'000, 0.01));
  CHECK(ratio(two.primitives, one.primitives) == doctest::Approx(2).epsilon(0.02));
  CHECK(ratio(two.tree, one.tree) == doctest::Approx(2).epsilon(0.2));
  CHECK(one.csg == 0);

  const MemoryUse plate = memory_of({csg_difference(block, balls(20'000, 0.01))});
  const MemoryUse larger = memory_of({csg_difference(block, balls(40'000, 0.01))});
  CHECK(ratio(larger.primitives, plate.primitives) == doctest::Approx(2).epsilon(0.02));
  CHECK(ratio(larger.csg, plate.csg) == doctest::Approx(2).epsilon(0.1));
}

TEST_CASE("a picture counts where it had to be taken to linear light, and once") {
  const auto picture = std::make_shared<Image>(100, 50);
  const auto prepared = [&](bool encoded) {
    picture->set_display_encoded(encoded);
    Scene scene = scene_of({});
    for (int i = 0; i < 3; ++i) {
      scene.entities.emplace_back(
          Sphere{.material = Material{.color = ImageMap{.image = picture}}});
    }
    scene.settings.gamma = 2.2;
    return prepare(scene).memory().materials;
  };
  const std::uint64_t pixels = std::uint64_t{100} * 50 * 4 * sizeof(float);
  const std::uint64_t linear = prepared(false);
  const std::uint64_t encoded = prepared(true);
  CHECK(linear < pixels);
  CHECK(encoded >= linear + pixels);
  CHECK(encoded < linear + pixels + 1024);
}

TEST_CASE("a picture's statistics have the memory of what it was rendered from") {
  const PreparedScene prepared = prepare(scene_of(mixed_entities(50)));
  const MemoryUse memory = render(prepared).stats().memory;
  CHECK(memory.primitives == prepared.memory().primitives);
  CHECK(memory.csg == prepared.memory().csg);
  CHECK(memory.tree == prepared.memory().tree);
  CHECK(memory.materials == prepared.memory().materials);
  CHECK(memory.total() == memory.primitives + memory.csg + memory.tree + memory.materials);
}
