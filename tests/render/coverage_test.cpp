// These tests check whether the half-width that is claimed for a pixel keeps its promise, in each
// class of pixels by itself, where the renderer stopped, against references with many more samples.
// They also check what cutting off paths takes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "binomial.hpp"
#include "core/render/rendering.hpp"
#include "pictures.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr int side = 16;

struct PixelClass {
  std::string name;
  Scene scene;
  /// Only pixels count whose true value is neither black nor white.
  bool mixed_only = true;
};

Scene white_on_black() {
  Scene scene = dark_scene();
  scene.settings.width = scene.settings.height = side;
  // Pixels have size 1.
  scene.camera = {.position = {0, 0, -40},
                  .fov = 2 * std::atan(side / 2.0),
                  .projection = Projection::orthographic,
                  .focal_distance = 1};
  scene.lights = {glow(1)};
  return scene;
}

PixelClass flat_pixels() {
  Scene scene;
  scene.settings.width = scene.settings.height = side;
  scene.lights = {PointLight{.origin = {1, 1, -1}, .falloff = 2}};
  scene.camera = {.position = {0, 0, -2}, .pointing = {0.2, 0, 0}};
  scene.entities = {Plane{.normal = {0.1, 0.3, -1}}};
  return {"flat", scene, false};
}

PixelClass edge_pixels() {
  Scene scene = white_on_black();
  scene.entities = {
      Sphere{.center = {-4, 3, 0}, .radius = 3.3, .material = inert()},
      Sphere{.center = {3, -4, 0}, .radius = 2.4, .material = inert()},
      Entity(Box{.corner_a = {-1.2, -1.2, -1}, .corner_b = {4.1, 2.3, 1}, .material = inert()})
          .transformed(rotate_degrees({0, 0, 17}))};
  return {"edge", scene};
}

PixelClass thin_pixels() {
  Scene scene = white_on_black();
  double width = 0.06;
  for (int i = 0; i < 7; ++i, width *= 1.4) {
    const Box wire{.corner_a = {-20, -width / 2 - 6.6 + 2.2 * i, -1},
                   .corner_b = {20, width / 2 - 6.6 + 2.2 * i, 1},
                   .material = inert()};
    scene.entities.push_back(Entity(wire).transformed(rotate_degrees({0, 0, 3.0 * i})));
  }
  return {"sub-pixel", scene};
}

PixelClass defocused_pixels() {
  Scene scene = white_on_black();
  scene.settings.dof_samples = 2;
  scene.camera.aperture = 1500;  // blurs what is 1 behind the focus over 1.5 pixels on either side
  scene.camera.focal_distance = 1;
  scene.camera.position = {0, 0, -4};
  scene.entities = {Sphere{.center = {-4, 3, 0.5}, .radius = 2.5, .material = inert()},
                    Sphere{.center = {4, -3, -1.5}, .radius = 2, .material = inert()},
                    Box{.corner_a = {2, 2, -2}, .corner_b = {2.4, 8, -1.9}, .material = inert()}};
  return {"defocused", scene};
}

PixelClass refractive_pixels() {
  Scene scene;
  scene.settings.width = scene.settings.height = side;
  scene.camera = {.position = {0, 1, -3}, .pointing = {0, 0.9, 0}, .fov = 0.5};
  scene.lights = {glow(1)};
  Material tiles = inert();
  tiles.color = Pattern(Checker{.scale = 0.7});
  scene.entities = {Plane{.normal = {0, 1, 0}, .material = tiles},
                    Sphere{.center = {0, 1, 0}, .radius = 1, .material = glass(1.5)}};
  return {"refractive", scene, false};
}

/// Makes a floor and a ball under a light, for light that is drawn.
Scene floor_and_ball(const Light& light, const SharedMaterial& of_ball) {
  Scene scene;
  scene.settings.width = scene.settings.height = side;
  scene.camera = {.position = {0.4, 2.5, -4}, .pointing = {0.3, 0.2, 0}, .fov = 0.7};
  scene.background = GradientBackground{.horizon = {0.3, 0.3, 0.3}, .sky = {0.6, 0.7, 0.9}};
  scene.lights = {light};
  const Material white{.color = grey(0.7)};
  scene.entities = {Plane{.normal = {0, 1, 0}, .material = white},
                    Sphere{.center = {0, 0.7, 0.3}, .radius = 0.7, .material = of_ball}};
  return scene;
}

