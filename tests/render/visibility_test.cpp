// These tests check entities that light passes, and such as the camera does not see. Pictures are
// compared with those of scenes without the entity.
#include <doctest/doctest.h>
#include <crt/query.hpp>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "crt/error.hpp"
#include "pictures.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr double float_precision = 1e-6;

/// Makes solids and surfaces of all the kinds that rays are tested against in their own way.
std::vector<Entity> varied_entities(const Material& material) {
  const Entity ball = Sphere{.center = {0, 0, 0}, .radius = 0.6};
  const Entity cut = Box{.corner_a = {-0.5, -0.5, -0.5}, .corner_b = {0.5, 0.5, 0.5}} -
                     Sphere{.center = {0.3, 0.3, -0.5}, .radius = 0.4};
  const Entity ring =
      Torus{.center = {0, 0, 0}, .axis = {0.3, 1, -0.5}, .radius = 0.5, .thickness = 0.2};
  const Entity pair = Entity(Sphere{.center = {-0.5, 0, 0}, .radius = 0.3}) +
                      Sphere{.center = {0.5, 0, 0}, .radius = 0.3};
  const Entity lying = Entity(Cylinder{.from = {-0.5, 0, 0}, .to = {0.5, 0.2, 0}, .radius = 0.3})
                           .transformed(rotate_degrees({20, 30, 40}));
  const Entity disc = Disc{.center = {0, 0, 0}, .normal = {0.2, 0.3, -1}, .radius = 0.6};
  std::vector<Entity> entities;
  for (const Entity& entity : {ball, cut, ring, pair, lying, disc})
    entities.push_back(entity.with_material(material));
  return entities;
}

/// Makes a grid of them, of which every third is looked at by `mark` and may be left out.
template <class Mark>
std::vector<Entity> field(int side, const Material& material, const Mark& mark) {
  const std::vector<Entity> kinds = varied_entities(material);
  std::vector<Entity> entities;
  for (int i = 0; i < side * side; ++i) {
    const Vec3 place(1.3 * (i % side) - 0.65 * (side - 1), 1.3 * (i / side) - 0.65 * (side - 1),
                     0.1 * (i % 7));
    const Entity entity =
        kinds[static_cast<std::size_t>(i) % kinds.size()].transformed(translate(place));
    if (i % 3 != 1) {
      entities.push_back(entity);
    } else {
      mark(entities, entity);
    }
  }
  return entities;
}

Scene scene_from(std::vector<Entity> entities, int side) {
  Scene scene = dark_scene();
  scene.settings.width = scene.settings.height = 64;
  scene.camera = {.position = {0.4, 0.2, -1.6 * side - 3}, .pointing = {0, 0, 0}, .fov = 0.8};
  scene.background = SolidBackground{{0.25, 0.5, 0.75}};
  scene.entities = std::move(entities);
  return scene;
}

constexpr auto leave_out = [](std::vector<Entity>&, const Entity&) {};
constexpr auto unseen = [](std::vector<Entity>& entities, const Entity& entity) {
  entities.push_back(entity.with_visible(false));
};
constexpr auto shadowless = [](std::vector<Entity>& entities, const Entity& entity) {
  entities.push_back(entity.with_shadow(false));
};

Material clear(double absorption) {
  Material material = glass(1);
  material.absorption = grey(absorption);
  return material;
}

}  // namespace

TEST_CASE("the camera sees through what it does not see, of any kind, in scenes of any size") {
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    for (const int side : {2, 3, 12}) {
      for (const Material& material : {inert(), inert(0, 0.5)}) {
        CAPTURE(side);
        Scene with = scene_from(field(side, material, unseen), side);
        Scene without = scene_from(field(side, material, leave_out), side);
        for (Scene* const scene : {&with, &without}) {
          scene->lights = {glow(0.7)};
          scene->settings.precision = precision;
          scene->settings.recursion_depth = 0;
        }
        CHECK(same_pixels(render(prepare(with)), render(prepare(without))));
        // There is something to be passed.
        Scene usual = scene_from(
            field(side, material, [](auto& list, const Entity& entity) { list.push_back(entity); }),
            side);
        usual.lights = with.lights;
        usual.settings = with.settings;
        CHECK_FALSE(same_pixels(render(prepare(usual)), render(prepare(without))));
      }
    }
  }
}

