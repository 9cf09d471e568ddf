// These tests check channels beside the colours, in memory and on their path into files.
// (OpenImageIO's own tool reads in tests/cli what EXR files then hold.)
#include <doctest/doctest.h>

#include <string>
#include <variant>

#include "crt/error.hpp"
#include "crt/image.hpp"
#include "picture_files.hpp"

using namespace crt;
using namespace crt::test;

namespace {

ImageChannel floats(const std::string& name, std::size_t count, float value = 0) {
  return {name, std::vector<float>(count, value)};
}

ImageChannel integers(const std::string& name, std::size_t count, std::uint32_t value = 0) {
  return {name, std::vector<std::uint32_t>(count, value)};
}

Image with_channels() {
  Image image = smooth_picture(5, 70);
  image.set_channels(
      {floats("Z", 350, 1.5f), integers("id", 350, 4000000007u), floats("N.X", 350, -1)});
  return image;
}

ErrorCode code_of_write(const Image& image, const std::string& ending,
                        const WriteOptions& options = {}) {
  try {
    image.encode(ending, options);
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::internal;
}

}  // namespace

TEST_CASE("a channel is found by its name and type") {
  Image image = with_channels();
  CHECK(image.channel("Z").size() == 350);
  CHECK(image.channel("Z")[349] == 1.5f);
  CHECK(image.integer_channel("id")[7] == 4000000007u);
  CHECK(image.channel("id").empty());
  CHECK(image.integer_channel("Z").empty());
  CHECK(image.channel("z").empty());
  image.channel("Z")[3] = 9;
  CHECK(std::get<std::vector<float>>(image.channels()[0].values)[3] == 9);
}

TEST_CASE("a channel needs a name of its own and a number for each pixel") {
  Image image(2, 2);
  const std::string longest(255, 'x');
  CHECK_NOTHROW(image.set_channels({floats("a", 4), floats("A.a", 4), floats(longest, 4)}));
  for (const std::string& name :
       {std::string(), std::string("R"), std::string("A"), std::string("two words"),
        std::string("\xc3\xa4"), std::string("a\n"), longest + "x"}) {
    CAPTURE(name);
    CHECK_THROWS_AS(image.set_channels({floats(name, 4)}), Error);
  }
  CHECK_THROWS_AS(image.set_channels({floats("a", 4), integers("a", 4)}), Error);
  CHECK_THROWS_AS(image.set_channels({floats("a", 3)}), Error);
  CHECK_THROWS_AS(image.set_channels({integers("a", 5)}), Error);
  CHECK(image.channels().size() == 3);
}

TEST_CASE("EXR files hold the channels, and their colours are read as if there were none") {
  const Image image = with_channels();
  Image plain = image;
  plain.set_channels({});
  const Bytes content = image.encode("exr", {.reproducible = true});
  CHECK(content.size() > plain.encode("exr", {.reproducible = true}).size());
  const Image read = Image::decode(content, "a.exr");
  CHECK(read.display_encoded() == false);
  CHECK(read.width() == 5);
  CHECK(std::equal(read.pixels().begin(), read.pixels().end(), image.pixels().begin()));
  CHECK(image.encode("exr", {.reproducible = true, .colors_only = true}) ==
        plain.encode("exr", {.reproducible = true}));
}

TEST_CASE("other formats refuse channels, unless colours are all that is wanted") {
  const Image image = with_channels();
  for (const char* ending : {"png", "tif", "jpg", "bmp", "ppm", "hdr"}) {
    CAPTURE(ending);
    CHECK(code_of_write(image, ending) == ErrorCode::unsupported);
    Image plain = image;
    plain.set_channels({});
    CHECK(image.encode(ending, {.reproducible = true, .colors_only = true}) ==
          plain.encode(ending, {.reproducible = true}));
  }
  try {
    image.encode("png");
  } catch (const Error& error) {
    CHECK(std::string(error.what()).find("'Z'") != std::string::npos);
    CHECK(std::string(error.what()).find("exr") != std::string::npos);
  }
}
