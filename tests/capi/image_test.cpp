// These tests move images in and out of memory and files.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "support.hpp"

using namespace crt::test;
namespace fs = std::filesystem;

namespace {

/// A Scratch is a folder that is removed with it.
class Scratch {
 public:
  Scratch() : path_(fs::temp_directory_path() / ("crt-capi-" + process())) {
    fs::create_directories(path_);
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  static std::string process() { return fs::read_symlink("/proc/self").string(); }
  fs::path path_;
};

ImageHandle from_pixels(std::uint32_t width, std::uint32_t height, const float* pixels,
                        std::size_t stride = 0) {
  return made<ImageHandle>(
      [&](crt_image** out) { return crt_image_create(width, height, pixels, stride, out); });
}

ImageHandle decoded(const crt_buffer* buffer) {
  return made<ImageHandle>([&](crt_image** out) {
    return crt_image_decode(crt_buffer_data(buffer), crt_buffer_size(buffer), nullptr, out);
  });
}

BufferHandle encoded(const crt_image* image, const char* format) {
  return made<BufferHandle>(
      [&](crt_buffer** out) { return crt_image_encode(image, format, nullptr, out); });
}

}  // namespace

TEST_CASE(
    "the number of pixels of a file that are not finite is reported, and the place of the first") {
  std::string file = "PF\n2 1\n-1.0\n";
  const float values[] = {1, 1, 1, 0, NAN, INFINITY};
  file.append(reinterpret_cast<const char*>(values), sizeof values);
  const ImageHandle image = made<ImageHandle>(
      [&](crt_image** out) { return crt_image_decode(file.data(), file.size(), "a.pfm", out); });
  std::uint32_t x = 7;
  std::uint32_t y = 7;
  CHECK(crt_image_not_finite(image.get(), &x, &y) == 1);
  CHECK(x == 1);
  CHECK(y == 0);
  CHECK(crt_image_not_finite(image.get(), nullptr, nullptr) == 1);
  CHECK(crt_image_not_finite(nullptr, &x, &y) == 0);
  const float one[4] = {1, 1, 1, 1};
  CHECK(crt_image_not_finite(from_pixels(1, 1, one).get(), nullptr, nullptr) == 0);
}

TEST_CASE("an image is made from rows with gaps and lends its pixels without") {
  const float rows[] = {1, 2, 3, 1, 9, 9, 4, 5, 6, 0.5f, 9, 9};
  const ImageHandle image = from_pixels(1, 2, rows, 6 * sizeof(float));
  std::size_t stride = 0;
  const float* const pixels = crt_image_pixels(image.get(), &stride);
  CHECK(stride == 16);
  CHECK(std::vector<float>(pixels, pixels + 8) == std::vector<float>{1, 2, 3, 1, 4, 5, 6, 0.5f});
  CHECK(crt_image_pixels(image.get(), nullptr) == pixels);
  float bad[4] = {0, 0, std::numeric_limits<float>::infinity(), 1};
  crt_image* none = nullptr;
  CHECK(crt_image_create(1, 1, bad, 0, &none) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("pixels"));
  CHECK(none == nullptr);
}

TEST_CASE("8-bit pixels come back as they were") {
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < 256; ++i) {
    for (const int value : {i, 255 - i, i / 2, 255})
      bytes.push_back(static_cast<std::uint8_t>(value));
  }
  const ImageHandle image = made<ImageHandle>(
      [&](crt_image** out) { return crt_image_from_rgba8(16, 16, bytes.data(), 0, out); });
  std::vector<std::uint8_t> back(bytes.size());
  REQUIRE(crt_image_to_rgba8(image.get(), back.data(), 0) == CRT_OK);
  CHECK(back == bytes);
  // Rows of the caller's with gaps between them keep what is in the gaps.
  std::vector<std::uint8_t> wide(16 * 70, 0xaa);
  REQUIRE(crt_image_to_rgba8(image.get(), wide.data(), 70) == CRT_OK);
  CHECK(std::memcmp(&wide[70], &bytes[64], 64) == 0);
  CHECK(wide[64] == 0xaa);
  const BufferHandle png = encoded(image.get(), "png");
  const ImageHandle again = decoded(png.get());
  REQUIRE(crt_image_to_rgba8(again.get(), back.data(), 0) == CRT_OK);
  CHECK(back == bytes);
}