PixelClass penumbra_pixels() {
  const SphereLight light{.center = {1.5, 3, -0.5}, .radius = 0.7, .color = {4, 4, 4}};
  return {"penumbra", floor_and_ball(light, Material{.color = grey(0.6)}), false};
}

PixelClass glossy_pixels() {
  const RectangleLight light{.corner = {-2, 2.5, -1},
                             .edge_a = {1, 0, 0},
                             .edge_b = {0, -0.5, 1},
                             .color = {5, 5, 5},
                             .two_sided = true};
  const PrincipledMaterial metal{.color = Color{0.9, 0.7, 0.4}, .metallic = 1.0, .roughness = 0.3};
  return {"glossy", floor_and_ball(light, metal), false};
}

PixelClass indirect_pixels() {
  Scene scene = floor_and_ball(ParallelLight{.from = {1, 2, -1}, .color = {0.8, 0.8, 0.8}},
                               Material{.color = Color{0.8, 0.3, 0.2}});
  scene.settings.indirect = 2;
  return {"indirect", scene, false};
}

PixelClass sky_pixels() {
  return {"sky", floor_and_ball(EnvironmentLight{}, Material{.color = grey(0.6)}), false};
}

PixelClass many_lights_pixels() {
  Scene scene = floor_and_ball(EnvironmentLight{.scale = 0.1}, Material{.color = grey(0.6)});
  for (int i = 0; i < 40; ++i) {
    const double angle = 2.4 * i;
    scene.lights.emplace_back(
        SphereLight{.center = {2 * std::cos(angle), 0.4 + 0.05 * i, 1.5 * std::sin(angle) + 0.3},
                    .radius = 0.1,
                    .color = grey(2 + i % 5),
                    .visible = i % 2 == 0});
  }
  return {"many lights", scene, false};
}

/// Light of a small bright ball comes through glass, where rays find it by chance alone.
PixelClass caustic_pixels() {
  const SphereLight light{.center = {1, 2.5, 1}, .radius = 0.1, .color = grey(100)};
  PixelClass pixels{"caustic", floor_and_ball(light, glass(1.5)), false};
  pixels.scene.settings.indirect = 1;
  return pixels;
}

PixelClass daylight_pixels() {
  Scene scene = floor_and_ball({}, Material{.color = grey(0.6)});
  scene.lights.clear();
  scene.background = SkyBackground{.sun = {1, 0.7, -1}};
  return {"daylight", scene, false};
}

Image reference_of(Scene scene, int samples) {
  scene.settings.seed = 1000;
  scene.settings.target_error = 1;
  scene.settings.min_samples = scene.settings.max_samples = samples;
  return render(prepare(scene));
}

}  // namespace

TEST_CASE("the bound of Clopper and Pearson is as in tables") {
  CHECK(clopper_pearson_low(10, 10) == doctest::Approx(0.6915).epsilon(1e-3));
  CHECK(clopper_pearson_low(95, 100) == doctest::Approx(0.8872).epsilon(1e-3));
}

