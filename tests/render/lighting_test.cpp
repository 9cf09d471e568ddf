// These tests compare lit surfaces with the formulas, which are computed here once more.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "pictures.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr double float_precision = 1e-6;

void check_color(const Color& color, double r, double g, double b) {
  CHECK(color.r == doctest::Approx(r).epsilon(float_precision));
  CHECK(color.g == doctest::Approx(g).epsilon(float_precision));
  CHECK(color.b == doctest::Approx(b).epsilon(float_precision));
}

}  // namespace

TEST_CASE("a lit sphere has the ambient, diffuse and specular light of the formulas") {
  const Material material{.color = Color{0.9, 0.6, 0.3},
                          .reflectivity = 0.2,
                          .diffuse = 0.7,
                          .specular = 0.5,
                          .shininess = 12};
  const PointLight light{
      .origin = {3, 4, -5}, .color = {1, 0.9, 0.8}, .falloff = 60, .ambient = 0.1};
  const Vec3 eye(0, 0, -6);
  Scene scene = dark_scene();
  scene.settings.recursion_depth = 0;
  scene.entities = {Sphere{.center = {0, 0, 0}, .radius = 2, .material = material}};
  scene.lights = {light};

  for (const FalloffModel model : {FalloffModel::path, FalloffModel::light}) {
    scene.settings.falloff_model = model;
    for (const Vec3& normal :
         {Vec3(0, 0, -1), Vec3(0.6, 0, -0.8), Vec3(0, 0.6, -0.8), Vec3(-0.48, -0.6, -0.64)}) {
      const Vec3 point = 2.0 * normal;
      const Vec3 view = glm::normalize(point - eye);
      const Vec3 to_light = light.origin - point;
      const Vec3 l = glm::normalize(to_light);
      const double distance =
          glm::length(to_light) + (model == FalloffModel::path ? glm::length(point - eye) : 0);
      const double intensity = 60 / (distance * distance);
      const double cosine = std::max(0.0, glm::dot(l, normal));
      const Vec3 reflected = 2 * glm::dot(l, normal) * normal - l;
      const double highlight =
          cosine > 0 ? std::pow(std::max(0.0, -glm::dot(reflected, view)), 12) : 0;
      const double answer = intensity * (0.7 * cosine + 0.5 * highlight);
      const double ambient = 0.1 * (1 - 0.2);
      check_color(seen(scene, eye, point), 1.0 * (ambient + 0.9 * answer),
                  0.9 * (ambient + 0.6 * answer), 0.8 * (ambient + 0.3 * answer));
    }
  }
}

TEST_CASE("by the surface's model ambient light takes the surface's colour and opacity") {
  Scene scene = dark_scene();
  scene.settings.recursion_depth = 0;
  scene.settings.ambient_model = AmbientModel::surface;
  scene.lights = {glow(0.5)};
  const auto seen_of = [&](const Material& material) {
    scene.entities = {Plane{.normal = {0, 0, -1}, .material = material}};
    return seen(scene, {0, 0, -3}, {0, 0, 0});
  };
  check_color(seen_of({.color = grey(0), .diffuse = 0}), 0, 0, 0);
  check_color(seen_of({.color = Color{1, 0.5, 0.25}, .diffuse = 0}), 0.5, 0.25, 0.125);
  check_color(seen_of({.color = grey(1), .reflectivity = 0.25, .transparency = 0.5, .diffuse = 0}),
              0.125, 0.125, 0.125);
}

TEST_CASE("a scene without lights is lit from where it is seen, unless nobody wants that") {
  Scene scene = dark_scene();
  scene.settings.head_light = true;
  scene.entities = {Plane{.normal = {0, 0, -1}, .material = Material{.color = grey(0.5)}}};
  check_color(seen(scene, {0, 0, -3}, {0, 0, 0}), 0.5, 0.5, 0.5);
  // At 60 degrees from the normal there is half of the light.
  check_color(seen(scene, {std::sqrt(3.0), 0, -1}, {0, 0, 0}), 0.25, 0.25, 0.25);
  scene.camera.projection = Projection::orthographic;
  check_color(seen(scene, {std::sqrt(3.0), 0, -1}, {0, 0, 0}), 0.25, 0.25, 0.25);

  scene.settings.head_light = false;
  check_color(seen(scene, {0, 0, -3}, {0, 0, 0}), 0, 0, 0);
  scene.settings.head_light = true;
  scene.settings.compat = compat_2015;
  check_color(seen(scene, {0, 0, -3}, {0, 0, 0}), 0, 0, 0);
  scene.settings.compat = 0;
  scene.lights = {glow(0)};
  check_color(seen(scene, {0, 0, -3}, {0, 0, 0}), 0, 0, 0);
}

