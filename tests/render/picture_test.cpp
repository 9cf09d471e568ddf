// These tests check whole pictures: sampling, symmetry, and that the bytes are equal however they
// are made.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "pictures.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Makes a scene with a bit of everything.
Scene busy_scene() {
  Scene scene;
  scene.settings.width = 45;
  scene.settings.height = 34;
  scene.settings.supersampling = 2;
  scene.settings.dof_samples = 3;
  scene.camera = {
      .position = {0.3, 1.5, -5}, .pointing = {0, 0.5, 0}, .aperture = 50, .focal_distance = 5};
  scene.background = GradientBackground{};
  scene.lights = {PointLight{.origin = {3, 5, -4}, .falloff = 80, .ambient = 0.05},
                  SpotLight{.origin = {-4, 6, -2}, .pointing = {0, 0, 0}}};
  Material crystal = glass(1.5);
  crystal.absorption = {0.1, 0.4, 0.2};
  const Material tiles{.color = Pattern(Checker{}), .reflectivity = 0.2};
  const Material clouds{
      .color = Pattern(Noise{}), .specular = 0.5, .bump = Noise{.scale = 0.2}, .bump_height = 0.02};
  scene.entities = {Plane{.material = tiles},
                    Sphere{.center = {0, 1, 0}, .radius = 1, .material = crystal},
                    (Entity(Box{.corner_a = {1, 0, 0}, .corner_b = {2, 1, 1}, .material = clouds}) -
                     Entity(Sphere{.center = {1.5, 1, 0.5}, .radius = 0.4})),
                    Sphere{.center = {-1.5, 0.5, 1}, .radius = 0.5, .material = clouds}};
  return scene;
}

void paste(const Image& part, int left, int top, Image& whole) {
  for (int y = 0; y < part.height(); ++y) {
    for (int x = 0; x < part.width(); ++x) whole.set(left + x, top + y, part.at(x, y));
  }
}

}  // namespace

TEST_CASE("a picture has the same bytes for any number of threads") {
  const PreparedScene scene = prepare(busy_scene());
  const Image reference = render(scene, {.threads = 1});
  for (const int threads : {0, 2, 7})
    CHECK(same_pixels(render(scene, {.threads = threads}), reference));
}

TEST_CASE("counts are the same for any number of threads") {
  const PreparedScene scene = prepare(busy_scene());
  const RenderStats one = render(scene, {.threads = 1}).stats();
  const RenderStats many = render(scene, {.threads = 7}).stats();
  CHECK(one.camera_rays == many.camera_rays);
  CHECK(one.shadow_rays == many.shadow_rays);
  CHECK(one.reflection_rays == many.reflection_rays);
  CHECK(one.refraction_rays == many.refraction_rays);
  CHECK(one.rays_below_min_weight == many.rays_below_min_weight);
  CHECK(one.rays_beyond_depth == many.rays_beyond_depth);
  CHECK(one.intersection_tests == many.intersection_tests);
  CHECK(one.interval_events == many.interval_events);
  CHECK(one.media_lookups == many.media_lookups);
  CHECK(one.media_changes == many.media_changes);
  CHECK(one.pattern_lookups == many.pattern_lookups);
  CHECK(one.lens_samples == many.lens_samples);
  CHECK(one.threads == 1);
  CHECK(many.threads >= 1);
  CHECK(many.threads <= 7);
  CHECK(many.pixels == 45 * 34);
}

TEST_CASE("a picture pasted together from regions is the picture") {
  const PreparedScene scene = prepare(busy_scene());
  const Image reference = render(scene);
  Image pasted(45, 34);
  for (int y = 0; y < 34; y += 13) {
    for (int x = 0; x < 45; x += 17) {
      const Region region{x, y, std::min(17, 45 - x), std::min(13, 34 - y)};
      const Image part = render(scene, {.region = region, .threads = 2});
      CHECK(part.width() == region.width);
      CHECK(part.height() == region.height);
      paste(part, x, y, pasted);
    }
  }
  CHECK(same_pixels(pasted, reference));
}

TEST_CASE("the seed changes the noise of a lens and nothing else") {
  Scene scene = busy_scene();
  const Image first = render(prepare(scene));
  scene.settings.seed = 1;
  CHECK_FALSE(same_pixels(render(prepare(scene)), first));
  scene.camera.aperture = 0;
  const Image sharp = render(prepare(scene));
  scene.settings.seed = 2;
  CHECK(same_pixels(render(prepare(scene)), sharp));
}

