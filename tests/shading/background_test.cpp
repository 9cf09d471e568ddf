#include "core/shading/prepared_background.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

using namespace crt::core;
using crt::Color;
using crt::Image;
using crt::Vec3;

namespace {

constexpr double pi = std::numbers::pi;

PreparedBackground prepared(const crt::Background& background, double gamma = 1, int compat = 0) {
  TexturePool textures(gamma);
  return {background, textures, compat};
}

/// Makes a picture whose texels all have different colours.
std::shared_ptr<Image> test_picture(int width, int height) {
  auto image = std::make_shared<Image>(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image->set(x, y, {x / 16.0, y / 16.0, 0.5, 1});
  }
  return image;
}

Vec3 direction(double yaw, double pitch) {
  return {std::sin(yaw) * std::cos(pitch), std::sin(pitch), std::cos(yaw) * std::cos(pitch)};
}

void check_same(const Color& a, const Color& b) {
  CHECK(a.r == doctest::Approx(b.r).epsilon(1e-9));
  CHECK(a.g == doctest::Approx(b.g).epsilon(1e-9));
  CHECK(a.b == doctest::Approx(b.b).epsilon(1e-9));
  CHECK(a.a == doctest::Approx(b.a).epsilon(1e-9));
}

}  // namespace

TEST_CASE("a solid background is the same in every direction") {
  const PreparedBackground background = prepared(crt::SolidBackground{{0.1, 0.2, 0.3, 0.4}});
  CHECK(background.color({0, 1, 0}) == Color{0.1, 0.2, 0.3, 0.4});
  CHECK(background.color({0.6, 0, -0.8}) == Color{0.1, 0.2, 0.3, 0.4});
}

TEST_CASE("a gradient is linear in |d.y|, from the horizon to the sky above and below") {
  const PreparedBackground background =
      prepared(crt::GradientBackground{.horizon = {1, 0, 0, 1}, .sky = {0, 1, 0, 0}});
  CHECK(background.color({1, 0, 0}) == Color{1, 0, 0, 1});
  CHECK(background.color({0, 1, 0}) == Color{0, 1, 0, 0});
  CHECK(background.color({0, -1, 0}) == Color{0, 1, 0, 0});
  check_same(background.color({0.8, -0.6, 0}), {0.4, 0.6, 0, 0.4});
}

TEST_CASE("a spherical panorama shows each texel in the middle of its share of yaw and pitch") {
  const auto picture = test_picture(8, 4);
  const PreparedBackground background = prepared(crt::PanoramaBackground{picture});
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) {
      const double yaw = ((x + 0.5) / 8 - 0.5) * 2 * pi;
      const double pitch = (0.5 - (y + 0.5) / 4) * pi;
      check_same(background.color(direction(yaw, pitch)), picture->at(x, y));
    }
  }
}

TEST_CASE("an equal-area panorama shows each texel in the middle of its share of yaw and height") {
  const auto picture = test_picture(8, 4);
  const PreparedBackground background =
      prepared(crt::PanoramaBackground{picture, crt::PanoramaProjection::equal_area});
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) {
      const double yaw = ((x + 0.5) / 8 - 0.5) * 2 * pi;
      const double height = 1 - 2 * (y + 0.5) / 4;
      check_same(background.color(direction(yaw, std::asin(height))), picture->at(x, y));
    }
  }
  CHECK(background.color({0, 1, 0}).g == 0);
  CHECK(background.color({0, -1, 0}).g == 3 / 16.0);
}

TEST_CASE(
    "panoramas of 2015 are equal-area ones where today's are spherical, and turn the other way") {
  using enum crt::PanoramaProjection;
  const auto picture = test_picture(8, 4);
  for (const auto& [in_2015, today] :
       {std::pair(spherical, equal_area), std::pair(equal_area, equal_area),
        std::pair(cylindrical, cylindrical)}) {
    const PreparedBackground old_one =
        prepared(crt::PanoramaBackground{picture, in_2015, 0.7}, 1, 2015);
    const PreparedBackground new_one = prepared(crt::PanoramaBackground{picture, today, -0.7});
    for (int i = 0; i < 100; ++i) {
      const Vec3 towards = direction(0.37 * i, std::sin(1.3 * i) * pi / 2);
      CHECK(old_one.color(towards) == new_one.color(towards));
    }
  }
}

