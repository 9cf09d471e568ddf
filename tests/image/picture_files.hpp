// The tests of image files share this: a directory that is removed, pictures, and files made by
// hand.
#pragma once

#include <stdlib.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "crt/image.hpp"
#include "support/temporary_directory.hpp"

namespace crt::test {

using Bytes = std::vector<std::byte>;

inline Bytes to_bytes(std::string_view text) {
  const auto* const first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

inline std::string file_text(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline Bytes file_bytes(const std::filesystem::path& path) {
  return to_bytes(file_text(path));
}

/// Makes a picture whose channels all vary smoothly.
inline Image smooth_picture(int width, int height, bool with_alpha = false) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double a = with_alpha ? (x + 1.0) / (width + 1) : 1.0;
      image.set(x, y, {a * x / width, a * y / height, a * (x + y) / (width + height), a});
    }
  return image;
}

// ---- PNG by hand, after its specification (W3C, Portable Network Graphics, 2nd edition) --------

inline std::string big_endian(std::uint32_t value) {
  std::string text;
  for (const int shift : {24, 16, 8, 0}) text += static_cast<char>(value >> shift & 0xff);
  return text;
}

inline std::uint32_t from_big_endian(std::string_view text) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(text[i]);
  return value;
}

inline std::uint32_t crc32(std::string_view text) {
  std::uint32_t crc = 0xffffffffu;
  for (const char c : text) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xedb88320u : 0);
  }
  return ~crc;
}

inline constexpr std::string_view png_signature = "\x89PNG\r\n\x1a\n";

inline std::string png_chunk(const std::string& type, const std::string& data) {
  return big_endian(static_cast<std::uint32_t>(data.size())) + type + data +
         big_endian(crc32(type + data));
}

/// Returns a zlib stream of one block that is not compressed.
inline std::string zlib_stored(const std::string& data) {
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const char c : data) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const auto length = static_cast<std::uint32_t>(data.size());
  const auto low_high = [](std::uint32_t value) {
    return std::string{static_cast<char>(value & 0xff), static_cast<char>(value >> 8 & 0xff)};
  };
  return std::string("\x78\x01\x01") + low_high(length) + low_high(~length) + data +
         big_endian(b << 16 | a);
}

/// Returns a PNG file. `rows` holds the samples of all rows, each row after a 0 for "no filter".
inline Bytes png_by_hand(std::uint32_t width, std::uint32_t height, int bit_depth, int color_type,
                         const std::string& rows) {
  const std::string header = big_endian(width) + big_endian(height) + static_cast<char>(bit_depth) +
                             static_cast<char>(color_type) + std::string(3, '\0');
  return to_bytes(std::string(png_signature) + png_chunk("IHDR", header) +
                  png_chunk("IDAT", zlib_stored(rows)) + png_chunk("IEND", ""));
}

/// Returns a WebP file of one pixel without loss, (254, 128, 64).
inline Bytes webp_pixel() {
  using namespace std::string_view_literals;
  return to_bytes("RIFF\x18\0\0\0WEBPVP8L\x0c\0\0\0\x2f\0\0\0\0\x28\x60\xfd\x0b\xd4\xff\0"sv);
}

}  // namespace crt::test