TEST_CASE("the diffuse strength defaults to what is neither mirrored nor let through") {
  Scene scene = dark_scene();
  scene.settings.recursion_depth = 0;
  scene.lights = {ParallelLight{.from = {0, 0, -1}, .pointing = {0, 0, 0}}};
  scene.entities = {
      Plane{.normal = {0, 0, -1},
            .material = Material{.color = grey(1), .reflectivity = 0.25, .transparency = 0.5}}};
  check_color(seen(scene, {0, 0, -3}, {0, 0, 0}), 0.25, 0.25, 0.25);
}

TEST_CASE("the path to a light goes over all mirrors on the way") {
  // It is 3 from camera to mirror, 5 from mirror to wall, 4 from wall to light: the light's share
  // is 288 / 12^2 = 2.
  Scene scene = dark_scene();
  scene.lights = {PointLight{.origin = {0, 0, -1}, .falloff = 288}};
  scene.entities = {
      Plane{.normal = {0, 0, -1}, .position = {0, 0, 0}, .material = inert(0.5)},
      Plane{.normal = {0, 0, 1}, .position = {0, 0, -5}, .material = Material{.color = grey(1)}}};
  scene.settings.falloff_model = FalloffModel::path;
  check_color(seen(scene, {0, 0, -3}, {0, 0, 0}), 1, 1, 1);
  scene.settings.falloff_model = FalloffModel::light;
  check_color(seen(scene, {0, 0, -3}, {0, 0, 0}), 9, 9, 9);
}

TEST_CASE("an opaque thing between light and point leaves the ambient light alone") {
  Scene scene = dark_scene();
  const Entity floor = Plane{.material = Material{.color = grey(1)}};
  const Entity sphere = Sphere{.center = {0, 2, 0}, .radius = 0.5};
  scene.lights = {PointLight{.origin = {0, 4, 0}, .ambient = 0.125}};
  scene.entities = {floor, sphere};
  check_color(seen(scene, {1, 1, 0}, {0, 0, 0}), 0.125, 0.125, 0.125);
  scene.entities = {floor};
  check_color(seen(scene, {1, 1, 0}, {0, 0, 0}), 1.125, 1.125, 1.125);
}

TEST_CASE("a thing behind the light casts no shadow") {
  Scene scene = dark_scene();
  scene.lights = {PointLight{.origin = {0, 4, 0}}};
  scene.entities = {Plane{.material = Material{.color = grey(1)}},
                    Sphere{.center = {0, 6, 0}, .radius = 0.5}};
  check_color(seen(scene, {1, 1, 0}, {0, 0, 0}), 1, 1, 1);
}

TEST_CASE("a surface is lit on the viewer's side only") {
  Scene scene = dark_scene();
  scene.lights = {ParallelLight{.from = {0, 0, -1}, .pointing = {0, 0, 0}}};
  scene.entities = {Disc{.normal = {0, 0, -1}, .material = Material{.color = grey(1)}}};
  check_color(seen(scene, {0, 0, -2}, {0, 0, 0}), 1, 1, 1);
  check_color(seen(scene, {0, 0, 2}, {0, 0, 0}), 0, 0, 0);
}

TEST_CASE("the inside of an opaque solid is lit by a light inside") {
  Scene scene = dark_scene();
  scene.lights = {PointLight{.origin = {0, 0, 0}}};
  scene.entities = {Sphere{.radius = 3, .material = Material{.color = grey(1)}}};
  check_color(seen(scene, {0, 0, 0.5}, {0, 0, 1}), 1, 1, 1);
}

TEST_CASE("light is tinted at each crossing of its path, and absorbed by the length inside") {
  const Material stained{
      .color = Color{1, 0.5, 0.25}, .transparency = 0.8, .absorption = {0.1, 0.2, 0.4}};
  Scene scene = dark_scene();
  scene.lights = {ParallelLight{.from = {0, 1, 0}, .pointing = {0, 0, 0}}};
  const Entity floor = Plane{.material = Material{.color = grey(1)}};
  const Entity block = Box{.corner_a = {-1, 1, -1}, .corner_b = {1, 4, 1}, .material = stained};
  scene.entities = {floor, block};
  check_color(seen(scene, {5, 0.5, 0}, {0, 0, 0}), 0.64 * std::exp(-0.3),
              0.64 * 0.25 * std::exp(-0.6), 0.64 * 0.0625 * std::exp(-1.2));

  // A mere surface is crossed once and has no inside.
  scene.entities = {floor, Disc{.center = {0, 2, 0}, .material = stained}};
  check_color(seen(scene, {5, 0.5, 0}, {0, 0, 0}), 0.8, 0.8 * 0.5, 0.8 * 0.25);
}