TEST_CASE("in every class of pixels 95 of 100 are as near the truth as they say") {
  // This covers the reference's own error, and rounding.
  constexpr double tolerance = 0.1 / 255;
  std::vector<PixelClass> classes{flat_pixels(),        edge_pixels(),       thin_pixels(),
                                  defocused_pixels(),   refractive_pixels(), penumbra_pixels(),
                                  glossy_pixels(),      indirect_pixels(),   sky_pixels(),
                                  many_lights_pixels(), caustic_pixels(),    daylight_pixels()};
  // What counts is how far off a pixel looks, as it is exposed.
  for (PixelClass pixels : {edge_pixels(), defocused_pixels()}) {
    for (const auto& [exposure, map] : {std::pair{2.0, ToneMap::none}, {-1.0, ToneMap::filmic}}) {
      pixels.scene.settings.exposure = exposure;
      pixels.scene.settings.tone_map = map;
      classes.push_back(pixels);
    }
  }
  for (PixelClass& pixels : classes) {
    const bool is_noisy = pixels.scene.settings.dof_samples > 1 || pixels.name == "caustic";
    const Image truth = reference_of(pixels.scene, is_noisy ? 16384 : 4096);
    for (const double target : {8.0 / 255, 4.0 / 255}) {
      pixels.scene.settings.target_error = target;
      const PreparedScene scene = prepare(pixels.scene);
      int count = 0;
      int within = 0;
      for (std::uint64_t seed = 0; seed < 5; ++seed) {
        core::Rendering rendering(scene.data(), {.seed = seed});
        rendering.run();
        const Image image = rendering.take();
        for (int i = 0; i < side * side; ++i) {
          const Color a = image.at(i % side, i / side);
          const Color b = truth.at(i % side, i / side);
          if (pixels.mixed_only && (b.r == 0 || b.r == 1)) continue;
          const auto shown = [&](double x) { return displayed(x, pixels.scene.settings); };
          const double error =
              std::max({std::abs(shown(a.r) - shown(b.r)), std::abs(shown(a.g) - shown(b.g)),
                        std::abs(shown(a.b) - shown(b.b))});
          const double half_width =
              double{rendering.measures().half_widths[static_cast<std::size_t>(i)]};
          ++count;
          if (error <= half_width + tolerance) ++within;
        }
      }
      CAPTURE(pixels.name);
      CAPTURE(pixels.scene.settings.exposure);
      CAPTURE(target);
      CAPTURE(count);
      CAPTURE(within);
      CHECK(clopper_pearson_low(within, count) >= 0.95);
    }
  }
}

TEST_CASE("pixels that get some light by chance stay unresolved rather than claim too much") {
  Scene scene = caustic_pixels().scene;
  scene.settings.target_error = 2.0 / 255;
  scene.settings.max_samples = 256;
  CHECK(render(prepare(scene)).stats().pixels_unresolved > side);
}

TEST_CASE("what cutting off paths took from a picture is within what it says") {
  Scene scene;
  scene.settings = {.width = 24, .height = 24, .supersampling = 2, .min_weight = 0};
  scene.background = SolidBackground{{0.9, 1, 0.8}};
  scene.camera = {.position = {0, 0.5, -4}, .pointing = {0, 0.3, 0}};
  const Material mirror = inert(0.7);
  scene.entities = {Sphere{.center = {-0.8, 0.5, 0}, .radius = 0.6, .material = mirror},
                    Sphere{.center = {0.8, 0.5, 0}, .radius = 0.6, .material = glass(1.5)},
                    Plane{.normal = {0, 1, 0}, .material = inert(0.4)}};
  scene.settings.recursion_depth = 60;
  const Image deep = render(prepare(scene));
  double last = 1;
  for (const int depth : {0, 1, 2, 3, 5, 8}) {
    scene.settings.recursion_depth = depth;
    scene.settings.cutoff = Cutoff::background;
    const Image with_background = render(prepare(scene));
    for (int i = 0; i < 24 * 24; ++i) {
      CHECK(std::abs(with_background.at(i % 24, i / 24).b - deep.at(i % 24, i / 24).b) <=
            with_background.stats().cutoff_max + 1e-6);
    }
    scene.settings.cutoff = Cutoff::black;
    const Image image = render(prepare(scene));
    double most = 0;
    double sum = 0;
    for (int i = 0; i < 24 * 24; ++i) {
      const Color a = image.at(i % 24, i / 24);
      const Color b = deep.at(i % 24, i / 24);
      const double lost = std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
      most = std::max(most, lost);
      sum += lost / (24 * 24);
    }
    CAPTURE(depth);
    constexpr double rounding = 1e-6;
    CHECK(most <= image.stats().cutoff_max + rounding);
    CHECK(sum <= image.stats().cutoff_mean + rounding);
    CHECK(image.stats().cutoff_mean <= 4 * sum);  // and it says not much more
    CHECK(image.stats().cutoff_mean < last);
    last = image.stats().cutoff_mean;
  }
  scene.settings.recursion_depth = 60;
  for (const double weight : {0.5, 0.1, 0.01}) {
    scene.settings.min_weight = weight;
    const Image image = render(prepare(scene));
    CHECK(image.stats().cutoff_max > 0);
    for (int i = 0; i < 24 * 24; ++i)
      CHECK(std::abs(image.at(i % 24, i / 24).g - deep.at(i % 24, i / 24).g) <=
            image.stats().cutoff_max + 1e-6);
  }
}
