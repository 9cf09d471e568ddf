// Pictures under lights with a size: their shadows, the lights themselves, and equal bytes.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "pictures.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Makes a picture of a white floor from above, a row of pixels along x from -2 to 2, without what
/// else is there being seen.
Scene floor_scene() {
  Scene scene;
  scene.settings.width = 16;
  scene.settings.height = 1;
  scene.settings.recursion_depth = 0;
  scene.camera = {.position = {0, 0.001, 0},
                  .pointing = {0, 0, 0},
                  .fov = 0.01,
                  .projection = Projection::orthographic};
  scene.background = SolidBackground{.color = {0, 0, 0}};
  const Material white{.color = Color{1, 1, 1}};
  scene.entities = {Plane{.normal = {0, 1, 0}, .position = {0, 0, 0}, .material = white}};
  return scene;
}

/// Renders a pixel whose middle is at a place of the floor.
double brightness_at(Scene scene, const Vec3& place, int samples) {
  scene.settings.width = 1;
  scene.settings.height = 1;
  scene.settings.min_samples = samples;
  scene.settings.max_samples = samples;
  scene.settings.target_error = 1e-9;
  scene.camera.position = place + Vec3(0, 1e-3, 0);
  scene.camera.pointing = place;
  scene.camera.fov = 1e-6;
  return render(prepare(scene)).at(0, 0).r;
}

/// Returns how bright a disc of radiance 1 makes a white floor, where a half-plane at half height
/// covers x < 0: by the midpoints of a fine grid on the disc.
double bright_behind_edge(double x, double height, double radius) {
  constexpr int steps = 1000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const Vec3 on_disc(radius * (2 * (i + 0.5) / steps - 1), height,
                         radius * (2 * (j + 0.5) / steps - 1));
      if (on_disc.x * on_disc.x + on_disc.z * on_disc.z > radius * radius) continue;
      const Vec3 to_light = on_disc - Vec3(x, 0, 0);
      if (x + 0.5 * to_light.x < 0) continue;  // blocked at half height
      const double squared = glm::dot(to_light, to_light);
      sum += height * height / (squared * squared);
    }
  }
  const double cell = 4 * radius * radius / (double{steps} * steps);
  return sum * cell / std::numbers::pi;
}

}  // namespace

TEST_CASE("the penumbra of a disc light is what a fine grid on the disc says") {
  constexpr double height = 4;
  constexpr double radius = 0.8;
  Scene scene = floor_scene();
  scene.lights = {DiscLight{
      .center = {0, height, 0}, .normal = {0, -1, 0}, .radius = radius, .color = {1, 1, 1}}};
  scene.entities.push_back(
      HalfPlane{.normal = {0, 1, 0}, .position = {0, height / 2, 0}, .direction = {-1, 0, 0}});
  for (const double x : {-1.2, -0.5, -0.2, 0.0, 0.3, 0.7, 1.2}) {
    CAPTURE(x);
    const double exact = bright_behind_edge(x, height, radius);
    CHECK(brightness_at(scene, {x, 0, 0}, 16384) ==
          doctest::Approx(exact).epsilon(1e-3).scale(0.04));
  }
}

TEST_CASE("all of a ball's shadow is black where it hides the light, and softens around that") {
  Scene scene = floor_scene();
  scene.lights = {PointLight{.origin = {0, 4, 0}, .radius = 0.5}};
  scene.entities.push_back(Sphere{.center = {0, 1, 0}, .radius = 0.9});
  CHECK(brightness_at(scene, {0.1, 0, 0}, 64) == 0);
  const double far = brightness_at(scene, {3, 0, 0}, 4096);
  CHECK(far == doctest::Approx(4 / std::hypot(3.0, 4.0)).epsilon(1e-3));
  double before = 0;
  for (const double x : {1.1, 1.2, 1.3, 1.4, 1.6}) {
    const double now = brightness_at(scene, {x, 0, 0}, 1024);
    CHECK(now > before);
    before = now;
  }
}

TEST_CASE("a light is seen as what it is, in mirrors too, unless it is not visible") {
  Scene scene;
  scene.settings.width = 3;
  scene.settings.height = 1;
  scene.settings.supersampling = 2;
  scene.background = SolidBackground{.color = {0.25, 0.25, 0.25}};
  scene.camera = {.position = {0, 0, -5}, .pointing = {0, 0, 0}, .fov = 0.01};
  SphereLight light{.center = {0, 0, 0}, .color = {3, 2, 1}};
  const auto middle = [&](const Scene& shown) { return render(prepare(shown)).at(1, 0); };
  scene.lights = {light};
  CHECK(middle(scene) == Color{3, 2, 1});
  light.visible = false;
  scene.lights = {light};
  CHECK(middle(scene) == Color{0.25, 0.25, 0.25});
  light.visible = true;

  // What is before it hides it, and what is behind it does not.
  scene.lights = {light};
  const Material black{.color = Color{0, 0, 0}, .diffuse = 0};
  scene.entities = {Sphere{.center = {0, 0, -3}, .radius = 0.5, .material = black}};
  CHECK(middle(scene) == Color{0, 0, 0});
  scene.entities = {Sphere{.center = {0, 0, 3}, .radius = 0.5, .material = black}};
  CHECK(middle(scene) == Color{3, 2, 1});

  // A mirror behind the camera's back shows it, with the mirror's share.
  const Material mirror{.color = Color{0, 0, 0}, .reflectivity = 0.5, .diffuse = 0};
  scene.entities = {Plane{.normal = {0, 0, -1}, .position = {0, 0, 0}, .material = mirror}};
  light.center = {0, 0, -10};
  scene.lights = {light};
  CHECK(middle(scene) == Color{1.5, 1, 0.5});
}

