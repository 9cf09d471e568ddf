// These tests read EXR files with channels beside the colours by OpenImageIO: names, types, and
// every number to the bit.
#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <bit>
#include <limits>
#include <string>
#include <vector>

#include "../picture_files.hpp"
#include "crt/image.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr int width = 5;
constexpr int height = 130;  // more than what is written at once
constexpr std::size_t pixel_count = std::size_t{width} * height;

/// Makes a channel of floats whose numbers all differ. Some of them are hard to keep.
ImageChannel floats(const std::string& name, float first) {
  std::vector<float> values(pixel_count);
  for (std::size_t i = 0; i < pixel_count; ++i) values[i] = first + static_cast<float>(i) / 7;
  values[1] = std::numeric_limits<float>::infinity();
  values[2] = -0.0f;
  values[3] = std::numeric_limits<float>::denorm_min();
  return {name, values};
}

/// Makes a channel of whole numbers over their whole range.
ImageChannel integers(const std::string& name) {
  std::vector<std::uint32_t> values(pixel_count);
  for (std::size_t i = 0; i < pixel_count; ++i)
    values[i] = 0xffffffffu - static_cast<std::uint32_t>(i) * 16777619u;
  return {name, values};
}

/// Content is what a file holds: each number as the four bytes that it is, channel by channel.
struct Content {
  OIIO::ImageSpec spec;
  std::vector<std::uint32_t> numbers;

  std::vector<std::uint32_t> channel(const std::string& name) const {
    const int index = spec.channelindex(name);
    REQUIRE(index >= 0);
    std::vector<std::uint32_t> values;
    const auto stride = static_cast<std::size_t>(spec.nchannels);
    for (std::size_t at = static_cast<std::size_t>(index); at < numbers.size(); at += stride) {
      values.push_back(numbers[at]);
    }
    return values;
  }
};

Content content_of(const std::string& path) {
  const auto input = OIIO::ImageInput::open(path);
  REQUIRE(input);
  Content content{input->spec(), {}};
  content.numbers.resize(content.spec.image_bytes(true) / sizeof(std::uint32_t));
  REQUIRE(input->read_image(0, 0, 0, -1, OIIO::TypeDesc::UNKNOWN, content.numbers.data()));
  return content;
}

std::vector<std::uint32_t> bits_of(const ImageChannel& channel) {
  if (const auto* whole = std::get_if<std::vector<std::uint32_t>>(&channel.values)) return *whole;
  std::vector<std::uint32_t> bits;
  for (const float value : std::get<std::vector<float>>(channel.values)) {
    bits.push_back(std::bit_cast<std::uint32_t>(value));
  }
  return bits;
}

}  // namespace

TEST_CASE("an EXR file has each channel under its name, with its type, to the bit") {
  for (const bool with_alpha : {false, true}) {
    CAPTURE(with_alpha);
    Image image = smooth_picture(width, height, with_alpha);
    image.set_channels({floats("Z", 3), integers("id"), floats("N.X", -1), floats("N.Y", 0.25f),
                        floats("N.Z", 8), floats("albedo.R", 0),
                        floats("a-long-layer.name.G", 1e30f), integers("samples")});
    const TemporaryDirectory directory;
    const std::string path = (directory / "a.exr").string();
    image.write(path);
    const Content content = content_of(path);
    CHECK(content.spec.nchannels == (with_alpha ? 12 : 11));
    for (const ImageChannel& channel : image.channels()) {
      CAPTURE(channel.name);
      CHECK(content.channel(channel.name) == bits_of(channel));
      const bool whole = std::holds_alternative<std::vector<std::uint32_t>>(channel.values);
      CHECK(content.spec.channelformat(content.spec.channelindex(channel.name)) ==
            (whole ? OIIO::TypeUInt32 : OIIO::TypeFloat));
    }
    const std::string colors = with_alpha ? "RGBA" : "RGB";
    for (std::size_t i = 0; i < colors.size(); ++i) {
      std::vector<float> values;
      for (std::size_t at = i; at < image.pixels().size(); at += 4)
        values.push_back(image.pixels()[at]);
      CHECK(content.channel(colors.substr(i, 1)) == bits_of({"", values}));
    }
  }
}
