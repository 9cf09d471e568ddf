// Light that bounces, light from the background, and what rays see that end: against closed forms.
#include <doctest/doctest.h>

#include <cmath>
#include <memory>

#include "crt/error.hpp"
#include "pictures.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Makes a scene of one pixel that takes so many samples.
Scene sampled_scene(int samples) {
  Scene scene = dark_scene();
  scene.settings.width = 1;
  scene.settings.height = 1;
  scene.settings.min_samples = samples;
  scene.settings.max_samples = samples;
  scene.settings.target_error = 1e-9;
  scene.camera.fov = 1e-4;
  return scene;
}

Color middle(const Scene& scene) {
  return render(prepare(scene), {.threads = 2}).at(0, 0);
}

Material matt(double albedo) {
  return {.color = grey(albedo), .diffuse = 1};
}

}  // namespace

TEST_CASE("within a ball, light bounces as often as the settings say") {
  // Everywhere there is as much light of each bounce: albedo^n of the light at the center.
  Scene scene = sampled_scene(16);
  const double albedo = 0.75;
  scene.entities = {Sphere{.center = {0, 0, 0}, .radius = 2, .material = matt(albedo)}};
  scene.lights = {PointLight{.origin = {0, 0, 0}, .color = {1, 0.5, 0.25}}};
  scene.camera.position = {0.3, -0.2, 0.4};
  scene.camera.pointing = {0.3, 1, 0.7};
  double sum = 0;
  for (int bounces = 0; bounces <= 6; ++bounces) {
    sum += std::pow(albedo, bounces + 1);
    scene.settings.indirect = bounces;
    const Color seen = middle(scene);
    CHECK(seen.r == doctest::Approx(sum).epsilon(1e-6));
    CHECK(seen.b == doctest::Approx(sum / 4).epsilon(1e-6));
  }
}

TEST_CASE("a wall gets half of what an endless floor sends back") {
  Scene scene = sampled_scene(16384);
  scene.lights = {ParallelLight{.from = {0, 1, 0}, .pointing = {0, 0, 0}}};
  scene.entities = {Plane{.normal = {0, 1, 0}, .position = {0, 0, 0}, .material = matt(0.8)},
                    Plane{.normal = {0, 0, -1}, .position = {0, 0, 5}, .material = matt(0.5)}};
  scene.settings.indirect = 1;
  scene.camera.position = {0, 3, 0};
  scene.camera.pointing = {0, 3, 5};
  CHECK(middle(scene).r == doctest::Approx(0.5 * 0.5 * 0.8).epsilon(1e-3));
  scene.settings.indirect = 0;
  CHECK(middle(scene).r == 0);
}

TEST_CASE("light that bounces takes the place of ambient light") {
  Scene scene = sampled_scene(16);
  scene.entities = {Sphere{.material = matt(0.5)}};
  scene.lights = {glow(0.5)};
  scene.camera = {.position = {0, 0, -4}, .pointing = {0, 0, 0}, .fov = 1e-4};
  CHECK(middle(scene).r > 0.4);
  scene.settings.indirect = 1;
  CHECK(middle(scene).r < 1e-3);
}

TEST_CASE("a lone body under an even sky is as bright as its colour") {
  for (const int indirect : {0, 3}) {
    Scene scene = sampled_scene(4096);
    scene.background = SolidBackground{{0.5, 1, 2}};
    scene.lights = {EnvironmentLight{}};
    scene.settings.indirect = indirect;
    scene.entities = {Sphere{.material = matt(0.8)}};
    scene.camera = {.position = {0, 0, -4}, .pointing = {0, 0, 0}, .fov = 1e-4};
    const Color seen = middle(scene);
    CHECK(seen.r == doctest::Approx(0.4).epsilon(2e-3));
    CHECK(seen.g == doctest::Approx(0.8).epsilon(2e-3));
    CHECK(seen.b == doctest::Approx(1.6).epsilon(2e-3));
  }
}

