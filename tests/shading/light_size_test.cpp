// Lights with a size are sampled here by the numbers of a pixel's samples, and give what formulas
// say.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "core/sampling/sample_numbers.hpp"
#include "core/shading/prepared_light.hpp"

using namespace crt::core;
using crt::Vec3;

namespace {

constexpr double pi = std::numbers::pi;

struct Seen {
  double brightness = 0;  ///< of a white surface, mean over samples
  double largest = 0;     ///< of one sample
  double nearest = 0;     ///< the least distance to the light
};

/// Samples a light at a point of a surface with such a normal.
Seen seen_of(const PreparedLight& prepared, const Vec3& point, const Vec3& normal,
             std::uint32_t samples = 1u << 16) {
  const VectorLanes points = lanes_of(point);
  Seen seen{.nearest = std::numeric_limits<double>::infinity()};
  for (std::uint32_t i = 0; i < samples; i += lane_count) {
    std::array<SampleId, lane_count> ids;
    for (std::uint32_t lane = 0; lane < lane_count; ++lane) ids[lane] = {3, 5, i + lane};
    std::array<SampleDecision, lane_count> decisions;
    decisions.fill({.ray = 2, .kind = 7});
    const auto [u, v, spare_u, spare_v] = sample_numbers(1, ids, decisions);
    const LightNumbers numbers{.u = u, .v = v};
    LightSamples sampled;
    const std::uint32_t lit = mask_of(prepared.sample(points, Lanes{}, numbers, sampled));
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      if ((lit >> lane & 1u) == 0) continue;
      const Vec3 direction = sampled.directions.lane(lane);
      REQUIRE(std::abs(glm::length(direction) - 1) < 1e-14);
      const double share = sampled.intensities[lane] * std::max(0.0, glm::dot(direction, normal));
      seen.brightness += share / samples;
      seen.largest = std::max(seen.largest, share);
      seen.nearest = std::min(seen.nearest, double{sampled.distances[lane]});
    }
  }
  return seen;
}

Seen seen_from(const crt::Light& light, const Vec3& point, const Vec3& normal,
               std::uint32_t samples = 1u << 16) {
  return seen_of(PreparedLight(light, crt::FalloffModel::light), point, normal, samples);
}

/// Returns what a polygon of radiance 1 gives a surface at the origin, by Lambert's formula.
double irradiance_over_pi(const std::vector<Vec3>& corners, const Vec3& normal) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 a = glm::normalize(corners[i]);
    const Vec3 b = glm::normalize(corners[(i + 1) % corners.size()]);
    sum += std::acos(glm::dot(a, b)) * glm::dot(glm::normalize(glm::cross(a, b)), normal);
  }
  return std::abs(sum) / (2 * pi);
}

}  // namespace

TEST_CASE("a sphere light gives its projected solid angle over pi") {
  for (const double distance : {1.25, 2.0, 10.0, 1e4}) {
    const crt::SphereLight light{.center = {0, distance, 0}, .radius = 1};
    for (const double tilt : {0.0, 0.3, 0.5}) {
      // All of it is above the surface's horizon if the tilt leaves room for its half angle.
      const double half_angle = std::asin(1 / distance);
      if (tilt + half_angle > pi / 2) continue;
      const Seen seen = seen_from(light, {0, 0, 0}, {std::sin(tilt), std::cos(tilt), 0});
      const double exact = std::cos(tilt) / (distance * distance);
      CHECK(seen.brightness == doctest::Approx(exact).epsilon(1e-5));
      CHECK(seen.nearest == doctest::Approx(distance - 1).epsilon(1e-3));
    }
  }
}

TEST_CASE("no sample of a sphere light is much brighter than others, however near") {
  const Seen seen = seen_from(crt::SphereLight{.center = {0, 1.001, 0}}, {0, 0, 0}, {0, 1, 0});
  CHECK(seen.largest <= 2);
  CHECK(seen.brightness == doctest::Approx(1 / (1.001 * 1.001)).epsilon(1e-4));
}

TEST_CASE("a disc light gives what the formula of parallel discs says") {
  for (const double distance : {0.5, 2.0, 50.0}) {
    const crt::DiscLight light{.center = {0, distance, 0}, .normal = {0, -3, 0}, .radius = 2};
    const double exact = 4 / (4 + distance * distance);
    CHECK(seen_from(light, {0, 0, 0}, {0, 1, 0}).brightness ==
          doctest::Approx(exact).epsilon(2e-4));
    CHECK(seen_from(light, {0, 2 * distance, 0}, {0, -1, 0}).brightness == 0);
    crt::DiscLight both = light;
    both.two_sided = true;
    CHECK(seen_from(both, {0, 2 * distance, 0}, {0, -1, 0}).brightness ==
          doctest::Approx(exact).epsilon(2e-4));
  }
}

