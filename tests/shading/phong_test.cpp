#include "core/shading/phong.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace crt::core;
using crt::Vec3;

namespace {

const Vec3 up(0, 1, 0);

struct PhongSurface {
  Rgb color{1, 1, 1};
  double diffuse = 1;
  double specular = 0;
  double shininess = 3;
  Vec3 normal{0, 1, 0};
  Vec3 view{0, -1, 0};
};

struct LightSample {
  Vec3 direction{0, 1, 0};
  double distance = 0;
  double intensity = 1;
};

/// Returns what one surface sends back that has a mirror in the shade beside it.
Rgb direct_light(const PhongSurface& surface, const LightSample& light, const Rgb& light_color) {
  PhongSurfaces surfaces;
  surfaces.specular = lanes_of(1);
  surfaces.shininess = lanes_of(5);
  surfaces.normal = lanes_of(up);
  surfaces.view = lanes_of(-up);
  LightSamples samples;
  samples.directions = lanes_of(-up);
  samples.intensities = lanes_of(1);
  constexpr int lane = 1;
  surfaces.color.set(lane, surface.color);
  surfaces.diffuse[lane] = surface.diffuse;
  surfaces.specular[lane] = surface.specular;
  surfaces.shininess[lane] = surface.shininess;
  surfaces.normal.set(lane, surface.normal);
  surfaces.view.set(lane, surface.view);
  samples.directions.set(lane, light.direction);
  samples.distances[lane] = light.distance;
  samples.intensities[lane] = light.intensity;
  samples.colors = lanes_of(light_color);
  VectorLanes seen;
  direct_light(surfaces, samples, samples.intensities > 0.0, seen);
  return seen.lane(lane);
}

}  // namespace

TEST_CASE("diffuse light is the cosine times the light, the material and their strengths") {
  const PhongSurface surface{.color = {1, 0.5, 0.25}, .diffuse = 0.8, .normal = up, .view = -up};
  const LightSample light{.direction = {0.8, 0.6, 0}, .distance = 1, .intensity = 0.5};
  const Rgb result = direct_light(surface, light, {1, 1, 2});
  CHECK(result.x == doctest::Approx(0.6 * 0.5 * 0.8));
  CHECK(result.y == doctest::Approx(0.6 * 0.5 * 0.8 * 0.5));
  CHECK(result.z == doctest::Approx(0.6 * 0.5 * 0.8 * 0.25 * 2));
}

TEST_CASE("the highlight is a power of the cosine between the mirrored light and the viewer") {
  const double angle = 0.3;
  const LightSample light{
      .direction = {std::sin(0.5), std::cos(0.5), 0}, .distance = 1, .intensity = 0.5};
  // The viewer stands an angle away from where a mirror would show the light.
  const Vec3 view(std::sin(0.5 + angle), -std::cos(0.5 + angle), 0);
  const PhongSurface surface{.color = {1, 0.5, 0},
                             .diffuse = 0,
                             .specular = 0.7,
                             .shininess = 20,
                             .normal = up,
                             .view = view};
  const Rgb result = direct_light(surface, light, {2, 2, 2});
  const double expected = std::pow(std::cos(angle), 20) * 0.7 * 0.5 * 2;
  CHECK(result.x == doctest::Approx(expected).epsilon(1e-13));
  CHECK(result.y == doctest::Approx(expected / 2).epsilon(1e-13));
  CHECK(result.z == 0);
}

TEST_CASE("a viewer on the other side of the mirrored light sees no highlight") {
  const PhongSurface surface{.diffuse = 0, .specular = 1, .normal = up, .view = {-0.8, -0.6, 0}};
  const LightSample light{.direction = {-0.8, 0.6, 0}, .distance = 1};
  // The light is mirrored to (0.8, 0.6), and the viewer looks from (0.8, 0.6): full strength.
  CHECK(direct_light(surface, light, Rgb(1)).x == doctest::Approx(1));
  PhongSurface opposite = surface;
  opposite.view = {0.8, -0.6, 0};
  // cos = -0.8 * 0.8 + 0.6 * 0.6 < 0
  CHECK(direct_light(opposite, light, Rgb(1)) == Rgb(0));
}

TEST_CASE("light from behind gives nothing") {
  const PhongSurface surface{
      .diffuse = 1, .specular = 1, .shininess = 0, .normal = up, .view = -up};
  CHECK(direct_light(surface, {.direction = {0.8, -0.6, 0}, .distance = 1}, Rgb(1)) == Rgb(0));
  CHECK(direct_light(surface, {.direction = {1, 0, 0}, .distance = 1}, Rgb(1)) == Rgb(0));
}

TEST_CASE("ambient light is what a surface does not mirror") {
  using enum crt::AmbientModel;
  const Rgb red{1, 0, 0};
  CHECK(ambient_light({1, 0.5, 0}, light, red, 0.25, 0.5) == Rgb(0.75, 0.375, 0));
  CHECK(ambient_light({1, 1, 1}, light, red, 0.0, 1.0) == Rgb(1));
}

TEST_CASE("by the surface's model ambient light takes its colour, and what is clear has none") {
  using enum crt::AmbientModel;
  const Rgb red{1, 0.5, 0};
  CHECK(ambient_light({1, 0.5, 1}, surface, red, 0.25, 0.25) == Rgb(0.5, 0.125, 0));
  CHECK(ambient_light({1, 1, 1}, surface, Rgb(0), 0.0, 0.0) == Rgb(0));
  CHECK(ambient_light({1, 1, 1}, surface, red, 0.75, 0.5) == Rgb(0));
}
