#include "core/shading/prepared_light.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

using namespace crt::core;
using crt::FalloffModel;
using crt::Vec3;

namespace {

struct LightSample {
  Vec3 direction;
  double distance = 0;
  double intensity = 0;
};

/// Returns what a point gets that has others beside it, or nothing if it is in the dark.
std::optional<LightSample> sample_of(const crt::Light& light, const Vec3& point,
                                     double path_length = 0,
                                     FalloffModel model = FalloffModel::light) {
  VectorLanes points;
  Lanes path_lengths;
  const std::array<Vec3, lane_count> beside = {Vec3(0), 2.0 * point, point,
                                               -3.0 * point + Vec3(1e-3, 7, 1)};
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    points.set(lane, beside[lane]);
    path_lengths[lane] = lane == 2 ? path_length : 77;
  }
  LightSamples samples;
  const LaneMask lit = PreparedLight(light, model).sample(points, path_lengths, {}, samples);
  if ((mask_of(lit) >> 2 & 1u) == 0) return std::nullopt;
  return LightSample{samples.directions.lane(2), samples.distances[2], samples.intensities[2]};
}

LightSample sampled(const crt::Light& light, const Vec3& point, double path_length = 0,
                    FalloffModel model = FalloffModel::light) {
  const std::optional<LightSample> sample = sample_of(light, point, path_length, model);
  REQUIRE(sample);
  return *sample;
}

bool shines_on(const crt::Light& light, const Vec3& point) {
  const std::optional<LightSample> sample = sample_of(light, point);
  return sample && sample->intensity > 0;
}

constexpr double pi = std::numbers::pi;

}  // namespace

TEST_CASE("a falloff of 0 or less is none") {
  for (const double falloff : {0.0, -1.0, -1e200}) {
    CHECK(
        sampled(crt::PointLight{.origin = {0, 5, 0}, .falloff = falloff}, {0, -1e3, 0}).intensity ==
        1);
    CHECK(
        sampled(crt::SpotLight{.origin = {0, 5, 0}, .falloff = falloff}, {0, -1e3, 0}).intensity ==
        1);
    CHECK(sampled(crt::CylinderLight{.origin = {0, 5, 0}, .falloff = falloff}, {0, -1e3, 0})
              .intensity == 1);
  }
}

TEST_CASE(
    "a point light is seen in its direction, at its distance, at full strength without falloff") {
  const LightSample sample =
      sampled(crt::PointLight{.origin = {3, 4, 0}}, {0, 0, 0}, 100, FalloffModel::path);
  CHECK(sample.direction == Vec3(0.6, 0.8, 0));
  CHECK(sample.distance == 5);
  CHECK(sample.intensity == 1);
}

TEST_CASE("falloff divides by the square of the distance: to the light, or over the whole path") {
  const crt::PointLight light{.origin = {0, 5, 0}, .falloff = 50};
  CHECK(sampled(light, {0, 0, 0}, 15, FalloffModel::light).intensity == 2);
  CHECK(sampled(light, {0, 0, 0}, 15, FalloffModel::path).intensity == 0.125);
}

TEST_CASE("a point at the light itself gets none, and one next to it a finite amount") {
  const crt::PointLight light{.origin = {1, 1, 1}, .falloff = 1};
  CHECK_FALSE(shines_on(light, {1, 1, 1}));
  CHECK(std::isfinite(sampled(crt::PointLight{.falloff = 1}, {1e-200, 0, 0}).intensity));
}

TEST_CASE("a light may be as far as doubles reach") {
  const LightSample sample =
      sampled(crt::PointLight{.origin = {0, 1e100, 0}, .falloff = 1}, {0, -1e300, 0});
  CHECK(sample.direction == Vec3(0, 1, 0));
  CHECK(sample.distance == 1e300);
  CHECK(sample.intensity == 0);
}

TEST_CASE("a parallel light comes from the same direction everywhere, from infinitely far") {
  const crt::ParallelLight light{.from = {0, 2, 0}, .pointing = {0, -1, 0}};
  for (const Vec3& point : {Vec3(0), Vec3(100, -3, 7), Vec3(0, 50, 0)}) {
    const LightSample sample = sampled(light, point, 12, FalloffModel::path);
    CHECK(sample.direction == Vec3(0, 1, 0));
    CHECK(sample.distance == std::numeric_limits<double>::infinity());
    CHECK(sample.intensity == 1);
  }
}