TEST_CASE("floats go through EXR unchanged, in memory and in a file") {
  const Scratch scratch;
  const float pixels[8] = {0.1f, 25, 1e-6f, 1, 0.25f, 0.5f, 0, 0.5f};
  const ImageHandle image = from_pixels(2, 1, pixels);
  const BufferHandle exr = encoded(image.get(), "exr");
  CHECK(std::memcmp(crt_image_pixels(decoded(exr.get()).get(), nullptr), pixels, sizeof pixels) ==
        0);
  const std::string file = scratch.file("x.exr");
  REQUIRE(crt_image_write(image.get(), file.c_str()) == CRT_OK);
  const ImageHandle read =
      made<ImageHandle>([&](crt_image** out) { return crt_image_read(file.c_str(), out); });
  CHECK(std::memcmp(crt_image_pixels(read.get(), nullptr), pixels, sizeof pixels) == 0);
}

TEST_CASE("what cannot be read or written says why, and leaves no file") {
  const Scratch scratch;
  const float pixel[4] = {1, 1, 1, 1};
  const ImageHandle image = from_pixels(1, 1, pixel);
  crt_image* none = nullptr;
  crt_buffer* no_buffer = nullptr;
  CHECK(crt_image_read(scratch.file("none.png").c_str(), &none) == CRT_ERROR_IO);
  CHECK(says("none.png"));
  CHECK(crt_image_decode("GIF89a nonsense", 15, "some.gif", &none) == CRT_ERROR_IO);
  CHECK(says("some.gif"));
  CHECK(crt_image_write(image.get(), scratch.file("x.webm").c_str()) == CRT_ERROR_UNSUPPORTED);
  CHECK(crt_image_encode(image.get(), "", nullptr, &no_buffer) == CRT_ERROR_UNSUPPORTED);
  CHECK(crt_image_encode(image.get(), "gif", nullptr, &no_buffer) == CRT_ERROR_UNSUPPORTED);
  CHECK(crt_image_write(image.get(), scratch.file("no/such/folder.png").c_str()) == CRT_ERROR_IO);
  CHECK(none == nullptr);
  CHECK(no_buffer == nullptr);
  CHECK(fs::is_empty(fs::path(scratch.file(".")).parent_path()));
}

TEST_CASE("files of equal pictures are equal bytes if they are to be") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  crt_write_options options;
  REQUIRE(crt_write_options_init(&options, sizeof options) == CRT_OK);
  options.reproducible = 1;
  std::vector<std::string> files;
  for (int i = 0; i < 2; ++i) {
    const ImageHandle image = render(prepared.get());
    const BufferHandle file = made<BufferHandle>(
        [&](crt_buffer** out) { return crt_image_encode(image.get(), "png", &options, out); });
    files.emplace_back(static_cast<const char*>(crt_buffer_data(file.get())),
                       crt_buffer_size(file.get()));
  }
  CHECK(files[0] == files[1]);
  CHECK(files[0].substr(1, 3) == "PNG");
}

TEST_CASE("an image takes other settings without changing its pixels") {
  const float pixel[4] = {0.25f, 0.25f, 0.25f, 1};
  const ImageHandle image = from_pixels(1, 1, pixel);
  crt_settings settings;
  settings.struct_size = sizeof settings;
  REQUIRE(crt_image_settings(image.get(), &settings) == CRT_OK);
  CHECK(settings.gamma == 2.2);
  settings.gamma = 1;
  const ImageHandle darker = made<ImageHandle>(
      [&](crt_image** out) { return crt_image_with_settings(image.get(), &settings, out); });
  std::uint8_t before[4];
  std::uint8_t after[4];
  REQUIRE(crt_image_to_rgba8(image.get(), before, 0) == CRT_OK);
  REQUIRE(crt_image_to_rgba8(darker.get(), after, 0) == CRT_OK);
  CHECK(before[0] == 136);  // 255 * 0.25^(1 / 2.2)
  CHECK(after[0] == 64);
  CHECK(crt_image_pixels(darker.get(), nullptr)[0] == 0.25f);
  settings.exposure = 1;
  const ImageHandle exposed = made<ImageHandle>(
      [&](crt_image** out) { return crt_image_with_settings(image.get(), &settings, out); });
  REQUIRE(crt_image_to_rgba8(exposed.get(), after, 0) == CRT_OK);
  CHECK(after[0] == 128);
  settings.exposure = 0;
  settings.tone_map = CRT_TONE_MAP_FILMIC;
  const ImageHandle toned = made<ImageHandle>(
      [&](crt_image** out) { return crt_image_with_settings(image.get(), &settings, out); });
  REQUIRE(crt_image_to_rgba8(toned.get(), after, 0) == CRT_OK);
  CHECK(after[0] == 68);  // 255 f(0.72317 * 0.25)
}