TEST_CASE(
    "a panorama's middle is straight ahead, its right half to the right, its edges meet behind") {
  const auto picture = test_picture(8, 1);
  const PreparedBackground background = prepared(crt::PanoramaBackground{picture});
  CHECK(background.color({0, 0, 1}).r == doctest::Approx(3.5 / 16));
  CHECK(background.color({1, 0, 0}).r == doctest::Approx(5.5 / 16));
  CHECK(background.color({-1, 0, 0}).r == doctest::Approx(1.5 / 16));
  CHECK(background.color({1e-12, 0, -1}).r == doctest::Approx(3.5 / 16));  // half way from 7 to 0
  CHECK(background.color({-1e-12, 0, -1}).r == doctest::Approx(3.5 / 16));
}

TEST_CASE("the angle turns a panorama about y") {
  const auto picture = test_picture(8, 4);
  const PreparedBackground straight = prepared(crt::PanoramaBackground{picture});
  const PreparedBackground turned =
      prepared(crt::PanoramaBackground{.image = picture, .angle = 0.7});
  for (const double yaw : {-3.0, -1.0, 0.0, 2.0, 3.0}) {
    check_same(turned.color(direction(yaw, 0.3)), straight.color(direction(yaw + 0.7, 0.3)));
  }
}

TEST_CASE("straight up and down are the first and the last row") {
  const auto picture = test_picture(8, 4);
  for (const auto projection :
       {crt::PanoramaProjection::spherical, crt::PanoramaProjection::cylindrical}) {
    const PreparedBackground background = prepared(crt::PanoramaBackground{picture, projection});
    CHECK(background.color({0, 1, 0}).g == doctest::Approx(0.0));
    CHECK(background.color({0, -1, 0}).g == doctest::Approx(3 / 16.0));
  }
}

TEST_CASE("a cylindrical panorama's rows are as high as its columns are wide, seen level") {
  const auto picture = test_picture(8, 4);
  const PreparedBackground background =
      prepared(crt::PanoramaBackground{picture, crt::PanoramaProjection::cylindrical});
  for (int y = 0; y < 4; ++y) {
    // On the cylinder of radius 1 a texel is 2 pi / 8 high. The horizon is the middle of the
    // picture.
    const double height = (2 - (y + 0.5)) * 2 * pi / 8;
    for (int x = 0; x < 8; ++x) {
      const double yaw = ((x + 0.5) / 8 - 0.5) * 2 * pi;
      check_same(background.color(glm::normalize(Vec3(std::sin(yaw), height, std::cos(yaw)))),
                 picture->at(x, y));
    }
  }
}

TEST_CASE("a panorama from an 8-bit file is raised to gamma") {
  const auto picture = std::make_shared<Image>(1, 1);
  picture->set(0, 0, {0.5, 0.5, 0.5, 1});
  picture->set_display_encoded(true);
  CHECK(prepared(crt::PanoramaBackground{picture}, 2).color({0, 0, 1}).r == 0.25);
}

TEST_CASE("several directions side by side see what each sees alone, to the last bit") {
  const std::array<crt::Background, 3> backgrounds = {
      crt::SolidBackground{{0.1, 0.2, 0.3, 0.4}},
      crt::GradientBackground{.horizon = {1, 0, 0, 1}, .sky = {0.1, 0.7, 0.3, 0}},
      crt::PanoramaBackground{test_picture(8, 4)}};
  for (const crt::Background& kind : backgrounds) {
    const PreparedBackground background = prepared(kind);
    VectorLanes directions;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const double angle = 0.7 * static_cast<double>(lane);
      directions.set(lane, direction(angle, angle - 1));
    }
    constexpr std::uint32_t asked = 0b1011;
    const ColorLanes colors = background.colors(directions, asked);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      if ((asked >> lane & 1u) == 0) continue;
      const Vec3 color = colors.color.lane(lane);
      CHECK(Color{color.x, color.y, color.z, colors.alpha[lane]} ==
            background.color(directions.lane(lane)));
    }
  }
}
