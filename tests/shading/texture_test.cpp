#include "core/shading/texture.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace crt::core;
using crt::Color;
using crt::Image;

namespace {

/// Makes a picture whose texel (x, y) is red x / 10 and green y / 10.
std::shared_ptr<Image> ramp(int width, int height) {
  auto image = std::make_shared<Image>(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image->set(x, y, {x / 10.0, y / 10.0, 0, 1});
  }
  return image;
}

}  // namespace

TEST_CASE("texels have their own colour at their centres") {
  const auto image = ramp(4, 3);
  const Texture texture(image, 1);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 4; ++x) {
      CHECK(texture.bilinear(x + 0.5, y + 0.5, TextureWrap::repeat, TextureWrap::clamp) ==
            image->at(x, y));
    }
  }
}

TEST_CASE("texels that are not finite count as 0, and the pool tells of them once a picture") {
  const auto image = ramp(4, 3);
  image->set(2, 1, {NAN, 0.5, INFINITY, 1});
  image->set(3, 2, {1, 1, 1, NAN});
  TexturePool pool(2.2);
  const auto texture = pool.get(image);
  pool.get(image);
  CHECK(texture->bilinear(2.5, 1.5, TextureWrap::repeat, TextureWrap::clamp) ==
        Color{0, 0.5, 0, 1});
  CHECK(texture->bilinear(3.5, 2.5, TextureWrap::repeat, TextureWrap::clamp) == Color{0, 0, 0, 0});
  CHECK_FALSE(texture->opaque());
  CHECK(texture->bytes() > image->pixels().size_bytes());
  CHECK(std::isnan(image->at(2, 1).r));  // the user's stays as it is
  const auto clean = ramp(2, 2);
  pool.get(clean);
  CHECK(pool.warnings() ==
        std::vector<std::string>{"an image has 2 pixels with values that are not finite "
                                 "(NaN, infinity), the first at (2, 1) from the top left: "
                                 "they count as 0"});
}

TEST_CASE("between four texels a colour is the mean that is linear in x and in y") {
  const Texture texture(ramp(4, 3), 1);
  const Color color = texture.bilinear(1.75, 2, TextureWrap::clamp, TextureWrap::clamp);
  CHECK(color.r == doctest::Approx(0.125).epsilon(1e-6));
  CHECK(color.g == doctest::Approx(0.15).epsilon(1e-6));
}

TEST_CASE("a repeating side blends the last texel with the first, a clamped one ends") {
  const Texture texture(ramp(4, 4), 1);
  CHECK(texture.bilinear(0, 0.5, TextureWrap::repeat, TextureWrap::repeat).r ==
        doctest::Approx(0.15));
  CHECK(texture.bilinear(4, 0.5, TextureWrap::repeat, TextureWrap::repeat).r ==
        doctest::Approx(0.15));
  CHECK(texture.bilinear(-4, 0.5, TextureWrap::repeat, TextureWrap::repeat).r ==
        doctest::Approx(0.15));
  CHECK(texture.bilinear(0, 0.5, TextureWrap::clamp, TextureWrap::clamp).r == 0);
  CHECK(texture.bilinear(-1e300, 0.5, TextureWrap::clamp, TextureWrap::clamp).r == 0);
  CHECK(texture.bilinear(1e300, 0.5, TextureWrap::clamp, TextureWrap::clamp).r ==
        doctest::Approx(0.3));
}

TEST_CASE("any finite position gives one of the picture's colours or a mean of them") {
  const Texture texture(ramp(3, 2), 1);
  for (const double x :
       {-1e300, -1e17, -3 - 1e-16, -1e-300, 0.0, 2.9999999999999996, 1e16, 1e300}) {
    const Color color = texture.bilinear(x, x, TextureWrap::repeat, TextureWrap::repeat);
    CHECK(color.r >= 0);
    CHECK(color.r <= doctest::Approx(0.2));
  }
}

TEST_CASE("a display-encoded picture is raised to gamma, a linear one stays") {
  const auto image = std::make_shared<Image>(1, 1);
  image->set(0, 0, {0.5, 0.25, 1, 1});
  const auto color_at_gamma = [&](double gamma) {
    return Texture(image, gamma).bilinear(0.5, 0.5, TextureWrap::clamp, TextureWrap::clamp);
  };
  CHECK(color_at_gamma(2) == Color{0.5, 0.25, 1, 1});
  image->set_display_encoded(true);
  CHECK(color_at_gamma(1) == Color{0.5, 0.25, 1, 1});
  CHECK(color_at_gamma(2) == Color{0.25, 0.0625, 1, 1});
  CHECK(image->at(0, 0).r == 0.5);
}

TEST_CASE("gamma is of the straight colours, and colours come out straight") {
  const auto image = std::make_shared<Image>(1, 1);
  image->set(0, 0, {0.25, 0.125, 0, 0.5});  // straight (0.5, 0.25, 0)
  image->set_display_encoded(true);
  const Color color = Texture(image, 2).bilinear(0.5, 0.5, TextureWrap::clamp, TextureWrap::clamp);
  CHECK(color == Color{0.25, 0.0625, 0, 0.5});
}

TEST_CASE("where nothing covers the colour is black and fully transparent") {
  const auto image = std::make_shared<Image>(2, 1);
  image->set(0, 0, {0, 0, 0, 0});
  image->set(1, 0, {1, 1, 1, 1});
  const Texture texture(image, 2.2);
  CHECK_FALSE(texture.opaque());
  CHECK(texture.bilinear(0.5, 0.5, TextureWrap::clamp, TextureWrap::clamp) == Color{0, 0, 0, 0});
  // Half way to white there is one half covered by pure white, and one not covered by grey.
  CHECK(texture.bilinear(1, 0.5, TextureWrap::clamp, TextureWrap::clamp) == Color{1, 1, 1, 0.5});
}

TEST_CASE("a pool makes each picture ready once") {
  TexturePool pool(2);
  const auto a = ramp(2, 2);
  const auto b = ramp(2, 2);
  CHECK(pool.get(a) == pool.get(a));
  CHECK(pool.get(a) != pool.get(b));
}