TEST_CASE("an image lends the channels that were asked for, by name") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  crt_render_options options;
  REQUIRE(crt_render_options_init(&options, sizeof options) == CRT_OK);
  options.aovs = CRT_AOV_DEPTH | CRT_AOV_NORMAL | CRT_AOV_ID | CRT_AOV_ALBEDO;
  const ImageHandle image = render(prepared.get(), &options);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < crt_image_channel_count(image.get()); ++i) {
    names.emplace_back(crt_image_channel_name(image.get(), i));
  }
  std::sort(names.begin(), names.end());
  CHECK(names == std::vector<std::string>{"N.X", "N.Y", "N.Z", "Z", "albedo.B", "albedo.G",
                                          "albedo.R", "id"});
  CHECK(crt_image_channel_name(image.get(), names.size()) == nullptr);
  CHECK(crt_image_channel(image.get(), "id") == nullptr);
  CHECK(crt_image_channel_uint(image.get(), "Z") == nullptr);

  // This is what a ray through the same place hits. The camera is the default one.
  const float* const depth = crt_image_channel(image.get(), "Z");
  const std::uint32_t* const id = crt_image_channel_uint(image.get(), "id");
  const double half_height = std::tan(std::acos(-1.0) / 6);
  std::size_t hits = 0;
  for (std::size_t y = 0; y < 30; ++y) {
    for (std::size_t x = 0; x < 40; ++x) {
      const double across = (2 * (static_cast<double>(x) + 0.5) / 40 - 1) * half_height * 40 / 30;
      const double up = (1 - 2 * (static_cast<double>(y) + 0.5) / 30) * half_height;
      const crt_ray ray = {{0, 0, -1}, {across, up, 1}, 0, infinity};
      crt_hit hit;
      REQUIRE(crt_intersect(prepared.get(), &ray, 0, 1, &hit, 0) == CRT_OK);
      const std::size_t pixel = y * 40 + x;
      const bool found = hit.t < infinity;
      hits += found ? 1 : 0;
      CHECK(id[pixel] == (found ? hit.entity_id : UINT32_MAX));
      const double distance = hit.t * std::sqrt(across * across + up * up + 1);
      CHECK((found ? std::abs(double{depth[pixel]} - distance) <= 1e-6 * distance
                   : depth[pixel] == infinity));
    }
  }
  CHECK(hits > 100);
}

TEST_CASE("an image without further channels has none, and bits that no AOV has are refused") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  crt_render_options options;
  REQUIRE(crt_render_options_init(&options, sizeof options) == CRT_OK);
  const ImageHandle plain = render(prepared.get(), &options);
  CHECK(crt_image_channel_count(plain.get()) == 0);
  CHECK(crt_image_channel(plain.get(), "Z") == nullptr);
  CHECK(crt_image_channel(plain.get(), nullptr) == nullptr);
  CHECK(crt_image_channel_count(nullptr) == 0);
  CHECK(crt_image_channel_name(nullptr, 0) == nullptr);
  CHECK(crt_image_channel(nullptr, "Z") == nullptr);
  CHECK(crt_image_channel_uint(nullptr, "id") == nullptr);
  options.aovs = 1u << 31;
  crt_image* none = nullptr;
  CHECK(crt_render(prepared.get(), &options, &none) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("aovs"));
  CHECK(none == nullptr);
}

TEST_CASE("further channels go into an EXR file, and into others not unless they are left out") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  crt_render_options options;
  REQUIRE(crt_render_options_init(&options, sizeof options) == CRT_OK);
  options.aovs = CRT_AOV_DEPTH;
  const ImageHandle image = render(prepared.get(), &options);
  crt_write_options write;
  REQUIRE(crt_write_options_init(&write, sizeof write) == CRT_OK);
  crt_buffer* none = nullptr;
  CHECK(crt_image_encode(image.get(), "png", &write, &none) == CRT_ERROR_UNSUPPORTED);
  CHECK(none == nullptr);
  CHECK_NOTHROW(encoded(image.get(), "exr"));
  write.colors_only = 1;
  const BufferHandle picture = made<BufferHandle>(
      [&](crt_buffer** out) { return crt_image_encode(image.get(), "png", &write, out); });
  CHECK(crt_image_width(decoded(picture.get()).get()) == 40);
}
