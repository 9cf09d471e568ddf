// These tests show scenes in the light of modes, and ask what must not matter then.
#include "studio/view_mode.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <crt/prepared_scene.hpp>
#include <crt/render.hpp>
#include <vector>

#include "studio/draft.hpp"
#include "studio/view_options.hpp"

using namespace crt;
using namespace crt::studio;

namespace {

constexpr std::array<ViewMode, 2> modes = {ViewMode::material, ViewMode::clay};

Image shown(const Scene& scene, ViewMode mode) {
  PrepareOptions options;
  options.material = materials_of(mode);
  return render(prepare(scene_in_mode(scene, mode, scene.camera), options));
}

bool same_pixels(const Image& a, const Image& b) {
  return std::ranges::equal(a.pixels(), b.pixels());
}

/// Makes two balls beside each other before a camera.
Scene two_balls(const SharedMaterial& left, const SharedMaterial& right) {
  Scene scene;
  scene.settings.width = 48;
  scene.settings.height = 24;
  scene.camera = {.position = {0, 0, -6}, .pointing = {0, 0, 0}, .fov = 0.6};
  scene.entities = {Sphere{.center = {-1.2, 0, 0}, .material = left},
                    Sphere{.center = {1.2, 0, 0}, .material = right}};
  return scene;
}

const SharedMaterial red(Material{.color = Color{0.8, 0.05, 0.05}});
const SharedMaterial green(Material{.color = Color{0.05, 0.8, 0.05}});
const SharedMaterial silver(PrincipledMaterial{.metallic = 1, .roughness = 0.1});

}  // namespace

TEST_CASE("what a mode shows does not depend on the scene's lights, sky and exposure") {
  const Scene scene = two_balls(red, silver);
  Scene other = scene;
  other.lights = {SphereLight{.color = {100, 100, 100}}, EnvironmentLight{}};
  other.background = SolidBackground{{0, 0, 9}};
  other.settings.exposure = -6;
  other.settings.tone_map = ToneMap::filmic;
  other.settings.indirect = 8;
  other.settings.light_samples = 64;
  for (const ViewMode mode : modes) {
    const Image image = shown(scene, mode);
    CHECK(same_pixels(image, shown(other, mode)));
    CHECK(image.stats().half_width_95 <= 4.0 / 255);
  }
  CHECK(same_pixels(shown(scene, ViewMode::rendered), render(prepare(scene))));
}

TEST_CASE("clay is grey whatever things are made of, and not black where no sky is seen") {
  const Image image = shown(two_balls(red, silver), ViewMode::clay);
  CHECK(same_pixels(image, shown(two_balls(silver, green), ViewMode::clay)));
  for (const int x : {10, 37}) {
    const Color ball = image.at(x, 12);
    CHECK(ball.r == ball.g);
    CHECK(ball.r == ball.b);
    CHECK(ball.r > 0.3);
    CHECK(ball.r < 0.9);
  }
  Scene room = two_balls(red, green);
  room.entities.push_back(Box{.corner_a = {-20, -20, -20}, .corner_b = {20, 20, 20}});
  const Image inside = shown(room, ViewMode::clay);
  CHECK(inside.at(10, 12).r > 0.1);
}

TEST_CASE("materials keep their colours, also in a room without a window") {
  Scene scene = two_balls(red, green);
  for (const bool is_room : {false, true}) {
    if (is_room)
      scene.entities.push_back(Box{.corner_a = {-20, -20, -20}, .corner_b = {20, 20, 20}});
    const Image image = shown(scene, ViewMode::material);
    const Color left = image.at(10, 12);
    const Color right = image.at(37, 12);
    CHECK(left.r > 0.3);
    CHECK(left.r > 8 * left.g);
    CHECK(right.g > 0.3);
    CHECK(right.g > 8 * right.r);
  }
}