TEST_CASE("a light is in nobody's way, whether rays find it or not") {
  // A panel is close to a ceiling, before another light. Surfaces get light from both, and what
  // bounces off the ceiling, as if no ray met the panel.
  Scene scene = floor_scene();
  scene.settings.indirect = 2;
  scene.background = SolidBackground{.color = {0.25, 0.25, 0.25}};
  scene.entities.push_back(Box{.corner_a = {-2, 1.5, -2},
                               .corner_b = {2, 1.7, 2},
                               .material = Material{.color = Color{0.8, 0.8, 0.8}}});
  const auto brightness = [&](bool visible) {
    scene.lights = {
        RectangleLight{.corner = {-0.8, 1.2, -0.8},
                       .edge_a = {1.6, 0, 0},
                       .edge_b = {0, 0, 1.6},
                       .color = {2, 2, 2},
                       .visible = visible,
                       .two_sided = true},
        SphereLight{
            .center = {0, 1.35, 0}, .radius = 0.1, .color = {40, 40, 40}, .visible = visible},
        EnvironmentLight{}};
    return brightness_at(scene, {0.3, 0, 0.2}, 1 << 16);
  };
  SUBCASE("matt") {}
  SUBCASE("a rough metal") {
    scene.entities.front() = Plane{
        .normal = {0, 1, 0},
        .position = {0, 0, 0},
        .material = PrincipledMaterial{.color = Color{1, 1, 1}, .metallic = 1, .roughness = 0.4}};
  }
  CHECK(brightness(true) == doctest::Approx(brightness(false)).epsilon(4e-3));
}

TEST_CASE("soft pictures have the same bytes for any threads and any regions") {
  Scene scene = floor_scene();
  scene.settings.width = 37;
  scene.settings.height = 23;
  scene.settings.supersampling = 2;
  scene.settings.recursion_depth = 3;
  scene.camera = {.position = {0, 3, -6}, .pointing = {0, 0.5, 0}};
  scene.lights = {SphereLight{.center = {2, 3, -1}, .radius = 0.5, .color = {9, 9, 9}},
                  RectangleLight{.corner = {-3, 3, 0}, .color = {4, 4, 4}, .two_sided = true},
                  ParallelLight{.from = {0, 1, -1}, .angle = 0.2},
                  PointLight{.origin = {0, 5, -5}, .falloff = 9, .radius = 0.3},
                  DiscLight{.center = {0, 4, 0}, .normal = {0.2, -1, 0}}};
  scene.entities.push_back(Sphere{.center = {0, 1, 0}, .radius = 1, .material = glass(1.5)});
  scene.entities.push_back(Box{.corner_a = {1, 0, 1}, .corner_b = {2, 1, 2}});
  for (const double target_error : {0.0, 0.05}) {
    scene.settings.target_error = target_error;
    check_threads_and_regions(prepare(scene));
  }
}

TEST_CASE("another seed gives other noise, and no light of size 0 draws numbers") {
  Scene scene = floor_scene();
  scene.settings.width = 9;
  scene.settings.height = 9;
  scene.camera = {.position = {0, 3, -6}, .pointing = {0, 0.5, 0}};
  scene.entities.push_back(Sphere{.center = {0, 1, 0}, .radius = 1});
  const auto differ = [&](const Light& light) {
    scene.lights = {light};
    scene.settings.seed = 0;
    const Image zero = render(prepare(scene));
    scene.settings.seed = 1;
    return !same_pixels(render(prepare(scene)), zero);
  };
  CHECK(differ(PointLight{.origin = {3, 4, -2}, .radius = 1}));
  CHECK(!differ(PointLight{.origin = {3, 4, -2}}));
  CHECK(!differ(ParallelLight{.from = {1, 3, -1}}));
}

TEST_CASE("more samples of lights give less noise around the same light") {
  Scene scene = floor_scene();
  scene.settings.width = 64;
  scene.settings.height = 64;
  scene.camera = {.position = {0, 3, 0}, .pointing = {0, 0, 0.001}, .fov = 0.2};
  scene.lights = {
      SphereLight{.center = {0, 2, 0}, .radius = 1, .color = {1, 1, 1}, .visible = false}};
  scene.entities.push_back(
      HalfPlane{.normal = {0, 1, 0}, .position = {0.3, 0.5, 0}, .direction = {-1, 0, 0}});
  const auto mean_and_spread = [&](int samples) {
    scene.settings.light_samples = samples;
    const Image image = render(prepare(scene));
    double sum = 0;
    double squares = 0;
    for (int i = 0; i < 64 * 64; ++i) {
      const double value = image.at(i % 64, i / 64).r;
      sum += value / (64 * 64);
      squares += value * value / (64 * 64);
    }
    return std::pair(sum, std::sqrt(squares - sum * sum));
  };
  const auto [one, noise_of_one] = mean_and_spread(1);
  const auto [many, noise_of_many] = mean_and_spread(16);
  CHECK(one > 0.01);
  CHECK(many == doctest::Approx(one).epsilon(0.05));
  CHECK(noise_of_many < 0.5 * noise_of_one);
}