TEST_CASE("with a target error what the camera does not see takes no samples") {
  Scene without = varied_scene();
  Scene with = without;
  for (int i = 0; i < 30; ++i) {
    const Sphere speck{.center = {0.2 * i - 3, 1.1, -2}, .radius = 0.02, .material = inert()};
    with.entities.push_back(Entity(speck).with_visible(false).with_shadow(false));
  }
  for (Scene* const scene : {&with, &without}) {
    scene->settings.dof_samples = 1;
    scene->settings.recursion_depth = 0;
  }
  const Image a = render(prepare(with));
  const Image b = render(prepare(without));
  CHECK(same_pixels(a, b));
  CHECK(a.stats().camera_rays == b.stats().camera_rays);
}

TEST_CASE("a mirror and a shadow show what the camera does not see") {
  Scene scene = dark_scene();
  scene.lights = {ParallelLight{.from = {0, 10, 0}, .pointing = {0, 0, 0}}};
  scene.background = SolidBackground{{0, 0, 1}};
  const Entity red =
      Sphere{.center = {0, 2, 0}, .radius = 0.5, .material = Material{.color = Color{1, 0, 0}}};
  const Entity floor = Plane{.material = Material{.color = grey(1)}};
  const Entity mirror = Plane{.normal = {0, 0, -1}, .position = {0, 0, 5}, .material = inert(1)};
  scene.entities = {red.with_visible(false), floor, mirror};
  // It is not in front of the mirror, in which it is seen from behind.
  const Color in_mirror = seen(scene, {0, 2, -1}, {0, 2, 5});
  CHECK(in_mirror.r == doctest::Approx(0).epsilon(1e-3));  // the light grazes it there
  CHECK(in_mirror.b == 0);                                 // no background is behind it
  CHECK(seen(scene, {0, 2, -1}, {0, 2.2, 5}).b == 0);
  CHECK(seen(scene, {0, 2, -1}, {0, 2.2, 5}).r > 0.3);
  CHECK(seen(scene, {0, 0.5, -1}, {0, 0, 0}).r == 0);  // the shadow below it
  CHECK(seen(scene, {0, 0.5, -1}, {2, 0, 0}).r == doctest::Approx(1).epsilon(float_precision));
  scene.entities[0] = red.with_visible(false).with_shadow(false);
  CHECK(seen(scene, {0, 0.5, -1}, {0, 0, 0}).r == doctest::Approx(1).epsilon(float_precision));
  scene.entities[0] =
      red.with_shadow(false).with_shadow(true).with_visible(false).with_visible(true);
  CHECK(seen(scene, {0, 0.5, -1}, {0, 0, 0}).r == 0);
  CHECK(seen(scene, {0, 2.2, -1}, {0, 2.2, 0}).r > 0.1);
}

TEST_CASE("glass shows what the camera does not see itself") {
  Scene scene = dark_scene();
  scene.lights = {ParallelLight{.from = {0, 0, -9}, .pointing = {0, 0, 0}}};
  const Entity ball =
      Sphere{.center = {0, 0, 5}, .radius = 1, .material = Material{.color = grey(1)}};
  const Entity pane = Box{.corner_a = {-9, -9, 1}, .corner_b = {9, 9, 2}, .material = glass(1)};
  scene.entities = {ball.with_visible(false)};
  CHECK(seen(scene, {0, 0, -5}, {0, 0, 0}).r == 0);
  scene.entities.push_back(pane);
  CHECK(seen(scene, {0, 0, -5}, {0, 0, 0}).r == doctest::Approx(1).epsilon(float_precision));
}