TEST_CASE("what gives off light is seen, and lights materials no more if it is strong") {
  const auto beside = [](const SharedMaterial& material) {
    Scene scene = two_balls(red, material);
    scene.entities.push_back(Box{.corner_a = {-3, -3, 1.5}, .corner_b = {3, 3, 2}});
    return shown(scene, ViewMode::material);
  };
  const Color weak = {2, 1, 0};
  const Color strong = {128, 64, 0};
  const Image image = beside(Material{.color = grey(0), .emission = weak});
  CHECK(image.at(37, 12).r == doctest::Approx(1));
  CHECK(image.at(37, 12).g == doctest::Approx(0.5));
  CHECK(same_pixels(image, beside(Material{.color = grey(0), .emission = strong})));
  CHECK(same_pixels(beside(PrincipledMaterial{.emission = weak}),
                    beside(PrincipledMaterial{.emission = strong})));
  // The wall beside it is not far from what it is without.
  const Image without = beside(Material{.color = grey(0)});
  CHECK(image.at(47, 12).r < without.at(47, 12).r + 0.3);
}

TEST_CASE("a metal mirrors the studio's lights, brighter than white and not all the same") {
  const Image image = shown(two_balls(silver, silver), ViewMode::material);
  double darkest = 1e9;
  double brightest = 0;
  for (int y = 4; y < 20; ++y) {
    for (int x = 6; x < 15; ++x) {
      darkest = std::min(darkest, image.at(x, y).g);
      brightest = std::max(brightest, image.at(x, y).g);
    }
  }
  CHECK(darkest < 0.3);
  CHECK(brightest > 1);
}

TEST_CASE("cuts by a section stay orange in clay") {
  Scene scene = two_balls(red, red);
  scene.entities.pop_back();
  ViewOptions options;
  options.section = SectionPlane{.axis = 2, .offset = 0, .is_flipped = true};
  const std::vector<BoundingBox> boxes = boxes_of(scene);
  scene =
      visible_scene(scene, {}, options, [&]() -> const std::vector<BoundingBox>& { return boxes; });
  const Color cut = shown(scene, ViewMode::clay).at(10, 12);
  CHECK(cut.r > 2 * cut.b);
}

TEST_CASE("the light of modes faces what the scene's camera looks at") {
  Scene scene = two_balls(red, silver);
  Scene turned = scene;  // by a quarter about y
  turned.camera.position = {-6, 0, 0};
  turned.entities = {Sphere{.center = {0, 0, 1.2}, .material = red},
                     Sphere{.center = {0, 0, -1.2}, .material = silver}};
  for (const int compat : {0, compat_2015}) {
    scene.settings.compat = turned.settings.compat = compat;
    for (const ViewMode mode : modes) {
      const Image image = shown(scene, mode);
      const Image other = shown(turned, mode);
      for (int x = 0; x < image.width(); ++x)
        CHECK(std::abs(image.at(x, 12).g - other.at(x, 12).g) < 0.1);
    }
  }
}

TEST_CASE("finer drafts take four times as many samples each, and a third in all at most") {
  Scene scene = two_balls(red, red);
  const auto samples_of = [](const Scene& of) {
    const bool draws_lens = has_lens(of.camera) && of.settings.dof_samples > 1;
    return of.settings.supersampling * of.settings.supersampling *
           (draws_lens ? of.settings.dof_samples : 1);
  };
  for (const double lens_radius : {0.0, 0.1}) {
    scene.camera.lens_radius = lens_radius;
    for (const int supersampling : {1, 2, 3, 6, 8}) {
      for (const int dof_samples : {1, 2, 16, 60}) {
        scene.settings.supersampling = supersampling;
        scene.settings.dof_samples = dof_samples;
        int expected = 4;
        int sum = 0;
        for (const Scene& draft : finer_drafts(scene)) {
          CHECK(samples_of(draft) == expected);
          sum += expected;
          expected *= 4;
        }
        CHECK(3 * sum <= samples_of(scene));
        CHECK(4 * expected > samples_of(scene));
      }
    }
  }
  scene.settings.target_error = 0.01;
  CHECK(finer_drafts(scene).empty());
}
