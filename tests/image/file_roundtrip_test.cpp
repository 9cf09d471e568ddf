#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "crt/error.hpp"
#include "crt/image.hpp"
#include "picture_files.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Returns a picture after it was written and read, both through files and through memory.
Image round_trip(const Image& image, const std::string& name) {
  const TemporaryDirectory directory;
  image.write(directory / name);
  CHECK(directory.entries() == 1);
  Image read = Image::read(directory / name);
  const Image decoded = Image::decode(file_bytes(directory / name), name);
  CHECK(std::equal(read.pixels().begin(), read.pixels().end(), decoded.pixels().begin(),
                   decoded.pixels().end()));
  CHECK(read.display_encoded() == decoded.display_encoded());
  REQUIRE(read.width() == image.width());
  REQUIRE(read.height() == image.height());
  return read;
}

/// Has files of 8 bits hold light as it is, so that they can be compared with it.
void store_light_as_it_is(Image& image) {
  Settings settings;
  settings.gamma = 1;
  image.set_settings(settings);
}

/// Returns the largest difference of a channel, alpha included.
double difference(const Image& a, const Image& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    most = std::max(most, std::abs(double{a.pixels()[i]} - double{b.pixels()[i]}));
  }
  return most;
}

}  // namespace

TEST_CASE("EXR keeps linear floats to the bit, beyond 0 and 1 too") {
  for (const bool with_alpha : {false, true}) {
    Image image = smooth_picture(67, 131, with_alpha);
    image.set(3, 5, {1000.5, -2.25, 1e-30, 1});
    Settings settings;
    settings.gamma = 2.2;
    image.set_settings(settings);
    const Image read = round_trip(image, "a.exr");
    CHECK_FALSE(read.display_encoded());
    CHECK(difference(read, image) == 0);
  }
}

TEST_CASE("exposure and tone map change 8-bit files, and no float file") {
  Image image = smooth_picture(20, 10);
  image.set(3, 5, {3.5, 0.25, 1e-3, 1});
  Image brighter = image;
  Settings settings;
  settings.exposure = 1.5;
  settings.tone_map = ToneMap::filmic;
  brighter.set_settings(settings);
  for (const char* name : {"a.exr", "a.hdr"}) {
    CAPTURE(name);
    CHECK(difference(round_trip(brighter, name), round_trip(image, name)) == 0);
  }
  for (const char* name : {"a.png", "a.tif", "a.bmp", "a.ppm"}) {
    CAPTURE(name);
    CHECK(round_trip(brighter, name).to_rgba8() == brighter.to_rgba8());
    CHECK(round_trip(brighter, name).to_rgba8() != image.to_rgba8());
  }
  const std::vector<std::uint8_t> jpeg = round_trip(brighter, "a.jpg").to_rgba8();
  const std::vector<std::uint8_t> shown = brighter.to_rgba8();
  double error = 0;
  for (std::size_t i = 0; i < shown.size(); ++i) error += std::abs(int{jpeg[i]} - int{shown[i]});
  CHECK(error / static_cast<double>(shown.size()) < 6);
}

TEST_CASE("EXR files hold 0 for what is not a number and the largest float for infinity") {
  Image image(1, 1);
  const double infinity = std::numeric_limits<double>::infinity();
  image.set(0, 0, {std::nan(""), infinity, -infinity, 1});
  const double most = double{std::numeric_limits<float>::max()};
  CHECK(round_trip(image, "a.exr").at(0, 0) == Color{0, most, -most, 1});
}

TEST_CASE("lossless 8-bit formats keep every level, with gamma applied once") {
  for (const char* name : {"a.png", "a.tif", "a.TIFF", "a.bmp", "a.ppm"}) {
    CAPTURE(name);
    Image image(256, 3);
    for (int x = 0; x < 256; ++x)
      for (int y = 0; y < 3; ++y) image.set(x, y, {x / 255.0, 1 - x / 255.0, y / 2.0});
    Settings settings;
    settings.gamma = 2.2;
    image.set_settings(settings);
    const Image read = round_trip(image, name);
    CHECK(read.display_encoded());
    CHECK(read.to_rgba8() == image.to_rgba8());
    CHECK(read.at(0, 0).g == 1);
    CHECK(read.at(1, 1).r ==
          double{static_cast<float>(image.to_rgba8()[std::size_t{4} * 257] / 255.0)});
  }
}

TEST_CASE("PNG and TIFF keep every level at every alpha") {
  for (const char* name : {"a.png", "a.tif"}) {
    CAPTURE(name);
    Image image(256, 256);
    store_light_as_it_is(image);
    for (int level = 0; level < 256; ++level)
      for (int alpha = 0; alpha < 256; ++alpha) {
        const double a = alpha / 255.0;
        image.set(level, alpha, {a * level / 255.0, 0, a, a});
      }
    const Image read = round_trip(image, name);
    CHECK(read.to_rgba8() == image.to_rgba8());
    CHECK(difference(read, image) < 1e-6);
  }
}

