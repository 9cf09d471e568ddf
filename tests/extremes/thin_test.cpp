// These tests look at thin things and through narrow views: needles, sheets, horizons, lenses of a
// millionth of a radian and of half a turn.
#include <doctest/doctest.h>

#include <numbers>

#include "extremes/support.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr double thin = 1e-12;

/// Makes a picture straight ahead from `distance` before the origin, `width` units wide there.
Scene straight_ahead(double distance, double width, int pixels) {
  Scene scene = dark_scene();
  scene.lights = {glow(1)};
  scene.settings.width = pixels;
  scene.settings.height = pixels;
  scene.camera = {.position = {0, 0, -distance},
                  .pointing = {0, 0, 0},
                  .fov = 2 * std::atan(0.5 * width / distance)};
  return scene;
}

/// Says which columns of the middle row are bright.
std::vector<bool> bright_columns(const Scene& scene) {
  const Image image = render(prepare(scene), {.threads = 1});
  std::vector<bool> columns;
  for (int x = 0; x < image.width(); ++x)
    columns.push_back(image.at(x, image.height() / 2).r > 0.5);
  return columns;
}

/// Says which columns' middles are within `half` of the middle, of a picture `width` wide.
std::vector<bool> within(double half, double width, int pixels) {
  std::vector<bool> columns;
  for (int x = 0; x < pixels; ++x)
    columns.push_back(std::abs((x + 0.5) / pixels - 0.5) * width < half);
  return columns;
}

}  // namespace

TEST_CASE("needles and sheets of a millionth of a millionth cover what they should") {
  constexpr int pixels = 64;
  constexpr double width = 7.9 * thin;
  const std::vector<Entity> needles = {
      Cylinder{.from = {0, -1, 0}, .to = {0, 1, 0}, .radius = thin, .material = inert()},
      Cylinder{.from = {0, -1, -0.2}, .to = {0, 1, 0.3}, .radius = thin, .material = inert()},
      Cone{.from = {0, -1, 0},
           .to = {0, 1, 0},
           .radius = thin,
           .radius2 = thin,
           .material = inert()},
      Box{.corner_a = {-thin, -1, -thin}, .corner_b = {thin, 1, thin}, .material = inert()},
      // The sheets are seen edge on: deep along the view, or a disc with an edge.
      Box{.corner_a = {-thin, -1, 0}, .corner_b = {thin, 1, 0.5}, .material = inert()},
      Cylinder{.from = {-thin, 0, 0.5}, .to = {thin, 0, 0.5}, .radius = 0.5, .material = inert()},
      Sphere{.radius = thin, .material = inert()},
      Entity(Box{.corner_a = {-thin, -1, 0}, .corner_b = {1, 1, 1}, .material = inert()}) -
          Entity(Box{.corner_a = {thin, -2, -2}, .corner_b = {2, 2, 2}, .material = inert()}),
  };
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    for (std::size_t i = 0; i < needles.size(); ++i) {
      Scene scene = straight_ahead(1.5, width, pixels);
      scene.settings.precision = precision;
      scene.entities = {needles[i]};
      CAPTURE(i);
      // A little off the middle row's own line a ball is narrower, by less than a pixel's share.
      CHECK(bright_columns(scene) == within(thin, width, pixels));
    }
  }
}

TEST_CASE("a thin sheet seen flat on has no holes, and its sides are distinguished") {
  const Material front = inert();
  const std::vector<Entity> sheets = {
      Box{.corner_a = {-1, -1, 0}, .corner_b = {1, 1, thin}, .material = front},
      Cylinder{.from = {0, 0, 0}, .to = {0, 0, thin}, .radius = 1.5, .material = front},
      Entity(Box{.corner_a = {-1, -1, 0}, .corner_b = {1, 1, 1}, .material = front}) -
          Entity(Box{.corner_a = {-2, -2, thin}, .corner_b = {2, 2, 2}, .material = front})};
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    for (const Entity& sheet : sheets) {
      Scene scene = straight_ahead(3, 1.9, 40);
      scene.settings.precision = precision;
      scene.entities = {sheet};
      const Image image = render(prepare(scene), {.threads = 1});
      RayQueries queries(prepare(scene));
      for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 40; ++x) {
          REQUIRE(image.at(x, y).r == 1);
          const std::optional<Hit> hit = queries.intersect(pixel_ray(scene, x, y));
          REQUIRE(hit);
          REQUIRE(hit->entering);
          REQUIRE(hit->normal.z == -1);
        }
      }
      // A light behind it lights nothing of it in front, and one in front nothing behind.
      scene.entities = {sheet.with_material(Material{.color = grey(1)})};
      scene.lights = {PointLight{.origin = {0.1, 0.2, 1}}};
      const Image dark = render(prepare(scene), {.threads = 1});
      for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 40; ++x) REQUIRE(dark.at(x, y).r == 0);
      }
    }
  }
}

