#include "core/shading/bump.hpp"

#include <doctest/doctest.h>
#include <crt/primitives.hpp>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/shading/rgb.hpp"

using namespace crt::core;
using crt::Vec3;

namespace {

constexpr double pi = std::numbers::pi;

LuminanceGradient gradient_on(const crt::Primitive& primitive, const crt::Pattern& pattern,
                              const SurfacePoint& point, std::uint32_t face = 0) {
  TexturePool textures(1);
  CrossingList scratch;
  return luminance_gradient(PreparedPattern(pattern, textures), point, *make_shape(primitive), face,
                            scratch);
}

void check_near(const Vec3& a, const Vec3& b, double tolerance) {
  CHECK(glm::length(a - b) <= tolerance);
}

}  // namespace

TEST_CASE("luminance weighs the channels as the eye does and is 1 for white") {
  CHECK(luminance({1, 1, 1}) == doctest::Approx(1));
  CHECK(luminance({0, 1, 0}) > luminance({1, 0, 0}));
  CHECK(luminance({1, 0, 0}) > luminance({0, 0, 1}));
}

TEST_CASE("the gradient of a pattern in space is the derivative of its luminance") {
  // The gradient pattern is 0.5 + 0.5 cos(2 pi y / scale).
  const double scale = 3;
  const SurfacePoint point{.position = {0.3, 0.4, -7}};
  const LuminanceGradient found =
      gradient_on(crt::Plane{}, crt::Gradient{.direction = {0, 1, 0}, .scale = scale}, point);
  const double expected = -pi / scale * std::sin(2 * pi * 0.4 / scale);
  check_near(found.gradient, {0, expected, 0}, 2e-3 * std::abs(expected));
  CHECK(found.lookups == 6);
}

TEST_CASE("a height that grows in one direction leans the normal the other way, by its slope") {
  check_near(tilted_normal({0, 1, 0}, {0.5, 0, 0}), glm::normalize(Vec3(-0.5, 1, 0)), 1e-15);
  // A change along the normal itself moves the surface but does not tilt it.
  check_near(tilted_normal({0, 1, 0}, {0, 3, 0}), {0, 1, 0}, 1e-15);
}

TEST_CASE("a height without a gradient that a double holds leaves the normal as it is") {
  const double inf = std::numeric_limits<double>::infinity();
  CHECK(tilted_normal({0, 1, 0}, {inf, 0, 0}) == Vec3(0, 1, 0));
}

TEST_CASE("a normal turned away from the viewer is bent until it is just visible") {
  const Vec3 view(0, 0, 1);
  CHECK(visible_normal({0, 0.6, -0.8}, view) == Vec3(0, 0.6, -0.8));
  const Vec3 bent = visible_normal(glm::normalize(Vec3(0, 1, 0.5)), view);
  check_near(bent, {0, 1, 0}, 1e-15);
  CHECK(visible_normal(view, view) == -view);
}

TEST_CASE("(u, v) of a sphere change by longitude and latitude") {
  const double radius = 2;
  const crt::Sphere sphere{.center = {1, 2, 3}, .radius = radius};
  const double latitude = 0.4;
  const double longitude = 0.9;
  const Vec3 normal(std::cos(latitude) * std::cos(longitude), std::sin(latitude),
                    std::cos(latitude) * std::sin(longitude));
  CrossingList scratch;
  const UvGradient uv =
      uv_gradient(*make_shape(sphere), 0, sphere.center + radius * normal, normal, scratch);
  CHECK(glm::length(uv.u) ==
        doctest::Approx(1 / (2 * pi * radius * std::cos(latitude))).epsilon(1e-4));
  CHECK(glm::length(uv.v) == doctest::Approx(1 / (pi * radius)).epsilon(1e-4));
  CHECK(std::abs(glm::dot(uv.u, uv.v)) < 1e-4);
  CHECK(std::abs(glm::dot(uv.u, normal)) < 1e-9);
  CHECK(std::abs(uv.u.y) < 1e-4);
}

TEST_CASE("the gradient of u does not jump where 1 meets 0") {
  const crt::Sphere sphere;
  CrossingList scratch;
  for (int step = 0; step < 64; ++step) {
    const double longitude = 2 * pi * step / 64;
    const Vec3 normal(std::cos(longitude), 0, std::sin(longitude));
    const UvGradient uv = uv_gradient(*make_shape(sphere), 0, normal, normal, scratch);
    CHECK(glm::length(uv.u) == doctest::Approx(1 / (2 * pi)).epsilon(1e-4));
  }
}

TEST_CASE("beside the edge of a face (u, v) come from the side that exists") {
  const crt::Triangle triangle{.a = {0, 0, 0}, .b = {2, 0, 0}, .c = {0, 4, 0}};
  CrossingList scratch;
  const Vec3 normal(0, 0, 1);
  for (const Vec3& point : {Vec3(0.5, 1, 0), Vec3(1e-9, 1, 0), Vec3(0.5, 1e-9, 0)}) {
    const UvGradient uv = uv_gradient(*make_shape(triangle), 0, point, normal, scratch);
    check_near(uv.u, {0.5, 0, 0}, 1e-3);
    check_near(uv.v, {0, 0.25, 0}, 1e-3);
  }
}

TEST_CASE("an image map's slope is that of its texels over the surface") {
  // Luminance rises by 1/8 from column to column; the triangle spreads the 8 columns over 2 units.
  const auto image = std::make_shared<crt::Image>(8, 8);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) image->set(x, y, crt::grey(x / 8.0));
  }
  const crt::Triangle triangle{.a = {0, 0, 0}, .b = {2, 0, 0}, .c = {0, 4, 0}};
  const SurfacePoint point{.position = {0.7, 1.2, 0}, .normal = {0, 0, 1}, .u = 0.35, .v = 0.3};
  const LuminanceGradient found = gradient_on(triangle, crt::ImageMap{.image = image}, point);
  check_near(found.gradient, {0.5, 0, 0}, 1e-3);
}
