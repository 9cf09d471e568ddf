// These tests check patterns of other patterns, patterns of several colours, and pictures that are
// laid over a surface by its place in space.
#include <doctest/doctest.h>
#include <crt/primitives.hpp>

#include <cmath>
#include <limits>
#include <string>

#include "core/shading/bump.hpp"
#include "core/shading/prepared_pattern.hpp"
#include "crt/error.hpp"
#include "crt/validate.hpp"

using namespace crt::core;
using crt::Color;
using crt::ImageMapping;
using crt::Vec3;

namespace {

const Color red = {1, 0, 0};
const Color green = {0, 1, 0};
const Color blue = {0, 0, 1};

PreparedPattern prepared(const crt::Pattern& pattern) {
  TexturePool textures(1);
  return {pattern, textures};
}

Color color_at(const crt::Pattern& pattern, const Vec3& position, const Vec3& normal = {0, 1, 0}) {
  return prepared(pattern).color({.position = position, .normal = normal});
}

std::string refusal(const crt::Pattern& pattern) {
  try {
    crt::validate(pattern);
    return "";
  } catch (const crt::Error& error) {
    return error.what();
  }
}

/// Returns a picture of 2 x 2: red and green above, blue and white below.
std::shared_ptr<const crt::Image> picture() {
  auto image = std::make_shared<crt::Image>(2, 2);
  image->set(0, 0, red);
  image->set(1, 0, green);
  image->set(0, 1, blue);
  image->set(1, 1, {1, 1, 1});
  return image;
}

crt::ImageMap picture_by(ImageMapping mapping, const Vec3& direction = {0, 0, 1}) {
  return {.image = picture(), .mapping = mapping, .direction = direction};
}

}  // namespace

TEST_CASE("a pattern in the place of a colour is seen where the colour would be") {
  const crt::Stripes inner{.color_a = red, .color_b = green, .direction = {0, 0, 1}};
  const crt::Checker outer{
      .color_b = blue, .offset = {0, -0.5, 0}, .pattern_a = crt::nested(inner)};
  CHECK(color_at(outer, {0.5, 0, 0.25}) == red);
  CHECK(color_at(outer, {0.5, 0, 0.75}) == green);
  CHECK(color_at(outer, {1.5, 0, 0.25}) == blue);
  const crt::Gradient smooth{
      .scale = 2, .pattern_a = crt::nested(inner), .pattern_b = crt::nested(outer)};
  CHECK(color_at(smooth, {1.5, 0, 0.25}) == red);
  CHECK(color_at(smooth, {1.5, 1, 0.25}) == color_at(outer, {1.5, 1, 0.25}));
  const Color middle = color_at(smooth, {1.5, 0.5, 0.75});
  const Color other = color_at(outer, {1.5, 0.5, 0.75});
  CHECK(middle.r == doctest::Approx(0.5 * other.r));
  CHECK(middle.g == doctest::Approx(0.5 + 0.5 * other.g));
}

TEST_CASE("a nested pattern of the same colour everywhere changes nothing, in all lanes") {
  const crt::Checker plain{.color_a = red, .color_b = red};
  const crt::Wood wood{.color_a = green, .color_b = red};
  crt::Wood composed = wood;
  composed.pattern_b = crt::nested(plain);
  SurfacePointLanes points;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const double place = 0.37 * static_cast<double>(lane) - 1;
    points.position.set(lane, Vec3(place, 2 * place, 1));
    points.normal.set(lane, Vec3(0, 1, 0));
  }
  const ColorLanes expected = prepared(wood).colors(points, ~0u);
  const ColorLanes found = prepared(composed).colors(points, ~0u);
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    CHECK(found.color.lane(lane) == expected.color.lane(lane));
    CHECK(found.alpha[lane] == expected.alpha[lane]);
  }
}