TEST_CASE("PNG keeps noise, which takes several chunks, and rows that only differ from the left") {
  Image noise(300, 200);
  std::uint32_t state = 1;
  for (float& value : noise.pixels()) {
    state = state * 1664525u + 1013904223u;  // Numerical Recipes, section 7.1
    value = static_cast<float>(state >> 24) / 255.0f;
  }
  for (std::size_t alpha = 3; alpha < noise.pixels().size(); alpha += 4) noise.pixels()[alpha] = 1;
  Image stripes(300, 200);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 300; ++x) stripes.set(x, y, {x / 300.0, 0.5, x % 2 == 0 ? 1.0 : 0.0});
  for (const Image& image : {noise, stripes}) {
    CHECK(round_trip(image, "a.png").to_rgba8() == image.to_rgba8());
  }
  CHECK(noise.encode("png").size() > std::size_t{2} << 16);
  CHECK(stripes.encode("png").size() < 300 * 200 / 10);
}

TEST_CASE("formats without an alpha get the colour in front of black") {
  for (const char* name : {"a.bmp", "a.ppm", "a.jpg"}) {
    CAPTURE(name);
    Image image(16, 16);
    store_light_as_it_is(image);
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) image.set(x, y, {0.2, 0.2, 0.2, 0.4});
    const Color color = round_trip(image, name).at(8, 8);
    CHECK(color.r == doctest::Approx(0.2).epsilon(0.01));
    CHECK(color.a == 1);
  }
}

TEST_CASE("JPEG comes close for a smooth picture") {
  Image image = smooth_picture(64, 48);
  store_light_as_it_is(image);
  const Image read = round_trip(image, "a.jpg");
  CHECK(read.display_encoded());
  CHECK(difference(read, image) < 6 / 255.0);
}

TEST_CASE("HDR keeps linear light to its eight bits of mantissa") {
  Image image = smooth_picture(40, 30);
  image.set(0, 0, {1000, 500, 250});
  const Image read = round_trip(image, "a.hdr");
  CHECK_FALSE(read.display_encoded());
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) {
      const Color wrote = image.at(x, y);
      const Color got = read.at(x, y);
      const double step = std::max({wrote.r, wrote.g, wrote.b}) / 128;
      REQUIRE(std::abs(got.r - wrote.r) <= step);
      REQUIRE(std::abs(got.g - wrote.g) <= step);
      REQUIRE(std::abs(got.b - wrote.b) <= step);
    }
}

TEST_CASE("pictures of one pixel, one row and one column survive in every format") {
  for (const char* name : {"a.png", "a.tif", "a.jpg", "a.bmp", "a.ppm", "a.exr", "a.hdr"}) {
    for (const auto& [width, height] : {std::pair{1, 1}, std::pair{33, 1}, std::pair{1, 100}}) {
      CAPTURE(name);
      Image image(width, height);
      store_light_as_it_is(image);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image.set(x, y, {0.5, 0.5, 0.5});
      CHECK(difference(round_trip(image, name), image) < 0.01);
    }
  }
}

TEST_CASE("an alpha is stored only where some pixel is not fully covered") {
  const TemporaryDirectory directory;
  smooth_picture(8, 8, false).write(directory / "rgb.png");
  smooth_picture(8, 8, true).write(directory / "rgba.png");
  // The colour type follows the signature, the chunk's length and name, both sizes and the depth.
  constexpr std::size_t color_type_at = 8 + 8 + 8 + 1;
  CHECK(file_text(directory / "rgb.png")[color_type_at] == 2);
  CHECK(file_text(directory / "rgba.png")[color_type_at] == 6);
  CHECK(Image::read(directory / "rgb.png").at(0, 0).a == 1);
}

TEST_CASE("what a file is called does not matter for reading it") {
  const TemporaryDirectory directory;
  smooth_picture(8, 8).write(directory / "a.png");
  std::filesystem::rename(directory / "a.png", directory / "a.exr");
  CHECK(Image::read(directory / "a.exr").width() == 8);
  CHECK(Image::decode(file_bytes(directory / "a.exr"), "no ending").width() == 8);
}

