// Source: W3C, Portable Network Graphics, 2nd edition, chapter 5 (chunks) and annex D (their sums).
#include "core/image/file_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace crt::core {

namespace {

constexpr std::array<std::uint32_t, 256> make_crc_table() {
  constexpr std::uint32_t polynomial = 0xedb88320u;
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? polynomial : 0);
    table[byte] = crc;
  }
  return table;
}

std::uint32_t crc32(std::span<const std::byte> bytes) {
  static constexpr std::array<std::uint32_t, 256> table = make_crc_table();
  std::uint32_t crc = 0xffffffffu;
  for (const std::byte byte : bytes)
    crc = table[(crc ^ std::to_integer<std::uint32_t>(byte)) & 0xff] ^ crc >> 8;
  return ~crc;
}

std::uint32_t big_endian(std::span<const std::byte> bytes) {
  std::uint32_t value = 0;
  for (const std::byte byte : bytes.first(4)) value = value << 8 | std::to_integer<std::uint32_t>(byte);
  return value;
}

std::uint32_t little_endian(std::span<const std::byte> bytes) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i)
    value = value << 8 | std::to_integer<std::uint32_t>(bytes[static_cast<std::size_t>(i)]);
  return value;
}

bool is_letter(std::byte byte) {
  const auto lower = std::to_integer<unsigned>(byte) | 0x20u;
  return lower >= 'a' && lower <= 'z';
}

/// What is wrong with the chunks of a PNG file.
std::string png_damage(std::span<const std::byte> content) {
  constexpr std::size_t signature_size = 8;
  constexpr std::size_t type_size = 4;
  constexpr std::size_t frame_size = 12;  // length, type and sum
  std::span<const std::byte> rest = content.subspan(std::min(signature_size, content.size()));
  while (rest.size() >= frame_size) {
    const std::size_t length = big_endian(rest);
    if (length > rest.size() - frame_size) break;
    const std::span<const std::byte> type_and_data = rest.subspan(4, type_size + length);
    const std::span<const std::byte> type = type_and_data.first(type_size);
    if (!std::all_of(type.begin(), type.end(), is_letter)) return "it is damaged: a chunk has no proper name";
    const std::string name(reinterpret_cast<const char*>(type.data()), type_size);
    if (crc32(type_and_data) != big_endian(rest.subspan(4 + type_size + length))) {
      return fmt::format("it is damaged: the checksum of its chunk {} is wrong", name);
    }
    if (name == "IEND") return {};
    rest = rest.subspan(frame_size + length);
  }
  return "it is cut short";
}

/// BMP files are read only where each pixel has its place.
std::string bmp_damage(std::span<const std::byte> content) {
  constexpr std::size_t header_size_at = 14;
  constexpr std::size_t compression_at = 30;
  constexpr std::uint32_t oldest_header_size = 12;  // it knows no compression
  if (content.size() < compression_at + 4) return "it is cut short";
  if (little_endian(content.subspan(header_size_at)) == oldest_header_size) return {};
  const bool compressed = little_endian(content.subspan(compression_at)) != 0;
  return compressed ? "BMP files with compression or bit masks are not supported" : "";
}

}  // namespace

std::string reason_to_refuse(std::string_view format, std::span<const std::byte> content) {
  if (format == "png") return png_damage(content);
  if (format == "bmp") return bmp_damage(content);
  return {};
}

}  // namespace crt::core