TEST_CASE("a rectangle light gives what Lambert's formula says") {
  const Vec3 corner(-1, 2, 0.5);
  for (const Vec3& edge_b : {Vec3(0, 0, 1.5), Vec3(0.7, -0.4, 1.5)}) {
    const Vec3 edge_a(2, 0.1, 0);
    const crt::RectangleLight light{
        .corner = corner, .edge_a = edge_a, .edge_b = edge_b, .two_sided = true};
    const double exact = irradiance_over_pi(
        {corner, corner + edge_a, corner + edge_a + edge_b, corner + edge_b}, {0, 1, 0});
    CHECK(seen_from(light, {0, 0, 0}, {0, 1, 0}).brightness ==
          doctest::Approx(exact).epsilon(5e-4));
  }
  // x and y as edges shine towards z.
  const crt::RectangleLight towards_z{
      .corner = {0, 0, 0}, .edge_a = {1, 0, 0}, .edge_b = {0, 1, 0}};
  CHECK(seen_from(towards_z, {0.5, 0.5, 1}, {0, 0, -1}).brightness > 0.1);
  CHECK(seen_from(towards_z, {0.5, 0.5, -1}, {0, 0, 1}).brightness == 0);
}

TEST_CASE("no sample of a rectangle with right angles is much brighter than others") {
  // All are as bright as the solid angle over pi, however near the point is to one corner.
  const crt::RectangleLight light{
      .corner = {-0.1, 0.02, -0.1}, .edge_a = {4, 0, 0}, .edge_b = {0, 0, 3}, .two_sided = true};
  const Seen seen = seen_from(light, {0, 0, 0}, {0, 1, 0});
  CHECK(seen.largest <= 2);
  const std::vector<Vec3> corners = {
      {-0.1, 0.02, -0.1}, {3.9, 0.02, -0.1}, {3.9, 0.02, 2.9}, {-0.1, 0.02, 2.9}};
  CHECK(seen.brightness == doctest::Approx(irradiance_over_pi(corners, {0, 1, 0})).epsilon(1e-5));
}

TEST_CASE("samples of rectangles lie on them, spread evenly over the solid angle") {
  const RectangleFrame frame{
      .x = {0.6, 0.8, 0}, .y = {-0.8, 0.6, 0}, .z = {0, 0, 1}, .width = 2, .height = 0.7};
  for (const Vec3& corner : {Vec3(-1, -0.3, 0.5), Vec3(0.2, 0.1, -0.3), Vec3(-3, 1, 0.1)}) {
    const SphericalRectangle seen(frame, lanes_of(corner));
    constexpr int steps = 64;
    Vec3 mean(0, 0, 0);
    for (int i = 0; i < steps; ++i) {
      for (int k = 0; k < steps; k += static_cast<int>(lane_count)) {
        LightNumbers numbers;
        for (std::size_t lane = 0; lane < lane_count; ++lane) {
          numbers.u[lane] = (i + 0.5) / steps;
          numbers.v[lane] = (k + static_cast<double>(lane) + 0.5) / steps;
        }
        const VectorLanes points = seen.sample(numbers);
        for (std::size_t lane = 0; lane < lane_count; ++lane) {
          const Vec3 offset = points.lane(lane) - corner;
          const double along_x = glm::dot(offset, frame.x);
          const double along_y = glm::dot(offset, frame.y);
          REQUIRE(std::abs(glm::dot(offset, frame.z)) < 1e-12);
          REQUIRE(along_x >= -1e-9);
          REQUIRE(along_x <= frame.width + 1e-9);
          REQUIRE(along_y >= -1e-9);
          REQUIRE(along_y <= frame.height + 1e-9);
          mean += glm::normalize(points.lane(lane)) / double{steps * steps};
        }
      }
    }
    // The vector irradiance of Lambert's formula is the mean direction times the solid angle.
    const std::vector<Vec3> corners = {corner, corner + frame.width * frame.x,
                                       corner + frame.width * frame.x + frame.height * frame.y,
                                       corner + frame.height * frame.y};
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
      const double exact = pi * irradiance_over_pi(corners, axis);
      CHECK(std::abs(glm::dot(mean, axis)) * seen.solid_angles()[0] ==
            doctest::Approx(exact).epsilon(1e-3).scale(0.1));
    }
  }
}

