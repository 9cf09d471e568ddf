// These tests prepare a scene again after an edit.
#include <doctest/doctest.h>

#include <algorithm>

#include "core/prepare/prepared_data.hpp"
#include "crt/error.hpp"
#include "crt/prepared_scene.hpp"
#include "crt/render.hpp"

using namespace crt;

namespace {

Scene small_scene() {
  Scene scene;
  const Box block{.corner_a = {-1, -1, -1}, .corner_b = {1, 1, 1}};
  scene.entities.push_back(Entity(block) - Entity(Sphere{.center = {1, 1, -1}}));
  scene.entities.emplace_back(
      Sphere{.center = {-2, 0, 0}, .material = Material{.color = Color{1, 0, 0}}});
  scene.lights = {PointLight{.origin = {3, 5, -6}}};
  scene.camera = {.position = {0, 1, -8}, .pointing = {0, 0, 0}};
  scene.settings = {.width = 32, .height = 24};
  return scene;
}

bool same_picture(const PreparedScene& a, const PreparedScene& b) {
  const Image first = render(a);
  const Image second = render(b);
  return std::ranges::equal(first.pixels(), second.pixels());
}

}  // namespace

TEST_CASE("what does not concern the entities is prepared anew without them") {
  Scene scene = small_scene();
  const PreparedScene before = prepare(scene);
  const auto check = [&] {
    const PreparedScene after = prepare(scene, before);
    CHECK(after.data().shares_geometry_with(before.data()));
    CHECK(same_picture(after, prepare(scene)));
  };
  SUBCASE("nothing") {
    check();
  }
  SUBCASE("the camera") {
    scene.camera.position = {4, 3, -6};
    check();
  }
  SUBCASE("a light") {
    scene.lights.push_back(PointLight{.origin = {-5, 2, 0}, .color = Color{0, 0, 1}});
    check();
  }
  SUBCASE("the background") {
    scene.background = SolidBackground{.color = Color{0, 1, 0}};
    check();
  }
  SUBCASE("gamma, which pictures in patterns are decoded with") {
    scene.settings.gamma = 2.2;
    check();
  }
}

TEST_CASE("entities that come, go, move or are made anew are prepared") {
  Scene scene = small_scene();
  const PreparedScene before = prepare(scene);
  SUBCASE("another one") {
    scene.entities.emplace_back(Sphere{.center = {2, 0, -2}});
  }
  SUBCASE("one less") {
    scene.entities.pop_back();
  }
  SUBCASE("another place") {
    scene.entities[1] = scene.entities[1].transformed(translate({1, 0, 0}));
  }
  SUBCASE("another order") {
    std::swap(scene.entities[0], scene.entities[1]);
  }
  SUBCASE("the other tier") {
    scene.settings.precision = Precision::exact;
  }
  const PreparedScene after = prepare(scene, before);
  CHECK_FALSE(after.data().shares_geometry_with(before.data()));
  CHECK(same_picture(after, prepare(scene)));
}

TEST_CASE("what is shared outlives what it was made for") {
  Scene scene = small_scene();
  PreparedScene prepared = prepare(scene);
  const PreparedScene first = prepared;
  for (int i = 0; i < 3; ++i) {
    scene.camera.position.x += 0.5;
    prepared = prepare(scene, prepared);
  }
  CHECK(prepared.data().shares_geometry_with(first.data()));
  CHECK(same_picture(prepared, prepare(scene)));
}

TEST_CASE("an edit that makes the scene wrong is an error, and the earlier one stays as it is") {
  Scene scene = small_scene();
  const PreparedScene before = prepare(scene);
  scene.camera.fov = 500;
  CHECK_THROWS_AS(prepare(scene, before), Error);
  CHECK(same_picture(before, prepare(small_scene())));
}

TEST_CASE("entities of other materials share what rays meet") {
  Scene scene = small_scene();
  const PreparedScene before = prepare(scene);
  const Sphere green{.center = {-2, 0, 0}, .material = Material{.color = Color{0, 1, 0}}};
  const Sphere glass{.center = {-2, 0, 0}, .material = Material{.transparency = 0.5}};
  scene.entities[1] = green;
  PreparedScene after = prepare(scene, before);
  CHECK(after.data().shares_geometry_with(before.data()));
  CHECK(same_picture(after, prepare(scene)));
  // From there on it is edited as any other.
  scene.entities.emplace_back(Sphere{.center = {2, 0, -2}});
  after = prepare(scene, after);
  CHECK(same_picture(after, prepare(scene)));
  // Where light enters makes a difference to rays.
  scene.entities[1] = glass;
  CHECK_FALSE(prepare(scene, after).data().shares_geometry_with(after.data()));
  CHECK(same_picture(prepare(scene, after), prepare(scene)));
}

TEST_CASE("preparing from an earlier scene is cancelled and limited as preparing anew") {
  Scene scene = small_scene();
  const PreparedScene before = prepare(scene);
  scene.entities[1] = scene.entities[1].transformed(translate({1, 0, 0}));
  PrepareOptions options{.earlier = &before};
  options.go_on = [] { return false; };
  CHECK_THROWS_AS(prepare(scene, options), Error);
  options.go_on = nullptr;
  options.max_primitives = 2;
  CHECK_THROWS_AS(prepare(scene, options), Error);
  CHECK_THROWS_AS(prepare(small_scene(), options), Error);
  options.max_primitives = 3;
  CHECK(same_picture(prepare(scene, options), prepare(scene)));
}

TEST_CASE("other materials on the same entities are prepared as if they were the entities' own") {
  const SharedMaterial red(Material{.color = Color{1, 0, 0}});
  const SharedMaterial glass(Material{.transparency = 1, .refractive_index = 1.5});
  const auto scene_of = [](const SharedMaterial& ball, const SharedMaterial& block) {
    Scene scene = small_scene();
    const Box box{.corner_a = {-1, -1, -1}, .corner_b = {1, 1, 1}, .material = block};
    scene.entities = {Entity(box) - Entity(Sphere{.center = {1, 1, -1}}).with_material(block),
                      Sphere{.center = {-2, 0, 0}, .material = ball}};
    return scene;
  };
  const Scene scene = scene_of(red, glass);
  const PreparedScene before = prepare(scene);
  PrepareOptions options{.earlier = &before};
  int calls = 0;
  options.material = [&](const SharedMaterial& material) {
    ++calls;
    return &*material == &*red ? glass : red;
  };
  const PreparedScene after = prepare(scene, options);
  CHECK(after.data().shares_geometry_with(before.data()));
  CHECK(calls == 2);
  CHECK(same_picture(after, prepare(scene_of(glass, red))));
  CHECK(same_picture(prepare(scene, after), before));
}