TEST_CASE("inside nested solids the innermost absorbs") {
  const auto clear = [](double absorption) {
    return Material{.color = grey(1), .transparency = 1, .absorption = grey(absorption)};
  };
  Scene scene = dark_scene();
  scene.lights = {PointLight{.origin = {0, 10, 0}}};
  scene.entities = {Plane{.material = Material{.color = grey(1)}},
                    Box{.corner_a = {-1, 1, -1}, .corner_b = {1, 6, 1}, .material = clear(0.1)},
                    Box{.corner_a = {-1, 2, -1}, .corner_b = {1, 4, 1}, .material = clear(0.7)}};
  const double expected = std::exp(-0.1 * (1 + 2) - 0.7 * 2);
  check_color(seen(scene, {5, 0.5, 0}, {0, 0, 0}), expected, expected, expected);
}

TEST_CASE("light that starts in a medium is absorbed from there") {
  // The light is in the same water as the lit floor, so both distances count.
  Scene scene = dark_scene();
  scene.lights = {PointLight{.origin = {0, 3, 0}}};
  scene.entities = {
      Box{.corner_a = {-9, -9, -9},
          .corner_b = {9, 9, 9},
          .material =
              Material{.color = grey(1), .transparency = 1, .diffuse = 0, .absorption = grey(0.2)}},
      Plane{.material = Material{.color = grey(1)}}};
  const double expected = std::exp(-0.2 * (3 + 2));
  check_color(seen(scene, {0, 2, 0}, {0, 0, 0}), expected, expected, expected);
}

TEST_CASE("the gaps of a pattern let light through") {
  const Material lattice{.color =
                             Pattern(Checker{.color_a = {1, 1, 1, 1}, .color_b = {1, 1, 1, 0}})};
  Scene scene = dark_scene();
  scene.lights = {ParallelLight{.from = {0, 0, -1}, .pointing = {0, 0, 0}}};
  scene.entities = {
      Plane{.normal = {0, 0, -1}, .position = {0, 0, 5}, .material = Material{.color = grey(1)}},
      Disc{.center = {0, 0, 0.5}, .normal = {0, 0, -1}, .radius = 9, .material = lattice}};
  // Seen from the side under the lattice, these are points behind a filled and an open square.
  check_color(seen(scene, {20, 0.5, 4}, {0.5, 0.5, 5}), 0, 0, 0);
  check_color(seen(scene, {20, 0.5, 4}, {1.5, 0.5, 5}), 1, 1, 1);
  // Seen through the lattice, the filled square is lit itself, and the open one shows the plane.
  CHECK(look(scene, {0.5, 0.5, -3}, {0.5, 0.5, 5}).stats().refraction_rays == 0);
  CHECK(look(scene, {1.5, 0.5, -3}, {1.5, 0.5, 5}).stats().refraction_rays == 1);
  check_color(seen(scene, {1.5, 0.5, -3}, {1.5, 0.5, 5}), 1, 1, 1);
}

TEST_CASE("a bump tilts the normal by the slope of its height, also on an entity that is scaled") {
  // The bump's height is 0.2 (0.5 + 0.5 cos(2 pi x)) in the entity's space.
  const Material bumpy{
      .color = grey(1), .bump = Gradient{.direction = {1, 0, 0}}, .bump_height = 0.2};
  for (const double factor : {1.0, 4.0}) {
    Scene scene = dark_scene();
    scene.lights = {ParallelLight{.from = {0, 1, 0}, .pointing = {0, 0, 0}}};
    scene.entities = {Entity(Plane{.material = bumpy}).transformed(scale(Vec3(factor, 1, 1)))};
    for (const double x : {0.1, 0.25, 0.4, 0.7}) {
      const double slope = -0.2 * std::numbers::pi * std::sin(2 * std::numbers::pi * x) / factor;
      const double expected = 1 / std::sqrt(1 + slope * slope);
      const Color color = seen(scene, {x * factor, 5, 0}, {x * factor, 0, 0});
      CHECK(color.r == doctest::Approx(expected).epsilon(1e-3));
    }
  }
}