TEST_CASE("grey files become RGB, of 8 and 16 bits, with and without an alpha") {
  const Image grey8 = Image::decode(to_bytes("P5 2 1 255\n\x33\xcc"), "g.pgm");
  CHECK(grey8.display_encoded());
  CHECK(grey8.at(0, 0).r == doctest::Approx(0.2));
  CHECK(grey8.at(0, 0).b == grey8.at(0, 0).r);
  CHECK(grey8.at(1, 0).g == doctest::Approx(0.8));
  CHECK(grey8.at(1, 0).a == 1);

  const std::string row16 = {0, '\x12', '\x34', '\xff', '\xff'};
  const Image grey16 = Image::decode(png_by_hand(2, 1, 16, 0, row16), "g16.png");
  CHECK(grey16.display_encoded());
  CHECK(grey16.at(0, 0).g == doctest::Approx(0x1234 / 65535.0).epsilon(1e-6));
  CHECK(grey16.at(1, 0).b == 1);

  const std::string row_with_alpha = {0, '\x80', '\x80'};
  const Image grey_alpha = Image::decode(png_by_hand(1, 1, 8, 4, row_with_alpha), "ga.png");
  CHECK(grey_alpha.at(0, 0).a == doctest::Approx(128 / 255.0));
  CHECK(grey_alpha.at(0, 0).r == doctest::Approx(128 / 255.0 * 128 / 255.0));
  CHECK(grey_alpha.at(0, 0).g == grey_alpha.at(0, 0).r);
}

TEST_CASE("16-bit colours with a straight alpha are premultiplied without loss") {
  const std::string row = {0, '\xff', '\xff', 0, 0, 0, 1, '\x40', 0};
  const Color color = Image::decode(png_by_hand(1, 1, 16, 6, row), "c.png").at(0, 0);
  CHECK(color.a == doctest::Approx(16384 / 65535.0).epsilon(1e-6));
  CHECK(color.r == doctest::Approx(16384 / 65535.0).epsilon(1e-6));
  CHECK(color.g == 0);
  CHECK(color.b == doctest::Approx(1 / 65535.0 * (16384 / 65535.0)).epsilon(1e-5));
}

TEST_CASE("WebP files can be read") {
  const Image image = Image::decode(webp_pixel(), "a.webp");
  CHECK(image.display_encoded());
  CHECK(image.to_rgba8() == std::vector<std::uint8_t>{254, 128, 64, 255});
}

TEST_CASE("floats that are not finite become 0 when a file is read") {
  std::string text = "PF\n2 1\n-1.0\n";
  const float infinity = std::numeric_limits<float>::infinity();
  const std::array<float, 6> values = {std::nanf(""), 2.5f, -infinity, infinity, -0.5f, 0.25f};
  text.append(reinterpret_cast<const char*>(values.data()), sizeof values);
  const Image image = Image::decode(to_bytes(text), "a.pfm");
  CHECK_FALSE(image.display_encoded());
  CHECK(image.at(0, 0) == Color{0, 2.5, 0, 1});
  CHECK(image.at(1, 0) == Color{0, -0.5, 0.25, 1});
}

TEST_CASE(
    "the number of pixels of a file that are not finite is reported, and the place of the first") {
  Image image(5, 4);
  CHECK(round_trip(image, "a.exr").not_finite() == NotFiniteValues{});
  const float infinity = std::numeric_limits<float>::infinity();
  std::string text = "PF\n3 2\n-1.0\n";  // rows from the bottom
  std::vector<float> values(18, 0.5f);
  values[0] = infinity;        // (0, 1)
  values[1] = -infinity;       // the same pixel
  values[17] = std::nanf("");  // (2, 0)
  text.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
  const Image read = Image::decode(to_bytes(text), "sky.pfm");
  CHECK(read.not_finite() == NotFiniteValues{.file = "sky.pfm", .pixels = 2, .x = 2, .y = 0});
  CHECK(read.not_finite().message() ==
        "'sky.pfm' has 2 pixels with values that are not finite (NaN, infinity), the first at (2, "
        "0) from the "
        "top left: they count as 0");
  CHECK(read.at(2, 0) == Color{0.5, 0.5, 0, 1});
  CHECK(read.at(0, 1) == Color{0, 0, 0.5, 1});
}

TEST_CASE("the rows of every format come from the top") {
  for (const char* name : {"a.png", "a.tif", "a.jpg", "a.bmp", "a.ppm", "a.exr", "a.hdr"}) {
    CAPTURE(name);
    Image image(32, 32);
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 32; ++x) image.set(x, y, {1, 1, 1});
    const Image read = round_trip(image, name);
    CHECK(read.at(16, 2).g > 0.9);
    CHECK(read.at(16, 29).g < 0.1);
  }
}

TEST_CASE("a display-encoded picture becomes linear light in a file of floats") {
  Image image(1, 1);
  image.set(0, 0, {0.5, 0.25 * 0.5, 0, 0.5});
  image.set_display_encoded(true);
  Settings settings;
  settings.gamma = 2;
  image.set_settings(settings);
  CHECK(round_trip(image, "a.exr").at(0, 0) == Color{0.5, 0.5 * 0.0625, 0, 0.5});
}
