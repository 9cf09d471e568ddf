#include "core/image/essential_bytes.hpp"

#include <utility>

#include "core/image/byte_order.hpp"

namespace crt::core {

FileBytes essential_bytes(std::string_view format, FileBytes content) {
  if (format == "png") return essential_png(content);
  if (format == "jpeg") return essential_jpeg(content);
  if (format == "tiff") return essential_tiff(std::move(content));
  if (format == "openexr") check_exr(content);
  if (format == "bmp") check_bmp(content);
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

}  // namespace crt::core
