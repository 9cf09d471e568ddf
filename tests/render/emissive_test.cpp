// Surfaces that give off light, and many lights: against closed forms, and against what is found
// without taking samples of them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "pictures.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr double pi = std::numbers::pi;

Material glowing(const Color& emission = {1, 1, 1}) {
  return {.color = grey(0), .diffuse = 0, .emission = emission};
}

Material white() {
  return {.color = grey(1), .diffuse = 1};
}

/// Makes a scene of one pixel, a square of size 2 of the plane y = 0 about the origin, seen from
/// nearby. Rays that are sent on take as many samples.
Scene square_of_floor(int samples) {
  Scene scene = dark_scene();
  scene.settings.width = scene.settings.height = 1;
  scene.settings.min_samples = scene.settings.max_samples = samples;
  scene.settings.target_error = 1e-9;
  scene.camera = {.position = {0, 1e-3, 0},
                  .pointing = {0, 0, 0},
                  .fov = pi / 2,
                  .projection = Projection::orthographic,
                  .focal_distance = 1};
  return scene;
}

Color pixel_of(const Scene& scene) {
  return render(prepare(scene), {.threads = 2}).at(0, 0);
}

/// Returns the scene with a floor, all of it white, seen in a square that is so small that it is a
/// point.
Scene point_of_floor(int samples) {
  Scene scene = square_of_floor(samples);
  scene.camera.fov = 1e-6;
  scene.entities = {Plane{.normal = {0, 1, 0}, .position = {0, 0, 0}, .material = white()}};
  return scene;
}

/// Returns the same solid as an operation, of which no samples are taken.
Entity as_operation(const Entity& solid) {
  return solid - Entity(Sphere{.center = {0, 1e4, 0}, .radius = 1});
}

/// Returns solids that give off light, above the floor near the origin.
std::vector<std::pair<const char*, Entity>> solids() {
  const SharedMaterial light = glowing({1, 0.5, 2});
  const std::vector<Vec3> corners = {{-0.5, 1, 0}, {0.5, 1.2, 0}, {0, 2, 0.2}, {0.1, 1.3, 1}};
  const std::vector<TriangleIndices> facets = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  return {
      {"sphere", Sphere{.center = {0.3, 1.5, 0}, .radius = 0.8, .material = light}},
      {"scaled sphere", Entity(Sphere{.center = {0.3, 1, 0}, .radius = 0.5, .material = light})
                            .transformed(rotate_degrees({10, 20, 30}))
                            .transformed(scale({1.5, 1.5, 1.5}))},
      {"box", Box{.corner_a = {-1, 0.5, -0.2}, .corner_b = {0.2, 1, 0.9}, .material = light}},
      {"turned box",
       Entity(Box{.corner_a = {-1, -0.3, -0.2}, .corner_b = {0.2, 0.2, 0.9}, .material = light})
           .transformed(scale({1, 1.5, 0.7}))
           .transformed(rotate_degrees({20, 35, 50}))
           .transformed(translate({0.2, 1.6, 0}))},
      {"cylinder",
       Cylinder{.from = {-0.4, 0.8, 0.1}, .to = {0.7, 1.4, 0.5}, .radius = 0.3, .material = light}},
      {"mesh", Mesh{.triangles = mesh_triangles(corners, facets), .material = light}},
  };
}

}  // namespace

TEST_CASE("a floor gets as much of what gives off light by samples as by rays, or by both") {
  for (const auto& [name, solid] : solids()) {
    CAPTURE(name);
    Scene scene = point_of_floor(65536);
    scene.entities.push_back(solid);
    const Color by_samples = pixel_of(scene);
    scene.settings.indirect = 1;
    const Color by_both = pixel_of(scene);
    scene.entities.back() = as_operation(solid);
    const Color by_rays = pixel_of(scene);
    scene.settings.indirect = 0;
    CHECK(pixel_of(scene).r == 0);
    CHECK(by_rays.r > 0.02);
    CHECK(by_samples.r == doctest::Approx(by_rays.r).epsilon(3e-3));
    CHECK(by_both.r == doctest::Approx(by_rays.r).epsilon(2e-3));
    CHECK(by_both.g == doctest::Approx(by_both.r / 2).epsilon(1e-9));
    CHECK(by_both.b == doctest::Approx(by_both.r * 2).epsilon(1e-9));
  }
}