TEST_CASE("beside what casts no shadow all is lit as if it were not there") {
  for (const Material& material :
       {Material{.color = grey(1)}, Material{.color = Color{1, 0.5, 0.2}, .transparency = 0.6},
        clear(0.8)}) {
    for (const int side : {2, 3, 12}) {
      for (const Precision precision : {Precision::standard, Precision::exact}) {
        Scene with = scene_from(field(side, material, shadowless), side);
        Scene without = scene_from(field(side, material, leave_out), side);
        Scene usual = scene_from(
            field(side, material, [](auto& list, const Entity& entity) { list.push_back(entity); }),
            side);
        const Entity wall = Plane{
            .normal = {0, 0, -1}, .position = {0, 0, 2}, .material = Material{.color = grey(0.9)}};
        for (Scene* const scene : {&with, &without, &usual}) {
          scene->lights = {PointLight{.origin = {3, 5, -9}}};
          scene->settings.precision = precision;
          scene->settings.recursion_depth = 0;
          scene->entities.push_back(wall.with_id(7777));
        }
        const Image a = render(prepare(with), {.aovs = {.id = true}});
        const Image b = render(prepare(without), {.aovs = {.id = true}});
        const Image c = render(prepare(usual));
        const auto ids = a.integer_channel("id");
        std::size_t on_wall = 0;
        for (int i = 0; i < 64 * 64; ++i) {
          if (ids[static_cast<std::size_t>(i)] != 7777) continue;
          ++on_wall;
          REQUIRE(a.at(i % 64, i / 64) == b.at(i % 64, i / 64));
        }
        CHECK(on_wall > 500);
        CHECK_FALSE(same_pixels(a, c));
      }
    }
  }
}

TEST_CASE("a light that rays find, too, lights as much behind what casts no shadow") {
  constexpr double radius = 3;
  constexpr double height = 4;
  const Color radiance = grey(height * height / (radius * radius));  // A white floor is 1.
  const auto pane = [](double bottom, const SharedMaterial& material) {
    return Entity(
        Box{.corner_a = {-2, bottom, -2}, .corner_b = {2, bottom + 0.1, 2}, .material = material});
  };
  const SharedMaterial rough(PrincipledMaterial{
      .color = grey(1), .roughness = 0.3, .refractive_index = 1, .transmission = 1});
  const std::vector<std::vector<Entity>> between = {
      {},
      {pane(0.2, inert()).with_shadow(false)},
      {pane(0.2, inert(0, 0.5)).with_shadow(false)},
      {pane(0.2, glass(1)).with_shadow(false), pane(0.4, glass(1)).with_shadow(false)},
      {pane(0.2, rough).with_shadow(false)},
      // Rays alone find light that comes through glass. Not so where they are blocked.
      {pane(0.2, inert()).with_shadow(false), pane(0.4, glass(1))},
      {pane(0.2, glass(1)), pane(0.4, inert()).with_shadow(false)},
      {pane(0.2, glass(1)), pane(0.4, glass(1)).with_shadow(false)},
      {pane(0.2, glass(1)).with_shadow(false), pane(0.4, glass(1))}};
  Scene scene = dark_scene();
  scene.settings.indirect = 1;
  scene.settings.recursion_depth = 8;
  scene.settings.target_error = 1e-9;
  scene.settings.min_samples = scene.settings.max_samples = 4096;
  scene.camera.fov = 1e-6;
  const auto brightness = [&](const SharedMaterial& floor, std::vector<Entity> entities) {
    entities.push_back(Plane{.material = floor});
    scene.entities = std::move(entities);
    return seen(scene, {0.1, 0.1, 0}, {0, 0, 0}).r;
  };
  const auto check = [&](const std::vector<Entity>& lights) {
    const SharedMaterial matt(Material{.color = grey(1), .diffuse = 1});
    const SharedMaterial metal(PrincipledMaterial{.color = grey(1), .metallic = 1});
    const double of_metal = brightness(metal, lights);
    for (const std::vector<Entity>& entities : between) {
      CAPTURE(&entities - between.data());
      std::vector<Entity> all = entities;
      all.insert(all.end(), lights.begin(), lights.end());
      CHECK(brightness(matt, all) == doctest::Approx(1).epsilon(0.01));
      CHECK(brightness(metal, all) == doctest::Approx(of_metal).epsilon(0.01));
    }
  };
  SUBCASE("a light of the scene") {
    scene.lights = {SphereLight{.center = {0, height, 0}, .radius = radius, .color = radiance}};
    check({});
  }
  SUBCASE("a surface that gives off light") {
    check({Sphere{.center = {0, height, 0},
                  .radius = radius,
                  .material = Material{.color = grey(0), .emission = radiance}}});
  }
  SUBCASE("the background") {
    scene.lights = {EnvironmentLight{}};
    scene.background = SolidBackground{{1, 1, 1}};
    check({});
  }
}