TEST_CASE("pieces of surfaces give what lights of their shape do") {
  const auto of_piece = [](const SurfacePiece& piece, bool two_sided) {
    return PreparedLight(piece, Rgb(1), two_sided);
  };
  const PreparedLight triangle = of_piece({.kind = SurfacePiece::Kind::triangle,
                                           .origin = {-1, 2, 0.5},
                                           .edge_a = {2, 0.1, 0},
                                           .edge_b = {0.7, -0.4, 1.5},
                                           .normal = glm::normalize(Vec3(0.15, -3, -0.87))},
                                          true);
  CHECK(
      seen_of(triangle, {0, 0, 0}, {0, 1, 0}).brightness ==
      doctest::Approx(irradiance_over_pi({{-1, 2, 0.5}, {1, 2.1, 0.5}, {-0.3, 1.6, 2}}, {0, 1, 0}))
          .epsilon(1e-4));
  // An endless tube overhead gives radius over distance.
  const PreparedLight tube = of_piece({.kind = SurfacePiece::Kind::tube,
                                       .origin = {-50, 3, 0},
                                       .edge_a = {100, 0, 0},
                                       .radius = 0.5},
                                      false);
  CHECK(seen_of(tube, {0, 0, 0}, {0, 1, 0}).brightness == doctest::Approx(0.5 / 3).epsilon(2e-3));
  CHECK(seen_of(tube, {0, 3, 0}, {0, 1, 0}).brightness == 0);  // from within
}

TEST_CASE("point and parallel lights with a size give what faces them as much as without") {
  const crt::PointLight ball{.origin = {0, 3, 0}, .radius = 1.5};
  CHECK(seen_from(ball, {0, 0, 0}, {0, 1, 0}).brightness == doctest::Approx(1).epsilon(1e-5));
  CHECK(seen_from(ball, {0, 0, 0}, {0.6, 0.8, 0}).brightness == doctest::Approx(0.8).epsilon(1e-5));
  CHECK(seen_from(ball, {0, 0, 0}, {0, 1, 0}).nearest == doctest::Approx(1.5).epsilon(1e-3));
  // Within the ball it is a point.
  const Seen within = seen_from(ball, {0, 2.5, 0}, {0, 1, 0}, 16);
  CHECK(within.brightness == doctest::Approx(1).epsilon(1e-12));
  CHECK(within.nearest == 0.5);

  const crt::ParallelLight sun{.from = {0, 1, 0}, .pointing = {0, 0, 0}, .angle = 0.5};
  CHECK(seen_from(sun, {7, 0, 0}, {0, 1, 0}).brightness == doctest::Approx(1).epsilon(1e-5));
  CHECK(seen_from(sun, {7, 0, 0}, {0, 0.6, 0.8}).brightness == doctest::Approx(0.6).epsilon(1e-5));
  CHECK(std::isinf(seen_from(sun, {0, 0, 0}, {0, 1, 0}, 4).nearest));
}

TEST_CASE("a fading ball fades as its center does") {
  const crt::PointLight ball{.origin = {0, 4, 0}, .falloff = 8, .radius = 1e-3};
  CHECK(seen_from(ball, {0, 0, 0}, {0, 1, 0}).brightness == doctest::Approx(0.5).epsilon(1e-3));
}

TEST_CASE("lines meet the shining sides of lights that are seen") {
  const auto met_at = [](const crt::Light& light, const Vec3& origin, const Vec3& direction) {
    const PreparedLight prepared(light, crt::FalloffModel::light);
    const LightMet met = prepared.meet({lanes_of(origin), lanes_of(direction)});
    return (mask_of(met.met) & 1u) != 0 ? double{met.t[0]} : -1;
  };
  const crt::SphereLight sphere{.center = {0, 0, 5}, .radius = 2};
  CHECK(met_at(sphere, {0, 0, 0}, {0, 0, 0.5}) == doctest::Approx(6));
  CHECK(met_at(sphere, {0, 0, 5}, {0, 0, 1}) == -1);  // from within
  CHECK(met_at(sphere, {0, 0, 9}, {0, 0, 1}) == -1);
  CHECK(met_at(sphere, {0, 2.001, 0}, {0, 0, 1}) == -1);
  const crt::DiscLight disc{.center = {0, 5, 0}, .normal = {0, -1, 0}, .radius = 1};
  CHECK(met_at(disc, {0.99, 0, 0}, {0, 1, 0}) == 5);
  CHECK(met_at(disc, {1.01, 0, 0}, {0, 1, 0}) == -1);
  CHECK(met_at(disc, {0, 9, 0}, {0, -1, 0}) == -1);
  CHECK(met_at(disc, {0, 5.5, 0}, {1, 0, 0}) == -1);
  const crt::RectangleLight rectangle{
      .corner = {0, 5, 0}, .edge_a = {2, 0, 0}, .edge_b = {1, 0, 1}};
  CHECK(met_at(rectangle, {0.5, 9, 0.25}, {0, -1, 0}) == -1);
  CHECK(met_at(rectangle, {0.5, 0, 0.25}, {0, 1, 0}) == 5);
  CHECK(met_at(rectangle, {0.5, 0, 0.75}, {0, 1, 0}) == -1);
  crt::RectangleLight both = rectangle;
  both.two_sided = true;
  CHECK(met_at(both, {0.5, 9, 0.25}, {0, -2, 0}) == 2);
}