TEST_CASE("stops are met exactly, and between them colours change evenly") {
  crt::Gradient map{.scale = 2, .colors = {{0, red}, {0.5, green}, {0.5, blue}, {1, red}}};
  // The wave of a gradient is at a share of 0, 1/4, 1/2 and 1 at these heights.
  CHECK(color_at(map, {0, 0, 0}) == red);
  CHECK(color_at(map, {0, 1, 0}) == red);
  CHECK(color_at(map, {0, 1.0 / 3, 0}).r == doctest::Approx(0.5));
  CHECK(color_at(map, {0, 1.0 / 3, 0}).g == doctest::Approx(0.5));
  CHECK(color_at(map, {0, 0.5 - 1e-9, 0}).g == doctest::Approx(1).epsilon(1e-6));
  CHECK(color_at(map, {0, 0.5 + 1e-9, 0}).b == doctest::Approx(1).epsilon(1e-6));
  map.colors = {{0.25, green}, {0.75, blue}};
  CHECK(color_at(map, {0, 0, 0}) == green);
  CHECK(color_at(map, {0, 1, 0}) == blue);
}

TEST_CASE("two stops at 0 and 1 are the two colours") {
  for (const double height : {0.0, 0.1, 0.77, 1.3}) {
    const crt::Noise two{.color_a = red, .color_b = blue, .scale = 0.3};
    const crt::Noise stops{.scale = 0.3, .colors = {{0, red}, {1, blue}}};
    const Color expected = color_at(two, {0.2, height, 0.4});
    const Color found = color_at(stops, {0.2, height, 0.4});
    CHECK(found.r == doctest::Approx(expected.r));
    CHECK(found.b == doctest::Approx(expected.b));
  }
}

TEST_CASE("opacity, brightness and the use of u and v are those of all parts") {
  const Color thin = {0.5, 0.5, 0.5, 0.5};
  CHECK(prepared(crt::Gradient{.colors = {{0, red}, {1, blue}}}).opaque());
  CHECK_FALSE(prepared(crt::Gradient{.colors = {{0, red}, {1, thin}}}).opaque());
  CHECK(prepared(crt::Gradient{.colors = {{0, red}, {1, {0, 9, 0}}}}).brightest() == 9);
  const auto inner = [](const crt::Pattern& pattern) {
    return prepared(crt::Checker{.pattern_b = crt::nested(pattern)});
  };
  CHECK_FALSE(inner(crt::Checker{.color_a = thin}).opaque());
  CHECK(inner(crt::Checker{.color_a = {0, 7, 0}}).brightest() == 7);
  CHECK_FALSE(inner(crt::Checker{}).uses_uv());
  CHECK(inner(picture_by(ImageMapping::uv)).uses_uv());
  CHECK_FALSE(inner(picture_by(ImageMapping::cubic)).uses_uv());
  CHECK_FALSE(prepared(picture_by(ImageMapping::planar)).uses_uv());
}

TEST_CASE("a planar picture looks as it is for one who looks along its direction") {
  const double low = 0.25;
  const double high = 0.75;
  const crt::ImageMap front = picture_by(ImageMapping::planar);
  CHECK(color_at(front, {low, high, 5}) == red);
  CHECK(color_at(front, {high, high, -3}) == green);
  CHECK(color_at(front, {low, low, 0}) == blue);
  CHECK(color_at(front, {low + 1, low - 2, 0}) == blue);
  const crt::ImageMap floor = picture_by(ImageMapping::planar, {0, -3, 0});
  CHECK(color_at(floor, {low, 5, high}) == red);
  CHECK(color_at(floor, {high, 5, high}) == green);
  const crt::ImageMap left = picture_by(ImageMapping::planar, {1, 0, 0});
  CHECK(color_at(left, {0, high, -low}) == red);
  CHECK(color_at(left, {0, high, -high}) == green);
  crt::ImageMap large = front;
  large.scale = 4;
  large.offset = {1, 2, 3};
  CHECK(color_at(large, {1 + 4 * low, 2 + 4 * high, 0}) == red);
}