TEST_CASE("the horizon of a plane is a line, however narrow the look") {
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    for (const double fov : {3.0, 1e-3, 1e-6, 1e-9, 1e-12}) {
      Scene scene = dark_scene();
      scene.lights = {glow(1)};
      scene.settings.width = 20;
      scene.settings.height = 20;
      scene.settings.precision = precision;
      scene.camera = {.position = {0, 1, 0}, .pointing = {0, 1, 1}, .fov = fov};
      scene.entities = {Plane{.material = inert()}};
      const Image image = render(prepare(scene), {.threads = 1});
      CAPTURE(fov);
      for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 20; ++x) CHECK(image.at(x, y).r == (y < 10 ? 0 : 1));
      }
    }
  }
}

TEST_CASE("rays nearly along a plane meet it at height over slope") {
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    Scene scene;
    scene.settings.precision = precision;
    scene.entities = {Plane{}};
    RayQueries queries(prepare(scene));
    for (const double slope : {1e-3, 1e-9, 1e-15, 1e-20, 1e-100, 1e-200}) {
      const std::optional<Hit> hit =
          queries.intersect({.origin = {0.3, 7, -2}, .direction = {1, -slope, 0.5}});
      CAPTURE(slope);
      REQUIRE(hit);
      CHECK(hit->t == doctest::Approx(7 / slope).epsilon(1e-15));
      CHECK(hit->position.y == 0);
      CHECK(hit->normal == Vec3(0, 1, 0));
      CHECK_FALSE(queries.intersect({.origin = {0.3, 7, -2}, .direction = {1, slope, 0.5}}));
    }
  }
}

namespace {

/// Checks that a distant pinhole sees what parallel rays see, except at edges.
void check_distant_look(const Entity& entity, double size, double distance, Precision precision) {
  Scene scene;
  scene.settings.width = 50;
  scene.settings.height = 50;
  scene.settings.precision = precision;
  scene.background = SolidBackground{{0.1, 0.1, 0.3}};
  scene.lights = {ParallelLight{.from = {1, 2, -3}, .pointing = Vec3(0), .ambient = 0.1}};
  scene.entities = {entity};
  const Vec3 out = glm::normalize(Vec3(0.3, 0.5, -1));
  const double half = 0.5 * size;
  scene.camera = {
      .position = distance * out, .pointing = Vec3(0), .fov = 2 * std::atan(half / distance)};
  const Image image = render(prepare(scene), {.threads = 1});
  const double near = 4 * size;
  scene.camera = {.position = near * out,
                  .pointing = Vec3(0),
                  .fov = 2 * std::atan(half / near),
                  .projection = Projection::orthographic,
                  .focal_distance = near};
  const Image reference = render(prepare(scene), {.threads = 1});
  int lit = 0;
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 50; ++x) lit += reference.at(x, y).b < 0.3F ? 1 : 0;
  }
  CHECK(lit > 15);
  CHECK(speckles(image, reference, 1e-3) == 0);
}

}  // namespace

TEST_CASE("solids seen from 10^8 of their radii look as by parallel rays") {
  const Material plain{.color = Color{0.8, 0.3, 0.1}};
  const std::vector<Entity> solids = {
      Torus{.axis = {0.2, 1, 0.1}, .radius = 1, .thickness = 0.3, .material = plain},
      Torus{.axis = {0.2, 1, 0.1}, .radius = 1, .thickness = 0.01, .material = plain},
      Torus{.axis = {0.2, 1, 0.1}, .radius = 0.5, .thickness = 0.8, .material = plain},
      Sphere{.material = plain},
      Cylinder{.from = {0, -1, 0}, .to = {0.3, 1, 0}, .radius = 0.7, .material = plain},
      Cone{.from = {0, -1, 0}, .to = {0.3, 1, 0}, .material = plain},
      Entity(Box{.material = plain}) - Entity(Sphere{.radius = 1.2, .material = plain})};
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    for (const Entity& solid : solids) check_distant_look(solid, 3, 1e8, precision);
  }
}

TEST_CASE("a look of a millionth of a radian sees a ball at a million times its size") {
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    check_distant_look(Sphere{.material = Material{.color = Color{0.8, 0.3, 0.1}}}, 3, 3e6,
                       precision);
  }
}

TEST_CASE("a look of 179.9 degrees sees a wall as far out as its angle reaches") {
  const double period = 400;
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    Scene scene = dark_scene();
    scene.lights = {ParallelLight{.from = {0, 0, 0}, .pointing = {0, 0, 1}}};
    scene.settings.width = 60;
    scene.settings.height = 40;
    scene.settings.precision = precision;
    scene.camera = {
        .position = {0, 0, 0}, .pointing = {0, 0, 1}, .fov = 179.9 / 180 * std::numbers::pi};
    const Material tiles{.color = Pattern(Checker{.scale = period})};
    scene.entities = {Plane{.normal = {0, 0, -1}, .position = {0, 0, 1}, .material = tiles}};
    const Image image = render(prepare(scene), {.threads = 1});
    const double half = std::tan(0.5 * scene.camera.fov);
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 60; ++x) {
        const double wall_x = (2 * (x + 0.5) / 60 - 1) * half * 1.5;
        const double wall_y = (1 - 2 * (y + 0.5) / 40) * half;
        const bool odd = (static_cast<int>(std::floor(wall_x / period)) +
                          static_cast<int>(std::floor(wall_y / period))) %
                             2 !=
                         0;
        REQUIRE(image.at(x, y).r == (odd ? 0 : 1));
      }
    }
  }
}