TEST_CASE(
    "a spot light is full inside the inner cone, fades by smoothstep of the cosine, and ends at "
    "the rim") {
  const double half = pi / 6;
  const double penumbra = pi / 18;
  const crt::SpotLight light{
      .origin = {0, 0, 0}, .pointing = {0, -1, 0}, .angle = 2 * half, .penumbra = penumbra};
  for (int step = 0; step <= 900; ++step) {
    const double angle = step * pi / 900;
    const double share =
        (std::cos(angle) - std::cos(half)) / (std::cos(half - penumbra) - std::cos(half));
    const double x = std::min(1.0, std::max(0.0, share));
    const Vec3 point(std::sin(angle) * 3, -std::cos(angle) * 3, 0);
    CHECK(sampled(light, point).intensity == doctest::Approx(x * x * (3 - 2 * x)).epsilon(1e-9));
  }
}

TEST_CASE("a spot light without penumbra ends sharply, and one of a full turn shines everywhere") {
  const crt::SpotLight sharp{
      .origin = {0, 0, 0}, .pointing = {0, 0, 1}, .angle = pi / 2, .penumbra = 0};
  CHECK(sampled(sharp, {0.999, 0, 1}).intensity == 1);
  CHECK_FALSE(shines_on(sharp, {1.001, 0, 1}));
  const crt::SpotLight round{
      .origin = {0, 0, 0}, .pointing = {0, 0, 1}, .angle = 2 * pi, .penumbra = 0};
  CHECK(sampled(round, {0, 0, -1}).intensity == 1);
  CHECK(sampled(round, {1, 2, -7}).intensity == 1);
}

TEST_CASE("a cone as narrow as a laser's is still distinguished from its surroundings") {
  const crt::SpotLight laser{
      .origin = {0, 0, 0}, .pointing = {0, 0, 1}, .angle = 2e-9, .penumbra = 5e-10};
  CHECK(sampled(laser, {0, 0, 1}).intensity == 1);
  CHECK(sampled(laser, {0.4e-9, 0, 1}).intensity == 1);
  CHECK_FALSE(shines_on(laser, {1.1e-9, 0, 1}));
  // In the middle of the penumbra, cosines are parabolas: (1 - 0.75^2) / (1 - 0.5^2).
  const double x = (1 - 0.5625) / 0.75;
  CHECK(sampled(laser, {0.75e-9, 0, 1}).intensity ==
        doctest::Approx(x * x * (3 - 2 * x)).epsilon(1e-6));
}

TEST_CASE("a cylinder light shines along its axis, inside its radius, in front of its disc") {
  const crt::CylinderLight light{.origin = {0, 4, 0}, .pointing = {0, 3, 0}, .radius = 2};
  const LightSample sample = sampled(light, {1.5, 0, 0});
  CHECK(sample.direction == Vec3(0, 1, 0));
  CHECK(sample.distance == 4);
  CHECK(sample.intensity == 1);
  CHECK(shines_on(light, {2, 1, 0}));
  CHECK_FALSE(shines_on(light, {2.0001, 1, 0}));
  CHECK_FALSE(shines_on(light, {0, 4, 0}));
  CHECK_FALSE(shines_on(light, {0, 5, 0}));
}

TEST_CASE("a cylinder light's falloff counts along the axis") {
  const crt::CylinderLight light{
      .origin = {0, 4, 0}, .pointing = {0, 3, 0}, .radius = 2, .falloff = 8};
  CHECK(sampled(light, {1.5, 0, 0}, 12, FalloffModel::light).intensity == 0.5);
  CHECK(sampled(light, {1.5, 0, 0}, 12, FalloffModel::path).intensity == 8.0 / 256);
}

TEST_CASE("the ambient light is the share of the light's colour") {
  const PreparedLight light(crt::PointLight{.color = {1, 0.5, 0}, .ambient = 0.5},
                            FalloffModel::path);
  CHECK(light.ambient() == Rgb(0.5, 0.25, 0));
  CHECK(light.color() == Rgb(1, 0.5, 0));
}