TEST_CASE("in a white furnace every pixel is exactly 1") {
  Scene scene = busy_scene();
  scene.background = SolidBackground{{1, 1, 1}};
  scene.lights = {glow(1)};
  scene.settings.recursion_depth = 20;
  scene.entities = {Sphere{.center = {0, 1, 0}, .radius = 1, .material = inert(0.5)},
                    Plane{.material = inert()},
                    Torus{.center = {2, 1, 2}, .material = inert(0.25)}};
  scene.settings.min_weight = 0;
  const Image image = render(prepare(scene));
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) REQUIRE(image.at(x, y) == Color{1, 1, 1, 1});
  }
}

TEST_CASE("a scene that is its own mirror image gives a picture that is too") {
  Scene scene;
  scene.settings.width = 40;
  scene.settings.height = 30;
  scene.settings.supersampling = 2;
  scene.camera = {.position = {0, 1, -5}, .pointing = {0, 0.5, 0}};
  scene.lights = {PointLight{.origin = {0, 6, -3}, .falloff = 50}};
  scene.entities = {Plane{.material = Material{.reflectivity = 0.3}},
                    Sphere{.center = {-1, 1, 0}, .radius = 0.7, .material = glass(1.5)},
                    Sphere{.center = {1, 1, 0}, .radius = 0.7, .material = glass(1.5)},
                    Torus{.center = {0, 0.5, 2},
                          .material = Material{.color = Color{0.8, 0.3, 0.2}, .specular = 1}}};
  const Image image = render(prepare(scene));
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 20; ++x) {
      const Color left = image.at(x, y);
      const Color right = image.at(39 - x, y);
      REQUIRE(left.r == doctest::Approx(right.r).epsilon(1e-6));
      REQUIRE(left.g == doctest::Approx(right.g).epsilon(1e-6));
      REQUIRE(left.b == doctest::Approx(right.b).epsilon(1e-6));
    }
  }
}

namespace {

/// Makes a scene of spheres, boxes, planes, CSG and a lens, every length of it multiplied by
/// `unit`.
Scene scaled_scene(double unit) {
  Scene scene = busy_scene();
  scene.settings.supersampling = 1;
  scene.camera = {.position = unit * Vec3(0.3, 1.5, -5),
                  .pointing = unit * Vec3(0, 0.5, 0),
                  .aperture = 50 * unit,
                  .focal_distance = 5 * unit};
  scene.lights = {
      PointLight{.origin = unit * Vec3(3, 5, -4), .ambient = 0.05},
      SpotLight{.origin = unit * Vec3(-4, 6, -2), .pointing = Vec3(0)},
      CylinderLight{
          .origin = unit * Vec3(0, 6, 2), .pointing = unit * Vec3(0, 0, 2), .radius = unit}};
  Material crystal = glass(1.5);
  crystal.absorption = {0.1 / unit, 0.4 / unit, 0.2 / unit};
  const Material tiles{.color = Pattern(Checker{.scale = unit}), .reflectivity = 0.2};
  const Material clouds{.color = Pattern(Noise{.scale = unit}),
                        .specular = 0.5,
                        .bump = Noise{.scale = 0.25 * unit},
                        .bump_height = 0.02 * unit};
  scene.entities = {Plane{.material = tiles},
                    Sphere{.center = unit * Vec3(0, 1, 0), .radius = unit, .material = crystal},
                    (Entity(Box{.corner_a = unit * Vec3(1, 0, 0),
                                .corner_b = unit * Vec3(2, 1, 1),
                                .material = clouds}) -
                     Entity(Sphere{.center = unit * Vec3(1.5, 1, 0.5), .radius = 0.4 * unit}))};
  return scene;
}

}  // namespace

TEST_CASE("multiplying every length by a power of two gives the same bytes") {
  const Image reference = render(prepare(scaled_scene(1)));
  for (const int exponent : {-90, -37, -1, 3, 50, 90}) {
    CAPTURE(exponent);
    CHECK(same_pixels(render(prepare(scaled_scene(std::ldexp(1.0, exponent)))), reference));
  }
}

