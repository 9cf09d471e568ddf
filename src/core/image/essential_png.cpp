// A PNG file is a list of chunks with checksums.
//
// Source: W3C, Portable Network Graphics, 2nd edition, chapter 5.
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "core/image/byte_order.hpp"
#include "core/image/checksum.hpp"
#include "core/image/essential_bytes.hpp"
#include "core/image/image_limits.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

bool is_letter(std::byte byte) {
  const auto lower = std::to_integer<unsigned>(byte) | 0x20u;
  return lower >= 'a' && lower <= 'z';
}

/// Returns whether a chunk must not be skipped by readers that do not know it. The names of such
/// chunks begin with a capital.
bool is_critical(const std::string& name) {
  return name[0] >= 'A' && name[0] <= 'Z';
}

bool is_needed(const std::string& name) {
  constexpr std::array<std::string_view, 5> needed = {"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};
  return std::find(needed.begin(), needed.end(), name) != needed.end();
}

}  // namespace

FileBytes essential_png(FileView content, const SizeLimit& limit) {
  constexpr std::size_t signature_size = 8;
  constexpr std::size_t length_size = 4;
  constexpr std::size_t name_size = 4;
  constexpr std::size_t frame_size = length_size + name_size + 4;  // the last is the checksum
  const FileView signature = content.first(std::min(signature_size, content.size()));
  FileBytes result(signature.begin(), signature.end());
  FileView rest = content.subspan(signature.size());
  while (rest.size() >= frame_size) {
    const std::size_t length = big_endian(rest.first(length_size));
    if (length > rest.size() - frame_size) break;
    const FileView chunk = rest.first(frame_size + length);
    const FileView summed = chunk.subspan(length_size, name_size + length);
    if (!std::all_of(summed.begin(), summed.begin() + name_size, is_letter)) {
      throw RefusedFile("it is damaged: a chunk has no proper name");
    }
    const std::string name(reinterpret_cast<const char*>(summed.data()), name_size);
    if (checksum(summed) != big_endian(chunk.last(4))) {
      throw RefusedFile(text::format("it is damaged: the checksum of its chunk {} is wrong", name));
    }
    const FileView data = summed.subspan(name_size);
    if (name == "IHDR" && data.size() >= 8) {
      limit.check(big_endian(data.first(4)), big_endian(data.subspan(4, 4)));
    }
    if (is_needed(name)) {
      result.insert(result.end(), chunk.begin(), chunk.end());
    } else if (is_critical(name)) {
      throw RefusedFile(text::format("its chunk {} is not known", name));
    }
    if (name == "IEND") return result;
    rest = rest.subspan(chunk.size());
  }
  throw RefusedFile("it is cut short");
}

}  // namespace crt::core
