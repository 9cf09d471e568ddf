// These tests read files that are missing, broken, cut short or made to harm.
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <random>
#include <string>
#include <vector>

#include "crt/error.hpp"
#include "crt/image_limits.hpp"
#include "picture_files.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Returns the message of the Error (io) that decoding throws, or an empty text if it throws none.
std::string decode_error(const Bytes& content, const std::string& name = "some.name") {
  try {
    Image::decode(content, name);
    return {};
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::io);
    CHECK(std::string(error.what()).find(name) != std::string::npos);
    return error.what();
  }
}

std::string read_error(const std::filesystem::path& path) {
  try {
    Image::read(path);
    return {};
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::io);
    CHECK(std::string(error.what()).find(path.string()) != std::string::npos);
    return error.what();
  }
}

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

/// Returns a PNG file whose damage its checksums do not show.
Bytes with_right_checksums(const Bytes& content) {
  std::string text(reinterpret_cast<const char*>(content.data()), content.size());
  for (std::size_t at = 8; at + 12 <= text.size();) {
    const std::size_t length = from_big_endian(std::string_view(text).substr(at));
    if (length > text.size() - at - 12) break;
    text.replace(at + 8 + length, 4,
                 big_endian(crc32(std::string_view(text).substr(at + 4, 4 + length))));
    at += 12 + length;
  }
  return to_bytes(text);
}

struct NamedFile {
  std::string name;
  Bytes content;
};

/// Returns a valid file of every format that can be read.
std::vector<NamedFile> sound_files() {
  const TemporaryDirectory directory;
  std::vector<NamedFile> files;
  for (const char* name : {"a.png", "a.tif", "a.jpg", "a.bmp", "a.ppm", "a.exr", "a.hdr"}) {
    smooth_picture(40, 70, std::string(name) == "a.png" || std::string(name) == "a.exr")
        .write(directory / name);
    files.push_back({name, file_bytes(directory / name)});
  }
  files.push_back({"a.webp", webp_pixel()});
  return files;
}

}  // namespace

TEST_CASE("a missing file, a directory and a pipe are errors that say so") {
  const TemporaryDirectory directory;
  CHECK(contains(read_error(directory / "nothing.png"), "No such file"));
  CHECK(contains(read_error(directory.path()), "directory"));
  REQUIRE(mkfifo((directory / "pipe.png").c_str(), 0600) == 0);
  CHECK(contains(read_error(directory / "pipe.png"), "not a regular file"));
}

TEST_CASE("what is no image is an error that lists what can be read") {
  CHECK(contains(decode_error({}), "empty"));
  CHECK(contains(decode_error(to_bytes("hello")), "PNG, JPEG, EXR"));
  CHECK(contains(decode_error(to_bytes("P")), "PNG, JPEG, EXR"));
  CHECK(contains(decode_error(to_bytes("GIF89a")), "PNG, JPEG, EXR"));
  CHECK(contains(decode_error(Bytes(1000)), "PNG, JPEG, EXR"));
}

TEST_CASE("a file of any format that is cut to half, or to its first bytes, is an error") {
  for (const NamedFile& file : sound_files()) {
    const Bytes& content = file.content;
    CAPTURE(file.name);
    CHECK(decode_error(content).empty());
    for (const std::size_t length :
         {content.size() / 2, content.size() * 3 / 4, std::size_t{16}, std::size_t{9}}) {
      CAPTURE(length);
      CHECK_FALSE(
          decode_error({content.begin(), content.begin() + static_cast<std::ptrdiff_t>(length)})
              .empty());
    }
  }
}

TEST_CASE("a PNG with a wrong checksum, a nameless chunk or no end is refused") {
  const Bytes sound = png_by_hand(1, 1, 8, 0, std::string(2, '\0'));
  CHECK(decode_error(sound).empty());
  constexpr std::size_t header_at = 8;
  Bytes damaged = sound;
  damaged[header_at + 8] ^= std::byte{1};
  CHECK(contains(decode_error(damaged), "checksum of its chunk IHDR"));
  damaged = sound;
  damaged[header_at + 4] = std::byte{7};
  CHECK(contains(decode_error(damaged), "no proper name"));
  constexpr std::size_t end_chunk_size = 12;
  CHECK(contains(decode_error({sound.begin(), sound.end() - end_chunk_size}), "cut short"));
}