TEST_CASE("so does a rough metal, where both find the light") {
  for (const auto& [name, solid] : solids()) {
    CAPTURE(name);
    Scene scene = point_of_floor(65536);
    const PrincipledMaterial metal{.color = Color{1, 1, 1}, .metallic = 1.0, .roughness = 0.5};
    scene.entities = {Plane{.normal = {0, 1, 0}, .position = {0, 0, 0}, .material = metal}, solid};
    const double both = pixel_of(scene).r;
    scene.entities.back() = as_operation(solid);
    CHECK(both == doctest::Approx(pixel_of(scene).r).epsilon(3e-3));
  }
}

TEST_CASE("a glowing ball lights as a light of its shape, and flat ones shine to both sides") {
  Scene scene = point_of_floor(16384);
  scene.entities.emplace_back(Sphere{.center = {0, 3, 0}, .radius = 1, .material = glowing()});
  CHECK(pixel_of(scene).r == doctest::Approx(1.0 / 9).epsilon(1e-5));
  for (const double side : {1.0, -1.0}) {
    scene.entities.back() =
        Disc{.center = {0, 2, 0}, .normal = {0, side, 0}, .radius = 2, .material = glowing()};
    CHECK(pixel_of(scene).r == doctest::Approx(0.5).epsilon(2e-3));
    scene.entities.back() =
        Triangle{.a = {-1, 2, -1}, .b = {1, 2, side}, .c = {1, 2, -side}, .material = glowing()};
    CHECK(pixel_of(scene).r > 0.01);
  }
}

TEST_CASE("facing squares and discs exchange what the formulas of their view factors say") {
  // Source: Howell, A catalog of radiation heat transfer configuration factors, C-11 and C-41.
  const auto mean_of = [](Scene scene) {
    constexpr int side = 16;
    scene.settings.width = scene.settings.height = side;
    const Image image = render(prepare(scene), {.threads = 2});
    double sum = 0;
    for (int i = 0; i < side * side; ++i) sum += image.at(i % side, i / side).r / (side * side);
    return sum;
  };
  for (const double distance : {0.5, 1.0, 2.0, 6.0}) {
    CAPTURE(distance);
    Scene scene = square_of_floor(4096);
    scene.entities = {Plane{.normal = {0, 1, 0}, .position = {0, 0, 0}, .material = white()}};
    scene.lights = {RectangleLight{.corner = {-1, distance, -1},
                                   .edge_a = {2, 0, 0},
                                   .edge_b = {0, 0, 2},
                                   .visible = false,
                                   .two_sided = true}};
    const double x = 2 / distance;
    const double root = std::sqrt(1 + x * x);
    const double squares = 2 / (pi * x * x) *
                           (std::log((1 + x * x) / std::sqrt(1 + 2 * x * x)) +
                            2 * x * root * std::atan(x / root) - 2 * x * std::atan(x));
    CHECK(mean_of(scene) == doctest::Approx(squares).epsilon(1e-4));

    // A disc fills pi / 4 of the picture.
    const double radius = 1.5;
    scene.lights.clear();
    scene.entities = {Disc{.center = {0, 0, 0}, .normal = {0, 1, 0}, .material = white()},
                      Disc{.center = {0, distance, 0},
                           .normal = {0, 1, 0},
                           .radius = radius,
                           .material = glowing()}};
    const double r1 = 1 / distance;
    const double r2 = radius / distance;
    const double s = 1 + (1 + r2 * r2) / (r1 * r1);
    const double discs = (s - std::sqrt(s * s - 4 * (r2 / r1) * (r2 / r1))) / 2;
    CHECK(mean_of(scene) == doctest::Approx(pi / 4 * discs).epsilon(1e-4));
    scene.entities.pop_back();
    scene.lights = {DiscLight{.center = {0, distance, 0}, .radius = radius, .visible = false}};
    CHECK(mean_of(scene) == doctest::Approx(pi / 4 * discs).epsilon(1e-4));
  }
}