TEST_CASE("a cubic picture stands upright on all sides, and is seen from outside") {
  const crt::ImageMap map = picture_by(ImageMapping::cubic);
  const double low = 0.25;
  const double high = 0.75;
  CHECK(color_at(map, {low, high, -1}, {0.1, 0, -1}) == red);
  CHECK(color_at(map, {-low, high, 1}, {0, 0, 1}) == red);
  CHECK(color_at(map, {-1, high, -low}, {-1, 0.5, 0}) == red);
  CHECK(color_at(map, {1, high, low}, {1, 0, 0}) == red);
  CHECK(color_at(map, {low, 1, high}, {0, 1, 0}) == red);
  CHECK(color_at(map, {1, high, high}, {1, 0, 0}) == green);
}

TEST_CASE("a cylindrical picture goes around once, with its middle at -z") {
  const crt::ImageMap map = picture_by(ImageMapping::cylindrical, {0, 2, 0});
  // A quarter of the width is at -x, three quarters are at x.
  CHECK(color_at(map, {-1, 0.75, 0}) == red);
  CHECK(color_at(map, {5, 0.75, 0}) == green);
  CHECK(color_at(map, {-1, 0.25, 0}) == blue);
  const Color middle = color_at(map, {0, 0.75, -2});
  CHECK(middle.r == doctest::Approx(0.5));
  CHECK(middle.g == doctest::Approx(0.5));
}

TEST_CASE("a picture in space raises the surface where it gets brighter") {
  auto image = std::make_shared<crt::Image>(4, 1);
  for (int x = 0; x < 4; ++x) {
    const double level = x / 4.0;
    image->set(x, 0, {level, level, level});
  }
  const crt::ImageMap map{.image = image, .mapping = ImageMapping::planar, .scale = 2};
  // Around the middle of the picture the level grows by 1/4 within a quarter of the width.
  const SurfacePoint point{.position = {1, 0.5, 0}, .normal = {0, 0, -1}};
  for (const crt::Pattern& pattern : {crt::Pattern(map), crt::Pattern(crt::Checker{.scale = 99,
                                                         .offset = {-9, -9, -9},
                                                         .pattern_a = crt::nested(map)})}) {
    TexturePool textures(1);
    CrossingList scratch;
    const LuminanceGradient found = luminance_gradient(PreparedPattern(pattern, textures), point,
                                                       *make_shape(crt::Plane{}), 0, scratch);
    CHECK(found.gradient.x == doctest::Approx(0.5));
    CHECK(found.gradient.y == doctest::Approx(0));
  }
}

TEST_CASE("patterns within one another are bounded, and stops must be in order") {
  crt::Pattern pattern = crt::Checker{};
  for (int depth = 2; depth <= 5; ++depth) {
    pattern = crt::Wood{.pattern_a = crt::nested(pattern)};
    CHECK(refusal(pattern).empty());
  }
  CHECK(refusal(crt::Noise{.pattern_b = crt::nested(pattern)}).find("more than 5 patterns") !=
        std::string::npos);
  CHECK(refusal(crt::Checker{.pattern_a = crt::nested(crt::Wood{.scale = 0})}).find("scale") == 0);
  const auto stops = [](std::vector<crt::ColorStop> colors) {
    return refusal(crt::Gradient{.colors = std::move(colors)});
  };
  CHECK(stops({{0, red}, {1, red}}).empty());
  CHECK(stops({{0, red}}).find("colors must be between 2 and 64") == 0);
  CHECK(stops(std::vector<crt::ColorStop>(65)).find("colors must be between 2 and 64") == 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double wrong : {-0.1, 0.4, 1.1, nan})
    CHECK(stops({{0.5, red}, {wrong, red}}).find("colors must have ascending positions") == 0);
  CHECK(stops({{0, red}, {1, {-1, 0, 0}}}).find("colors must not have negative") == 0);
  CHECK(refusal(
            crt::Gradient{.pattern_a = crt::nested(crt::Checker{}), .colors = {{0, red}, {1, red}}})
            .find("colors take the place of both") == 0);
  crt::ImageMap map = picture_by(ImageMapping::planar, {0, 0, 0});
  CHECK(refusal(map).find("direction must not be zero") == 0);
  map.direction = {1, 0, 0};
  map.scale = 0;
  CHECK(refusal(map).find("scale must be greater than 0") == 0);
}