TEST_CASE("an EXR header that claims what no file of its length can hold is refused") {
  const TemporaryDirectory directory;
  smooth_picture(40, 70).write(directory / "a.exr");
  const Bytes sound = file_bytes(directory / "a.exr");
  const std::string text = file_text(directory / "a.exr");
  // This is the name and type of the attribute with their zeros, its size, then the corner that is
  // nearest to 0.
  const std::size_t far_corner = text.find("dataWindow") + 11 + 6 + 4 + 8;
  for (const std::size_t coordinate : {far_corner, far_corner + 4}) {
    for (const int most : {0x7f, 0xff}) {
      Bytes damaged = sound;
      damaged[coordinate + 3] = static_cast<std::byte>(most);
      CHECK(contains(decode_error(damaged), "impossible size"));
    }
  }
}

TEST_CASE("metadata of any kind and damage to it do not matter for the pixels") {
  const TemporaryDirectory directory;
  Image image = smooth_picture(16, 16);
  Settings settings;
  settings.notes = std::string(300, 'n');
  image.set_settings(settings);
  for (const char* name : {"a.png", "a.tif", "a.jpg"}) {
    CAPTURE(name);
    image.write(directory / name);
    const Bytes sound = file_bytes(directory / name);
    const std::string text = file_text(directory / name);
    Bytes damaged = sound;
    for (std::size_t at = text.find("nnnn"); at != std::string::npos;
         at = text.find("nnnn", at + 300)) {
      for (std::size_t i = 0; i < 200; ++i) damaged[at + i] = std::byte{0x1c};
    }
    if (std::string(name) == "a.png") damaged = with_right_checksums(damaged);
    REQUIRE(damaged != sound);
    CHECK(Image::decode(damaged, name).to_rgba8() == Image::decode(sound, name).to_rgba8());
  }
}

TEST_CASE("a run-length encoded BMP is refused") {
  const TemporaryDirectory directory;
  smooth_picture(4, 4).write(directory / "a.bmp");
  Bytes content = file_bytes(directory / "a.bmp");
  CHECK(decode_error(content).empty());
  content[30] = std::byte{1};
  CHECK(contains(decode_error(content), "compression"));
}

TEST_CASE("a header that claims a huge picture is refused before anything is allocated for it") {
  const std::string rows(100, '\0');
  CHECK(decode_error(png_by_hand(2, 2, 8, 2, std::string(14, '\0'))).empty());
  CHECK(contains(decode_error(png_by_hand(65536, 65536, 8, 2, rows)), "65536 x 65536"));
  CHECK_FALSE(decode_error(png_by_hand(0x7fffffff, 0x7fffffff, 8, 2, rows)).empty());
  CHECK_FALSE(decode_error(png_by_hand(0x80000000, 1, 8, 2, rows)).empty());
  CHECK_FALSE(decode_error(png_by_hand(0, 1, 8, 2, rows)).empty());
  CHECK_FALSE(decode_error(to_bytes("P6 2000000000 2000000000 255\nxyz")).empty());
  CHECK_FALSE(decode_error(to_bytes("P6 99999999999999999999 1 255\nxyz")).empty());
  CHECK_FALSE(decode_error(to_bytes("PF\n1000000 1000000\n-1.0\n0000")).empty());
  CHECK_FALSE(
      decode_error(to_bytes("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1000000 +X 1000000\n"))
          .empty());
}

TEST_CASE("a tall claim with few bytes behind it is an error soon") {
  // 2^27 pixels are legal, but the data for them is missing.
  CHECK_FALSE(decode_error(png_by_hand(16384, 8192, 8, 2, std::string(100, '\0'))).empty());
  CHECK_FALSE(decode_error(to_bytes("P6 1024 131072 255\nxyz")).empty());
}

