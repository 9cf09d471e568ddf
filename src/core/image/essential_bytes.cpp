#include "core/image/essential_bytes.hpp"

#include <utility>

#include "core/image/byte_order.hpp"
#include "core/image/image_limits.hpp"

namespace crt::core {

FileBytes essential_bytes(std::string_view format, FileBytes content, const SizeLimit& limit) {
  if (format == "png") return essential_png(content, limit);
  if (format == "jpeg") return essential_jpeg(content, limit);
  if (format == "tiff") return essential_tiff(std::move(content));
  if (format == "openexr") check_exr(content, limit);
  if (format == "bmp") check_bmp(content);
  if (format == "webp") check_webp(content, limit);
  return content;
}

void check_bmp(FileView content) {
  constexpr std::size_t header_size_at = 14;
  constexpr std::size_t compression_at = 30;
  constexpr std::uint64_t oldest_header_size = 12;  // it knows no compression
  if (content.size() < compression_at + 4) throw RefusedFile("it is cut short");
  if (little_endian(content.subspan(header_size_at, 4)) == oldest_header_size) return;
  if (little_endian(content.subspan(compression_at, 4)) != 0) {
    throw RefusedFile("BMP files with compression or bit masks are not supported");
  }
}

// Sources: Google, WebP Container Specification; RFC 6386, section 9.1 (lossy); WebP Lossless
// Bitstream Specification, section 3.
void check_webp(FileView content, const SizeLimit& limit) {
  constexpr std::size_t first_chunk_at = 12;
  constexpr std::size_t data_at = first_chunk_at + 8;  // behind the chunk's name and length
  constexpr std::size_t header_size = 10;              // the longest of the three
  constexpr std::uint64_t side_bits = 0x3fff;
  if (content.size() < data_at + header_size) throw RefusedFile("it is cut short");
  const std::string_view chunk(reinterpret_cast<const char*>(&content[first_chunk_at]), 4);
  const FileView data = content.subspan(data_at);
  if (chunk == "VP8X") {
    limit.check(1 + little_endian(data.subspan(4, 3)), 1 + little_endian(data.subspan(7, 3)));
  } else if (chunk == "VP8 ") {
    limit.check(little_endian(data.subspan(6, 2)) & side_bits,
                little_endian(data.subspan(8, 2)) & side_bits);
  } else if (chunk == "VP8L") {
    const std::uint64_t sides = little_endian(data.subspan(1, 4));
    limit.check(1 + (sides & side_bits), 1 + (sides >> 14 & side_bits));
  }
}

}  // namespace crt::core