TEST_CASE("the camera's rays take nothing from media that it does not see") {
  Scene scene = dark_scene();
  scene.background = SolidBackground{{1, 1, 1}};
  const Entity block = Box{.corner_a = {-9, -9, -2}, .corner_b = {9, 9, 2}, .material = clear(0.5)};
  scene.entities = {block.with_visible(false)};
  CHECK(seen(scene, {0, 0, -5}, {0, 0, 0}).r == doctest::Approx(1).epsilon(float_precision));
  // It is so from within, too.
  CHECK(seen(scene, {0, 0, 0}, {0, 0, 5}).r == doctest::Approx(1).epsilon(float_precision));
  // Mirrored rays are within the medium, from where they begin.
  const Entity mirror =
      Disc{.center = {0, 0, 0.5}, .normal = {0, 0, -1}, .radius = 3, .material = inert(1)};
  scene.entities.push_back(mirror);
  const double left = std::exp(-0.5 * 2.5);
  CHECK(seen(scene, {0, 0, -5}, {0, 0, 0}).r == doctest::Approx(left).epsilon(float_precision));
  CHECK(seen(scene, {0, 0, -1}, {0, 0, 0}).r == doctest::Approx(left).epsilon(float_precision));
  // Seen, it takes from both ways.
  scene.entities[0] = block;
  CHECK(seen(scene, {0, 0, -5}, {0, 0, 0}).r ==
        doctest::Approx(left * left).epsilon(float_precision));
}

TEST_CASE("light takes nothing from media that cast no shadow, wherever it begins") {
  Scene scene = dark_scene();
  scene.lights = {ParallelLight{.from = {0, 0, -9}, .pointing = {0, 0, 0}}};
  const Entity wall = Disc{.center = {0, 0, 1},
                           .normal = {0, 0, -1},
                           .radius = 3,
                           .material = Material{.color = grey(1)}};
  const Entity block = Box{.corner_a = {-9, -9, -2}, .corner_b = {9, 9, 2}, .material = clear(0.5)};
  scene.entities = {wall, block.with_shadow(false)};
  // The camera's ray is within the medium for 2, the light for 3.
  CHECK(seen(scene, {0, 0, -1}, {0, 0, 1}).r ==
        doctest::Approx(std::exp(-0.5 * 2)).epsilon(float_precision));
  scene.entities[1] = block;
  CHECK(seen(scene, {0, 0, -1}, {0, 0, 1}).r ==
        doctest::Approx(std::exp(-0.5 * 5)).epsilon(float_precision));
}

TEST_CASE("of surfaces at one place the camera sees those that it can") {
  Scene scene = dark_scene();
  scene.lights = {glow(1)};
  const Box box{.corner_a = {-1, -1, 0}, .corner_b = {1, 1, 1}};
  const Entity dim =
      Entity(box).with_material(Material{.color = grey(1), .reflectivity = 0.75, .diffuse = 0});
  const Entity bright = Entity(box).with_material(inert());
  const Entity plane = Plane{.normal = {0, 0, -1}, .material = inert()};
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    scene.settings.precision = precision;
    scene.settings.recursion_depth = 0;
    for (const Entity& other : {bright, plane, bright.transformed(translate({0.5, 0.5, 0}))}) {
      scene.entities = {dim.with_visible(false), other};
      CHECK(seen(scene, {0.1, 0.2, -5}, {0.2, 0.1, 0}).r == 1);
      scene.entities = {dim, other.with_visible(false)};
      CHECK(seen(scene, {0.1, 0.2, -5}, {0.2, 0.1, 0}).r == 0.25);
    }
  }
}

