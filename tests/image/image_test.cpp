#include "crt/image.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "crt/error.hpp"

using crt::Color;
using crt::Error;
using crt::ErrorCode;
using crt::Image;

namespace {

ErrorCode error_of(int width, int height, const char* argument) {
  try {
    const Image image(width, height);
  } catch (const Error& error) {
    CHECK(error.argument() == argument);
    return error.code();
  }
  return ErrorCode::internal;
}

/// Returns the bytes of one pixel.
std::array<int, 4> bytes_of(const Color& color, double gamma = 1, bool show_clip = false) {
  Image image(1, 1);
  image.set(0, 0, color);
  crt::Settings settings;
  settings.gamma = gamma;
  settings.show_clip = show_clip;
  image.set_settings(settings);
  const std::vector<std::uint8_t> bytes = image.to_rgba8();
  return {bytes[0], bytes[1], bytes[2], bytes[3]};
}

using Pixel = std::array<int, 4>;

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("a new picture is black and fully covered") {
  const Image image(3, 2);
  CHECK(image.width() == 3);
  CHECK(image.height() == 2);
  CHECK(image.pixels().size() == 24);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) CHECK(image.at(x, y) == Color{0, 0, 0, 1});
  CHECK(Image().empty());
  CHECK(Image().to_rgba8().empty());
}

TEST_CASE("impossible sizes are errors that name the side, before anything is allocated") {
  CHECK(error_of(0, 5, "width") == ErrorCode::invalid_argument);
  CHECK(error_of(5, 0, "height") == ErrorCode::invalid_argument);
  CHECK(error_of(-1, -1, "width") == ErrorCode::invalid_argument);
  CHECK(error_of(65536, 65536, "width") == ErrorCode::invalid_argument);
  const int most = std::numeric_limits<int>::max();
  CHECK(error_of(most, most, "width") == ErrorCode::invalid_argument);
  CHECK(error_of((1 << 27) + 1, 1, "width") == ErrorCode::invalid_argument);
}

TEST_CASE("what is set is found at its place, rows from the top") {
  Image image(4, 3);
  image.set(1, 2, {0.25, 2, -1, 0.5});
  CHECK(image.at(1, 2) == Color{0.25, 2, -1, 0.5});
  CHECK(image.pixels()[std::size_t{4} * (2 * 4 + 1)] == 0.25f);
  CHECK(image.at(2, 1) == Color{0, 0, 0, 1});
}

TEST_CASE("every level comes out as itself, and halves between two go up") {
  for (int level = 0; level < 256; ++level) {
    const double value = level / 255.0;
    CHECK(bytes_of({value, value, value}) == Pixel{level, level, level, 255});
  }
  // 0.5 is exactly between levels 127 and 128.
  CHECK(bytes_of({0.5, std::nextafter(0.5f, 0.0f), std::nextafter(0.5f, 1.0f)}) ==
        Pixel{128, 127, 128, 255});
}

TEST_CASE("in 2015 values are cut to the level below") {
  Image image(4, 1);
  image.set(0, 0, {0.999, 0.5, 1, 1});
  image.set(1, 0, {0.9 / 255, 254.999 / 255, 254.99 / 255, 1});
  image.set(2, 0, {2, -1, 0, 1});
  image.set(3, 0, {0.5, 0.25, 0, 0.5});
  crt::Settings settings;
  settings.gamma = 1;
  settings.compat = crt::compat_2015;
  image.set_settings(settings);
  CHECK(image.to_rgba8() == std::vector<std::uint8_t>{254, 127, 255, 255, 0, 254, 254, 255, 255, 0,
                                                      0, 255, 255, 127, 0, 127});
}

