// Lights of a tree are chosen with the probabilities that it tells of, and those that matter most
// often.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "core/shading/light_tree.hpp"

using namespace crt::core;
using crt::Vec3;

namespace {

PreparedLight prepared(const crt::Light& light) {
  return PreparedLight(light, crt::FalloffModel::light);
}

/// Makes lights of all kinds with an extent, of a wide range of sizes, colours and directions.
std::vector<PreparedLight> random_lights(std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<double> place(-5, 5);
  std::uniform_real_distribution<double> size(0.01, 1);
  std::vector<PreparedLight> lights;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 center(place(random), place(random), place(random));
    const Vec3 direction(place(random), place(random), place(random) + 0.01);
    const crt::Color color = crt::grey(size(random) * 10);
    if (i % 3 == 0) {
      lights.push_back(
          prepared(crt::SphereLight{.center = center, .radius = size(random), .color = color}));
    } else if (i % 3 == 1) {
      lights.push_back(prepared(crt::DiscLight{
          .center = center, .normal = direction, .radius = size(random), .color = color}));
    } else {
      lights.push_back(prepared(crt::RectangleLight{.corner = center,
                                                    .edge_a = size(random) * direction,
                                                    .edge_b = {size(random), 0, size(random)},
                                                    .color = color,
                                                    .two_sided = i % 2 == 0}));
    }
  }
  return lights;
}

}  // namespace

TEST_CASE("lights are chosen as often as their probabilities say, which add up to 1") {
  std::mt19937 random(1);
  for (const std::size_t count : {1, 2, 17, 100}) {
    const std::vector<PreparedLight> lights = random_lights(count, random);
    const LightTree tree(lights);
    std::uniform_real_distribution<double> place(-8, 8);
    for (int i = 0; i < 20; ++i) {
      const LitPoint point{{place(random), place(random), place(random)},
                           glm::normalize(Vec3(place(random), 8, place(random)))};
      double sum = 0;
      for (std::uint32_t light = 0; light < count; ++light) sum += tree.probability(point, light);
      // A subtree may turn out not to reach the point when its lights are looked at one by one.
      CHECK(sum <= doctest::Approx(1).epsilon(1e-12));
      constexpr int samples = 2000;
      std::vector<int> chosen(count, 0);
      int none = 0;
      for (int k = 0; k < samples; ++k) {
        const LightTree::Choice choice = tree.choose(point, (k + 0.5) / samples);
        if (choice.probability == 0) {
          ++none;
          continue;
        }
        ++chosen[choice.light];
        REQUIRE(choice.probability ==
                doctest::Approx(tree.probability(point, choice.light)).epsilon(1e-9));
      }
      CHECK(none == doctest::Approx(samples * (1 - sum)).epsilon(0.01).scale(200));
      for (std::uint32_t light = 0; light < count; ++light) {
        const double expected = samples * tree.probability(point, light);
        CHECK(std::abs(chosen[light] - expected) <= 2.0 * 64);
        if (expected > 64) CHECK(chosen[light] > 0);
      }
    }
  }
}

TEST_CASE("every light that lights a point can be chosen") {
  std::mt19937 random(2);
  const std::vector<PreparedLight> lights = random_lights(300, random);
  const LightTree tree(lights);
  std::uniform_real_distribution<double> place(-8, 8);
  for (int i = 0; i < 300; ++i) {
    const LitPoint point{{place(random), place(random), place(random)},
                         glm::normalize(Vec3(place(random), 1, place(random)))};
    for (std::uint32_t light = 0; light < lights.size(); ++light) {
      LightSamples samples;
      const LightNumbers numbers{.u = lanes_of(0.1, 0.9, 0.5, 0.3),
                                 .v = lanes_of(0.2, 0.7, 0.5, 0.9)};
      LaneMask lit = lights[light].sample(lanes_of(point.position), Lanes{}, numbers, samples);
      lit &= dot(samples.directions, lanes_of(point.normal)) > 0.0;
      lit &= samples.intensities > 0.0;
      if (any(lit)) REQUIRE(tree.probability(point, light) > 0);
    }
  }
}

TEST_CASE("a near light is chosen more often than far ones, and none behind the surface") {
  std::vector<PreparedLight> lights;
  for (int i = 0; i < 64; ++i)
    lights.push_back(prepared(crt::SphereLight{.center = {10.0 * i, 2, 0}, .radius = 0.1}));
  lights.push_back(prepared(crt::SphereLight{.center = {0, -3, 0}, .radius = 0.1}));
  const LightTree tree(lights);
  const LitPoint below_first{{0, 0, 0}, {0, 1, 0}};
  CHECK(tree.probability(below_first, 0) > 0.9);
  CHECK(tree.probability(below_first, 64) == 0);
  const LitPoint below_last{{630, 0, 0}, {0, 1, 0}};
  CHECK(tree.probability(below_last, 63) > 0.8);
}

TEST_CASE("lights without light are never chosen") {
  const std::vector<PreparedLight> black = {prepared(crt::SphereLight{.color = crt::grey(0)}),
                                            prepared(crt::DiscLight{.color = crt::grey(0)})};
  CHECK(LightTree(black).empty());
}
