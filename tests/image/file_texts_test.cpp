#include <doctest/doctest.h>

#include <map>
#include <string>

#include "crt/image.hpp"
#include "crt/version.hpp"
#include "picture_files.hpp"

using namespace crt;
using namespace crt::test;

namespace {

const std::string crt_version = std::string("CRT ") + version();

/// Returns the tEXt chunks of a PNG file. It also checks each chunk's sum.
std::map<std::string, std::string> png_texts(const std::string& file) {
  std::map<std::string, std::string> texts;
  REQUIRE(file.substr(0, 8) == png_signature);
  std::size_t at = 8;
  while (at < file.size()) {
    const std::size_t length = from_big_endian(std::string_view(file).substr(at));
    const std::string type_and_data = file.substr(at + 4, 4 + length);
    REQUIRE(from_big_endian(std::string_view(file).substr(at + 8 + length)) ==
            crc32(type_and_data));
    const std::string type = type_and_data.substr(0, 4);
    // Nothing in the file says the time by itself.
    CHECK(type != "tIME");
    if (type == "tEXt") {
      const std::string data = type_and_data.substr(4);
      const std::size_t zero = data.find('\0');
      CHECK(texts.emplace(data.substr(0, zero), data.substr(zero + 1)).second);
    }
    at += 12 + length;
  }
  return texts;
}

Image described_picture() {
  Image image = smooth_picture(8, 8);
  Settings settings;
  settings.title = "Still life";
  settings.author = "A. Painter";
  settings.date = "May 2003";
  settings.notes = "First line\nsecond line";
  settings.gamma = 2.2;
  settings.exposure = -0.5;
  settings.tone_map = ToneMap::filmic;
  settings.supersampling = 3;
  settings.dof_samples = 5;
  settings.recursion_depth = 7;
  settings.min_weight = 0.125;
  settings.falloff_model = FalloffModel::light;
  settings.ambient_model = AmbientModel::surface;
  settings.head_light = false;
  settings.seed = 18446744073709551615u;
  settings.precision = Precision::exact;
  settings.compat = compat_2015;
  image.set_settings(settings);
  image.stats().camera_rays = 576;
  image.stats().prepare_seconds = 0.25;
  image.stats().trace_seconds = 1.5;
  return image;
}

}  // namespace

TEST_CASE("a picture that was rendered pass by pass tells how near to the truth it is") {
  const TemporaryDirectory directory;
  Image image = smooth_picture(8, 8);
  Settings settings;
  settings.target_error = 0.25;
  settings.filter = PixelFilter::blackman_harris;
  image.set_settings(settings);
  image.stats().passes = 24;
  image.stats().samples_min = 16;
  image.stats().samples_mean = 17.5;
  image.stats().samples_max = 32;
  image.stats().half_width_rms = 0.125;
  image.stats().half_width_95 = 0.1875;
  image.stats().half_width_max = 0.5;
  image.stats().pixels_unresolved = 3;
  image.stats().unseen_share = 0.1875;
  image.stats().cutoff_max = 0.0625;
  image.write(directory / "a.png");
  const auto texts = png_texts(file_text(directory / "a.png"));
  const std::map<std::string, std::string> expected = {
      {"crt:targeterror", "0.25"},   {"crt:filter", "blackmanharris"},
      {"crt:filterwidth", "3"},      {"crt:passes", "24"},
      {"crt:samples", "16 17.5 32"}, {"crt:halfwidth", "0.125 0.1875 0.5"},
      {"crt:unresolvedpixels", "3"}, {"crt:unseenshare", "0.1875"},
      {"crt:cutoff", "0 0.0625"}};
  for (const auto& text : expected) {
    CAPTURE(text.first);
    CHECK(texts.at(text.first) == text.second);
  }
}

TEST_CASE("a PNG tells title, author, date, notes, software, settings and what the render did") {
  const TemporaryDirectory directory;
  described_picture().write(directory / "a.png");
  const std::map<std::string, std::string> expected = {{"Title", "Still life"},
                                                       {"Author", "A. Painter"},
                                                       {"Creation Time", "May 2003"},
                                                       {"Description", "First line\nsecond line"},
                                                       {"Software", crt_version},
                                                       {"crt:gamma", "2.2"},
                                                       {"crt:exposure", "-0.5"},
                                                       {"crt:tonemap", "filmic"},
                                                       {"crt:supersampling", "3"},
                                                       {"crt:dofsamples", "5"},
                                                       {"crt:recursiondepth", "7"},
                                                       {"crt:minweight", "0.125"},
                                                       {"crt:falloffmodel", "light"},
                                                       {"crt:ambientmodel", "surface"},
                                                       {"crt:headlight", "false"},
                                                       {"crt:showclip", "false"},
                                                       {"crt:seed", "18446744073709551615"},
                                                       {"crt:precision", "exact"},
                                                       {"crt:compat", "2015"},
                                                       {"crt:camerarays", "576"},
                                                       {"crt:renderseconds", "1.750"}};
  CHECK(png_texts(file_text(directory / "a.png")) == expected);
}