TEST_CASE("a floor under a gradient gets the gradient's mean by cosines") {
  // The mean of horizon + (sky - horizon) y over the upper half, weighted by y, is at two thirds.
  Scene scene = sampled_scene(16384);
  scene.background = GradientBackground{.horizon = {0.3, 0.3, 0.3}, .sky = {0.9, 0.6, 0}};
  scene.lights = {EnvironmentLight{.scale = 2}};
  scene.entities = {Plane{.normal = {0, 1, 0}, .position = {0, 0, 0}, .material = matt(1)}};
  scene.camera = {.position = {0, 4, -4}, .pointing = {0, 0, 0}, .fov = 1e-4};
  const Color seen = middle(scene);
  CHECK(seen.r == doctest::Approx(2 * (0.3 + 2.0 / 3 * 0.6)).epsilon(1e-3));
  CHECK(seen.b == doctest::Approx(2 * (0.3 - 2.0 / 3 * 0.3)).epsilon(1e-3));
}

TEST_CASE("a small sun in a panorama lights like a sun, and turns with it") {
  auto image = std::make_shared<Image>(512, 256);
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 512; ++x) image->set(x, y, Color{0, 0, 0});
  }
  // It is some 45 degrees above straight ahead.
  for (int y = 62; y < 66; ++y) {
    for (int x = 254; x < 258; ++x) image->set(x, y, Color{1000, 1000, 1000});
  }
  Scene scene = sampled_scene(16384);
  scene.entities = {
      Plane{.normal = {0, 1, 0}, .position = {0, 0, 0}, .material = matt(1)},
      Box{.corner_a = {50, -100, -100}, .corner_b = {60, 100, 100}, .material = matt(1)}};
  scene.lights = {EnvironmentLight{}};
  scene.camera = {.position = {0, 4, -4}, .pointing = {0, 0, 0}, .fov = 1e-4};
  const double texel = 3.14159265358979 / 256;
  const double solid_angle = 16 * texel * texel * std::cos(3.14159265358979 / 4);
  const double exact = 1000 * solid_angle * std::sin(3.14159265358979 / 4) / 3.14159265358979;
  scene.background = PanoramaBackground{.image = image};
  CHECK(middle(scene).r == doctest::Approx(exact).epsilon(2e-3));
  // Turned to the right it is behind the wall.
  scene.background = PanoramaBackground{.image = image, .angle = -3.14159265358979 / 2};
  CHECK(middle(scene).r == 0);
  scene.background = PanoramaBackground{.image = image, .angle = 3.14159265358979 / 2};
  CHECK(middle(scene).r == doctest::Approx(exact).epsilon(2e-3));
}

TEST_CASE("rays that the depth ends see the background, or nothing") {
  Scene scene = dark_scene();
  scene.background = SolidBackground{{0.2, 0.4, 0.6}};
  scene.settings.recursion_depth = 0;
  scene.entities = {Sphere{.material = inert(0.5)}};
  scene.settings.cutoff = Cutoff::black;
  CHECK(seen(scene, {0, 0, -4}, {0, 0, 0}) == Color{0, 0, 0});
  scene.settings.cutoff = Cutoff::background;
  const Color ended = seen(scene, {0, 0, -4}, {0, 0, 0});
  CHECK(ended.r == doctest::Approx(0.1));
  CHECK(ended.b == doctest::Approx(0.3));
  CHECK(render(prepare(scene)).stats().rays_beyond_depth > 0);
  CHECK(settings_of_2015().cutoff == Cutoff::black);
}

TEST_CASE("light by bounces counts no more than the clamp, and nothing is claimed with it") {
  Scene scene = sampled_scene(16);
  scene.entities = {Sphere{.radius = 2, .material = matt(0.75)}};
  scene.lights = {PointLight{.origin = {0, 0, 0}}};
  scene.camera.position = {0.3, -0.2, 0.4};
  scene.camera.pointing = {0.3, 1, 0.7};
  scene.settings.indirect = 2;
  scene.settings.clamp = 0.25;
  CHECK_THROWS_AS(prepare(scene), Error);
  scene.settings.target_error = 0;
  CHECK(middle(scene).r == doctest::Approx(0.75 + 0.25 + 0.25).epsilon(1e-6));
}

TEST_CASE("pictures of bounced light have the same bytes for any threads and regions") {
  Scene scene = varied_scene();
  scene.settings.target_error = 0;
  scene.settings.supersampling = 2;
  scene.settings.indirect = 2;
  scene.lights.emplace_back(EnvironmentLight{.scale = 0.5});
  check_threads_and_regions(prepare(scene));
}