TEST_CASE("an instance may be unseen where another one of the same thing is seen") {
  const Entity tree = csg_union(varied_entities(inert()));
  Scene scene = dark_scene();
  scene.lights = {glow(1)};
  for (int i = 0; i < 64; ++i) {
    const Entity one = tree.transformed(translate({3.0 * (i % 8), 3.0 * (i / 8), 0}));
    scene.entities.push_back(one);
    scene.entities.push_back(one.transformed(translate({0, 0, -5})).with_visible(i % 2 == 0));
  }
  const auto ids = [&](int i) {
    Scene one = scene;
    one.settings.width = one.settings.height = 1;
    const Vec3 place(3.0 * (i % 8), 3.0 * (i / 8), 0);
    one.camera = {.position = place + Vec3(-0.5, 0, -20), .pointing = place + Vec3(-0.5, 0, 0)};
    return render(prepare(one), {.aovs = {.id = true}}).integer_channel("id")[0];
  };
  for (int i = 0; i < 64; i += 7)
    CHECK(ids(i) == static_cast<std::uint32_t>(i % 2 == 0 ? 2 * i + 1 : 2 * i));
}

TEST_CASE("ray queries are about geometry") {
  Scene scene;
  scene.entities = {Entity(Sphere{}).with_visible(false).with_shadow(false)};
  RayQueries queries(prepare(scene));
  const Ray ray{.origin = {0, 0, -5}, .direction = {0, 0, 1}};
  REQUIRE(queries.intersect(ray));
  CHECK(queries.intersect(ray)->t == doctest::Approx(4));
  CHECK(queries.occluded(ray));
}

TEST_CASE("a camera within what it does not see is not warned of") {
  Scene scene;
  scene.lights = {glow(1)};
  scene.camera = {.position = {0, 0, 0}, .pointing = {0, 0, 1}};
  scene.entities = {Sphere{.radius = 2}};
  CHECK(prepare(scene).warnings().size() == 1);
  scene.entities = {Entity(Sphere{.radius = 2}).with_visible(false)};
  CHECK(prepare(scene).warnings().empty());
}

TEST_CASE("parts of a combination cannot be unseen or without a shadow, but the whole can") {
  const Entity a = Sphere{};
  const Entity b = Box{};
  for (const bool is_shadow : {true, false}) {
    const auto marked = [&](const Entity& entity) {
      return is_shadow ? entity.with_shadow(false) : entity.with_visible(false);
    };
    const std::string name = is_shadow ? "shadow" : "visible";
    const auto refuses = [&](const auto& combine) {
      try {
        combine();
        return false;
      } catch (const Error& error) {
        return error.argument() == name && error.code() == ErrorCode::invalid_argument &&
               std::string(error.what()).find("combination") != std::string::npos;
      }
    };
    CHECK(refuses([&] { return a + marked(b); }));
    CHECK(refuses([&] { return marked(a) - b; }));
    CHECK(refuses([&] { return a - marked(b); }));
    CHECK(refuses([&] { return marked(a) ^ b; }));
    CHECK(refuses([&] { return a + marked(b).transformed(translate({1, 0, 0})); }));
    CHECK_NOTHROW(marked(a - b).with_id(3).transformed(scale(2)));
    CHECK_NOTHROW(a - (is_shadow ? marked(b).with_shadow(true) : marked(b).with_visible(true)));
    CHECK(marked(a - b).casts_shadow() == !is_shadow);
    CHECK(marked(a).transformed(scale(2)).is_visible() == is_shadow);
    CHECK(a.casts_shadow());
    CHECK((a - b).is_visible());
    CHECK(marked(empty_entity()).is_empty());
    CHECK_NOTHROW(a + marked(empty_entity()));
    const Entity alone = marked(a);
    CHECK_NOTHROW(csg_union(std::span(&alone, 1)));
  }
}