TEST_CASE("texts that are empty stay out of the file") {
  const TemporaryDirectory directory;
  smooth_picture(8, 8).write(directory / "a.png");
  const auto texts = png_texts(file_text(directory / "a.png"));
  for (const char* name :
       {"Title", "Author", "Creation Time", "Description", "crt:renderseconds", "crt:camerarays",
        "crt:exposure", "crt:tonemap", "crt:indirect", "crt:lightsamples", "crt:clamp"}) {
    CHECK(texts.count(name) == 0);
  }
  CHECK(texts.count("Software") == 1);
}

TEST_CASE("formats that know few names have the rest in their description") {
  const TemporaryDirectory directory;
  for (const char* name : {"a.tif", "a.jpg"}) {
    CAPTURE(name);
    described_picture().write(directory / name);
    const std::string file = file_text(directory / name);
    for (const std::string& part :
         {std::string("Still life"), std::string("A. Painter"),
          std::string("Creation Time: May 2003"), std::string("First line\nsecond line"),
          crt_version, std::string("crt:supersampling: 3")}) {
      CAPTURE(part);
      CHECK(file.find(part) != std::string::npos);
    }
  }
  described_picture().write(directory / "a.exr");
  const std::string file = file_text(directory / "a.exr");
  for (const char* part :
       {"Still life", "A. Painter", "May 2003", "First line\nsecond line", "crt:supersampling"}) {
    CHECK(file.find(part) != std::string::npos);
  }
}

TEST_CASE("long texts with any characters never make a picture unwritable") {
  const TemporaryDirectory directory;
  Image image = smooth_picture(4, 4);
  Settings settings;
  settings.title = "\xc3\xa9t\xc3\xa9 \xf0\x9f\x8e\xa8 % {} \\ \x01\x7f\xff";
  settings.notes = std::string(300000, 'n');
  image.set_settings(settings);
  for (const char* name : {"a.png", "a.tif", "a.jpg", "a.bmp", "a.ppm", "a.exr", "a.hdr"}) {
    CAPTURE(name);
    image.write(directory / name);
    CHECK(Image::read(directory / name).width() == 4);
  }
}

TEST_CASE("reproducible files are equal for equal pictures, whatever the render took") {
  const TemporaryDirectory directory;
  for (const char* name : {"a.png", "a.tif", "a.jpg", "a.bmp", "a.ppm", "a.exr", "a.hdr"}) {
    CAPTURE(name);
    Image image = described_picture();
    image.write(directory / name, {.reproducible = true});
    const std::string first = file_text(directory / name);
    image.stats().trace_seconds = 99;
    image.stats().threads = 7;
    image.stats().intersection_tests = 1234;
    image.write(directory / name, {.reproducible = true});
    CHECK(file_text(directory / name) == first);
    CHECK(first.find("renderseconds") == std::string::npos);
  }
}

TEST_CASE("no file tells the time of its writing") {
  const TemporaryDirectory directory;
  for (const char* name : {"a.png", "a.tif", "a.jpg", "a.exr", "a.hdr"}) {
    CAPTURE(name);
    described_picture().write(directory / name);
    // All of these formats give a time in this form: 2003:05:31 12:00:00, in any century.
    const std::string file = file_text(directory / name);
    bool found = false;
    for (std::size_t colon = file.find(':'); colon != std::string::npos;
         colon = file.find(':', colon + 1)) {
      const auto digit = [&](std::size_t at) {
        return at < file.size() && file[at] >= '0' && file[at] <= '9';
      };
      found = found || (colon >= 4 && digit(colon - 4) && digit(colon - 1) && digit(colon + 1) &&
                        digit(colon + 2) && colon + 3 < file.size() && file[colon + 3] == ':' &&
                        digit(colon + 4));
    }
    CHECK_FALSE(found);
  }
}