TEST_CASE("supersampling is the mean over a grid of subpixel centres") {
  Scene scene = busy_scene();
  scene.camera.aperture = 0;
  scene.settings.width = 8;
  scene.settings.height = 6;
  scene.settings.supersampling = 3;
  const Image coarse = render(prepare(scene));
  scene.settings.width = 24;
  scene.settings.height = 18;
  scene.settings.supersampling = 1;
  const Image fine = render(prepare(scene));
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 8; ++x) {
      double sum = 0;
      for (int i = 0; i < 9; ++i) sum += fine.at(3 * x + i % 3, 3 * y + i / 3).g;
      CHECK(coarse.at(x, y).g == doctest::Approx(sum / 9).epsilon(1e-5));
    }
  }
}

TEST_CASE("a point out of focus is blurred into a disc of radius aperture |z - f| / z") {
  // The sphere is at twice the focal distance. On the focal plane the blur has half the lens's
  // radius.
  const double lens_radius = 0.2;
  const double focal_distance = 2;
  const double distance = 4;
  const double sphere_radius = 0.02;
  Scene scene = dark_scene();
  scene.background = SolidBackground{{1, 1, 1}};
  scene.settings.width = 41;
  scene.settings.height = 41;
  scene.settings.dof_samples = 2000;
  scene.camera = {.position = {0, 0, 0},
                  .pointing = {0, 0, 1},
                  .fov = 2 * std::atan(0.1),  // the focal plane is 0.4 high: 0.4 / 41 a pixel
                  .aperture = 1000 * lens_radius,
                  .focal_distance = focal_distance};
  scene.entities = {
      Sphere{.center = {0, 0, distance}, .radius = sphere_radius, .material = inert()}};
  const Image image = render(prepare(scene));

  const double pixel = 0.4 / 41;
  const double blur = lens_radius * (distance - focal_distance) / distance;
  const double sphere_in_focus = sphere_radius * focal_distance / distance;
  // Inside, the sphere covers this share of what the lens sees there.
  const double share = (sphere_in_focus / blur) * (sphere_in_focus / blur);
  double darkness_inside = 0;
  int pixels_inside = 0;
  for (int y = 0; y < 41; ++y) {
    for (int x = 0; x < 41; ++x) {
      const double from_middle = pixel * std::hypot(x - 20, y - 20);
      const double darkness = 1 - image.at(x, y).r;
      if (from_middle > blur + 1.02 * sphere_in_focus) REQUIRE(darkness == 0);
      if (from_middle < blur - 1.02 * sphere_in_focus) {
        REQUIRE(darkness > 0);
        darkness_inside += darkness;
        ++pixels_inside;
      }
    }
  }
  CHECK(pixels_inside > 100);
  CHECK(darkness_inside / pixels_inside == doctest::Approx(share).epsilon(0.03));
}

TEST_CASE("on the focal plane a lens changes nothing") {
  Scene scene = dark_scene();
  scene.settings.width = 20;
  scene.settings.height = 20;
  scene.camera = {.position = {0, 0, 0}, .pointing = {0, 0, 1}, .focal_distance = 3};
  scene.lights = {ParallelLight{.from = {0, 0, 0}, .pointing = {0, 0, 1}}};
  scene.entities = {Plane{
      .normal = {0, 0, -1},
      .position = {0, 0, 3},
      .material = Material{.color = Pattern(Gradient{.direction = {1, 0.3, 0}, .scale = 2})}}};
  const Image sharp = render(prepare(scene));
  scene.camera.aperture = 300;
  scene.settings.dof_samples = 16;
  const Image lens = render(prepare(scene));
  CHECK(lens.stats().lens_samples == 20 * 20 * 16);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x)
      CHECK(lens.at(x, y).r == doctest::Approx(sharp.at(x, y).r).epsilon(1e-5));
  }
}

TEST_CASE("the picture carries its settings and how it was made") {
  Scene scene = busy_scene();
  scene.settings.title = "busy";
  const Image image = render(prepare(scene), {.threads = 2});
  CHECK(image.settings().title == "busy");
  CHECK(image.stats().threads <= 2);
  CHECK(image.stats().trace_seconds > 0);
  CHECK(image.stats().prepare_seconds > 0);
  CHECK_FALSE(image.display_encoded());
}