TEST_CASE("many lights together give the sum of what each gives") {
  std::vector<Light> lights;
  double exact = 0;
  for (int i = 0; i < 300; ++i) {
    const double angle = 2.4 * i;
    const double away = 0.1 * i;
    const Vec3 center(away * std::cos(angle), 1 + 0.01 * i, away * std::sin(angle));
    const double brightness = 1 + i % 7;
    const double radius = 0.05 + 0.001 * (i % 11);
    lights.emplace_back(SphereLight{
        .center = center, .radius = radius, .color = grey(brightness), .visible = i % 2 == 0});
    const double squared = glm::dot(center, center);
    exact += brightness * radius * radius / squared * center.y / std::sqrt(squared);
  }
  Scene scene = point_of_floor(65536);
  scene.lights = lights;
  CHECK(pixel_of(scene).r == doctest::Approx(exact).epsilon(2e-3));
  // Rays find those that are visible, too.
  scene.settings.indirect = 1;
  CHECK(pixel_of(scene).r == doctest::Approx(exact).epsilon(2e-3));
  // A rough metal gets as much whether rays find lights or not.
  scene.settings.indirect = 0;
  const PrincipledMaterial metal{.color = Color{1, 1, 1}, .metallic = 1.0, .roughness = 0.6};
  scene.entities = {Plane{.normal = {0, 1, 0}, .position = {0, 0, 0}, .material = metal}};
  const double both = pixel_of(scene).r;
  for (Light& light : scene.lights) std::get<SphereLight>(light).visible = false;
  CHECK(both == doctest::Approx(pixel_of(scene).r).epsilon(1e-2));
}

TEST_CASE("few lights are all asked, many are asked by choice: both see the same shadows") {
  Scene scene = point_of_floor(65536);
  for (int i = 0; i < 16; ++i) {
    scene.lights.emplace_back(SphereLight{
        .center = {0.5 * i - 4, 2, 0}, .radius = 0.2, .color = grey(3), .visible = false});
  }
  scene.entities.emplace_back(Sphere{.center = {0.6, 0.8, 0}, .radius = 0.3, .material = inert()});
  const double each = pixel_of(scene).r;
  // One more is so far away that it does not count.
  scene.lights.emplace_back(SphereLight{.center = {0, 1e6, 0}, .radius = 1});
  CHECK(pixel_of(scene).r == doctest::Approx(each).epsilon(2e-3));
}

TEST_CASE("what gives off light in places only, or lets light through, is found by rays") {
  PrincipledMaterial tiles{.color = Color{0, 0, 0}};
  tiles.emission = Pattern(Checker{.color_a = grey(2), .color_b = grey(0), .scale = 0.2});
  for (const SharedMaterial& material :
       {SharedMaterial(tiles),
        SharedMaterial(Material{.color = grey(0), .transparency = 0.5, .emission = grey(1)})}) {
    Scene scene = point_of_floor(4096);
    scene.entities.emplace_back(
        Box{.corner_a = {-1, 1, -1}, .corner_b = {1, 1.2, 1}, .material = material});
    CHECK(pixel_of(scene).r == 0);
    scene.settings.indirect = 1;
    CHECK(pixel_of(scene).r > 0.2);
  }
}

TEST_CASE("with something that gives off light there is no head light") {
  Scene scene = point_of_floor(16);
  scene.settings.head_light = true;
  CHECK(pixel_of(scene).r > 0.9);
  scene.entities.emplace_back(Sphere{.center = {0, -5, 0}, .radius = 1, .material = glowing()});
  CHECK(pixel_of(scene).r == 0);
  CHECK(prepare(scene).warnings().empty());
}

TEST_CASE("pictures of many lights have the same bytes for any threads and regions") {
  Scene scene = varied_scene();
  scene.settings.target_error = 0;
  scene.settings.supersampling = 2;
  scene.settings.indirect = 1;
  for (const auto& [name, solid] : solids()) scene.entities.push_back(solid);
  for (int i = 0; i < 40; ++i)
    scene.lights.emplace_back(DiscLight{.center = {0.3 * i - 6, 3, 0}, .radius = 0.1});
  check_threads_and_regions(prepare(scene));
}