TEST_CASE("in 2015 as well every level comes out as itself, at any gamma and alpha") {
  for (const double gamma : {1.0, 1.8, 2.2}) {
    Image image(256, 255);
    for (int x = 0; x < 256; ++x) {
      for (int y = 0; y < 255; ++y) {
        const double alpha = (y + 1) / 255.0;
        const double value = alpha * std::pow(x / 255.0, gamma);
        image.set(x, y, {value, value, value, alpha});
      }
    }
    crt::Settings settings;
    settings.gamma = gamma;
    settings.compat = crt::compat_2015;
    image.set_settings(settings);
    const std::vector<std::uint8_t> bytes = image.to_rgba8();
    int wrong = 0;
    for (std::size_t i = 0; i < bytes.size(); i += 4) {
      const std::size_t pixel = i / 4;
      wrong += bytes[i] != pixel % 256 || bytes[i + 3] != pixel / 256 + 1;
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("gamma is applied to the clamped value before rounding") {
  for (const double gamma : {0.1, 0.5, 1.0, 1.8, 2.2, 10.0}) {
    for (int i = 0; i <= 100; ++i) {
      const auto value = static_cast<float>(i / 100.0);
      const long double exact =
          255 * std::pow(static_cast<long double>(value), 1 / static_cast<long double>(gamma));
      const auto level = static_cast<int>(std::floor(exact + 0.5L));
      CHECK(bytes_of({value, value, value}, gamma) == Pixel{level, level, level, 255});
    }
  }
  // 0.5 = 0.25^(1/2), which rounds up.
  CHECK(bytes_of({0.25, 0, 1}, 2) == Pixel{128, 0, 255, 255});
}

TEST_CASE("values out of range are clamped and what is not a number is black") {
  CHECK(bytes_of({1.5, -0.5, 1e30}) == Pixel{255, 0, 255, 255});
  CHECK(bytes_of({infinity, -infinity, std::nan("")}) == Pixel{255, 0, 0, 255});
  CHECK(bytes_of({1.5, -0.5, 1e30}, 2.2) == Pixel{255, 0, 255, 255});
  CHECK(bytes_of({0.5, 0.5, 0.5, std::nan("")}) == Pixel{0, 0, 0, 0});
  CHECK(bytes_of({0.5, 0.5, 0.5, -1}) == Pixel{0, 0, 0, 0});
  CHECK(bytes_of({0.5, 0.5, 0.5, 2}) == Pixel{128, 128, 128, 255});
}

TEST_CASE("alpha is straight in bytes and has no gamma") {
  CHECK(bytes_of({0.25, 0.5, 0, 0.5}) == Pixel{128, 255, 0, 128});
  CHECK(bytes_of({0.125, 0.5, 0, 0.5}, 2) == Pixel{128, 255, 0, 128});
  CHECK(bytes_of({0.25, 0.5, 0, 0}) == Pixel{0, 0, 0, 0});
}

TEST_CASE("show_clip paints pixels red in which a channel passes 1") {
  const Pixel red{255, 0, 0, 255};
  CHECK(bytes_of({0, 0, 1.01}, 1, true) == red);
  CHECK(bytes_of({1, 1, 1}, 1, true) == Pixel{255, 255, 255, 255});
  CHECK(bytes_of({0, 0, 1.01}, 1, false) == Pixel{0, 0, 255, 255});
  // One pixel is half covered by something too bright. The other is white whose alpha carries a
  // rounding.
  CHECK(bytes_of({0, 0.6, 0, 0.5}, 1, true) == red);
  CHECK(bytes_of({0.3, 0.3, 0.3, 0.29999998}, 1, true) == Pixel{255, 255, 255, 76});
}

namespace {

/// Returns the bytes of one pixel under settings.
Pixel bytes_under(const Color& color, const crt::Settings& settings) {
  Image image(1, 1);
  image.set(0, 0, color);
  image.set_settings(settings);
  const std::vector<std::uint8_t> bytes = image.to_rgba8();
  return {bytes[0], bytes[1], bytes[2], bytes[3]};
}

}  // namespace

TEST_CASE("an exposure of 1 shows what twice the light shows, at every level and alpha") {
  for (const crt::ToneMap map : {crt::ToneMap::none, crt::ToneMap::filmic}) {
    crt::Settings usual;
    usual.tone_map = map;
    crt::Settings brighter = usual;
    brighter.exposure = 1;
    for (int i = 0; i <= 1024; ++i) {
      const double c = i / 512.0;
      for (const double alpha : {1.0, 0.5})
        REQUIRE(bytes_under({c, c / 2, 2 * c, alpha}, brighter) ==
                bytes_under({2 * c, c, 4 * c, alpha}, usual));
    }
  }
}

TEST_CASE("bytes are what a display shows of each channel, rounded to the nearest level") {
  for (const crt::ToneMap map : {crt::ToneMap::none, crt::ToneMap::filmic}) {
    for (const double exposure : {-2.0, 0.0, 0.3, 4.0}) {
      for (const double gamma : {1.0, 2.2}) {
        crt::Settings settings;
        settings.tone_map = map;
        settings.exposure = exposure;
        settings.gamma = gamma;
        int before = 0;
        for (int i = 0; i <= 300; ++i) {
          const double c = double{static_cast<float>(i / 100.0)};
          const int level = bytes_under({c, 0, c, 1}, settings)[0];
          CHECK(level == static_cast<int>(std::floor(255 * crt::displayed(c, settings) + 0.5)));
          CHECK(level >= before);
          before = level;
        }
      }
    }
  }
  crt::Settings settings;
  settings.gamma = 2;
  settings.exposure = -1;
  CHECK(crt::displayed(0.5, settings) == doctest::Approx(0.5).epsilon(1e-15));
  CHECK(crt::displayed(4, settings) == 1);
  CHECK(crt::displayed(-1, settings) == 0);
  CHECK(crt::displayed(std::numeric_limits<double>::quiet_NaN(), settings) == 0);
}

TEST_CASE("clipping is marked where the display clips, after exposure and tone map") {
  const Pixel red = {255, 0, 0, 255};
  crt::Settings settings;
  settings.show_clip = true;
  settings.exposure = 1;
  CHECK(bytes_under({0.4, 0.51, 0.3}, settings) == red);
  CHECK(bytes_under({0.4, 0.5, 0.3}, settings) != red);
  settings.exposure = -1;
  CHECK(bytes_under({0.4, 1.9, 0.3}, settings) != red);
  CHECK(bytes_under({0.4, 2.1, 0.3}, settings) == red);
  settings.exposure = 0;
  settings.tone_map = crt::ToneMap::filmic;
  CHECK(bytes_under({0.4, 9.9, 0.3}, settings) != red);
  CHECK(bytes_under({0.4, 10.1, 0.3}, settings) == red);
  CHECK(bytes_under({0.2, 5.1, 0.1, 0.5}, settings) == red);
}

TEST_CASE("a picture that is as displays want it gets no second gamma, exposure and tone map") {
  Image image(1, 1);
  image.set(0, 0, {0.25, 0.5, 0.75});
  crt::Settings settings;
  settings.gamma = 2.2;
  settings.exposure = 1;
  settings.tone_map = crt::ToneMap::filmic;
  image.set_settings(settings);
  image.set_display_encoded(true);
  CHECK(image.to_rgba8() == std::vector<std::uint8_t>{64, 128, 191, 255});
}