TEST_CASE("a picture of more pixels than the caller allows is refused by its header") {
  const auto refusal = [](const Bytes& content, std::uint64_t most_pixels) -> std::string {
    try {
      decode_image(content, "a picture", most_pixels);
      return {};
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::limit);
      return error.what();
    }
  };
  const TemporaryDirectory directory;
  for (const auto& [name, content] : sound_files()) {
    CAPTURE(name);
    const bool is_pixel = name == "a.webp";
    if (!is_pixel) CHECK(contains(refusal(content, 2799), "40 x 70 pixels; the limit is 2799"));
    CHECK(refusal(content, is_pixel ? 1 : 2800).empty());
  }
  // There is next to nothing to decode.
  CHECK(contains(refusal(png_by_hand(16384, 8192, 8, 2, std::string(100, '\0')), 1'000'000),
                 "16384 x 8192 pixels; the limit is 1000000"));
  using namespace std::string_view_literals;
  const std::string_view lossy =
      "RIFF\x1e\0\0\0WEBPVP8 \x12\0\0\0\0\0\0\x9d\x01\x2a\x10\x27\x20\x4e\0\0\0\0\0\0\0\0"sv;
  CHECK(contains(refusal(to_bytes(lossy), 1'000'000), "10000 x 3616 pixels"));
  const std::string_view extended =
      "RIFF\x16\0\0\0WEBPVP8X\x0a\0\0\0\0\0\0\0\x0f\x27\0\x0f\x27\0\0\0\0\0"sv;
  CHECK(contains(refusal(to_bytes(extended), 1'000'000), "10000 x 10000 pixels"));
}

TEST_CASE("a progressive JPEG that claims 4 gigapixels is refused before its scans are read") {
  const TemporaryDirectory directory;
  smooth_picture(40, 70).write(directory / "a.jpg");
  std::string text = file_text(directory / "a.jpg");
  const std::size_t frame = text.find("\xff\xc0");
  REQUIRE(frame != std::string::npos);
  text[frame + 1] = '\xc2';
  text.replace(frame + 5, 4, "\xff\xdc\xff\xdc");
  CHECK(contains(decode_error(to_bytes(text)), "65500 x 65500 pixels; the limit is"));
}

TEST_CASE("pictures may take a quarter of the memory that the process may have") {
  CHECK(affordable_image_pixels() > 0);
  CHECK(affordable_image_pixels() <= most_image_pixels);
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_AS, &before) == 0);
  if (before.rlim_cur != RLIM_INFINITY || affordable_image_pixels() < most_image_pixels) return;
  rlimit less = before;
  less.rlim_cur = rlim_t{4} << 30;
  REQUIRE(setrlimit(RLIMIT_AS, &less) == 0);
  const std::uint64_t pixels = affordable_image_pixels();
  REQUIRE(setrlimit(RLIMIT_AS, &before) == 0);
  CHECK(pixels == std::uint64_t{1} << 26);
}

TEST_CASE("damaged files of every format are read or refused, and nothing worse") {
  std::mt19937 random(1);
  for (const auto& [name, content] : sound_files()) {
    for (int round = 0; round < 150; ++round) {
      Bytes damaged = content;
      const int changes = 1 + static_cast<int>(random() % 8);
      // Headers hold what is most dangerous, so they are damaged here.
      const std::size_t reach =
          round % 2 == 0 ? std::min<std::size_t>(damaged.size(), 300) : damaged.size();
      for (int i = 0; i < changes; ++i)
        damaged[random() % reach] = static_cast<std::byte>(random());
      if (name == "a.png" && round % 3 == 0) damaged = with_right_checksums(damaged);
      try {
        const Image image = Image::decode(damaged, name);
        REQUIRE_FALSE(image.empty());
      } catch (const Error& error) {
        const bool expected =
            error.code() == ErrorCode::io || error.code() == ErrorCode::out_of_memory;
        REQUIRE(expected);
      }
    }
  }
}
