// The format is that of the PNG specification (ISO/IEC 15948). Chapters are named where they
// matter.
#include "core/image/png_writer.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>

#include "core/image/checksum.hpp"
#include "core/image/packer.hpp"

namespace crt::core {

namespace {

using Bytes = std::vector<std::uint8_t>;

void append_number(Bytes& to, std::uint32_t number) {
  for (const int shift : {24, 16, 8, 0}) to.push_back(static_cast<std::uint8_t>(number >> shift));
}

/// Appends a chunk: its length, name, content and check sum (chapter 5.3).
void append_chunk(Bytes& file, std::string_view name, std::span<const std::uint8_t> content) {
  append_number(file, static_cast<std::uint32_t>(content.size()));
  const std::size_t summed_from = file.size();
  file.insert(file.end(), name.begin(), name.end());
  file.insert(file.end(), content.begin(), content.end());
  append_number(file, checksum(std::as_bytes(std::span(file).subspan(summed_from))));
}

void append_header(Bytes& file, const BytePicture& picture) {
  constexpr std::uint8_t bits = 8;
  constexpr std::uint8_t rgb = 2;
  constexpr std::uint8_t rgb_with_alpha = 6;
  Bytes header;
  append_number(header, static_cast<std::uint32_t>(picture.width));
  append_number(header, static_cast<std::uint32_t>(picture.height));
  header.insert(header.end(), {bits, picture.channels == 4 ? rgb_with_alpha : rgb, 0, 0, 0});
  append_chunk(file, "IHDR", header);
}

/// Returns the keyword that PNG has for a text (chapter 11.3.4.2).
std::string_view png_keyword(std::string_view name) {
  if (name == "DocumentName") return "Title";
  if (name == "Artist") return "Author";
  if (name == "ImageDescription") return "Description";
  return name;
}

/// Appends texts: as Latin-1 where they are plain ASCII, else as UTF-8 (chapter 11.3.3).
void append_texts(Bytes& file, const FileTexts& texts) {
  for (const auto& [name, value] : texts) {
    const std::string_view keyword = png_keyword(name);
    Bytes content(keyword.begin(), keyword.end());
    content.push_back(0);
    const auto is_ascii = [](char c) { return static_cast<unsigned char>(c) < 0x80; };
    const bool is_plain = std::all_of(value.begin(), value.end(), is_ascii);
    // It is not compressed, and of no named language.
    if (!is_plain) content.insert(content.end(), 4, 0);
    // A text ends at its first zero.
    content.insert(content.end(), value.begin(), std::find(value.begin(), value.end(), '\0'));
    append_chunk(file, is_plain ? "tEXt" : "iTXt", content);
  }
}

/// Filters rows: what is packed is the difference of each byte from a guess (chapter 9).
class RowFilter {
 public:
  RowFilter(std::size_t row_bytes, std::size_t pixel_bytes)
      : pixel_bytes_(pixel_bytes), best_(1 + row_bytes), tried_(1 + row_bytes) {}

  /// Returns the filter's number and the filtered row. `above` is empty for the first row. Of the
  /// five filters it takes the one whose differences, as signed numbers, are least (chapter 12.8).
  std::span<const std::uint8_t> filtered(std::span<const std::uint8_t> row,
                                         std::span<const std::uint8_t> above) {
    std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
    for (std::uint8_t filter = 0; filter < filters; ++filter) {
      const std::uint64_t sum = apply(filter, row, above);
      if (sum >= least) continue;
      least = sum;
      std::swap(best_, tried_);
    }
    return best_;
  }

 private:
  static constexpr std::uint8_t filters = 5;

  std::uint64_t apply(std::uint8_t filter, std::span<const std::uint8_t> row,
                      std::span<const std::uint8_t> above) {
    tried_[0] = filter;
    switch (filter) {
      case 1:
        return subtract(row, above, [](int left, int, int) { return left; });
      case 2:
        return subtract(row, above, [](int, int up, int) { return up; });
      case 3:
        return subtract(row, above, [](int left, int up, int) { return (left + up) / 2; });
      case 4:
        return subtract(row, above, paeth);
      default:
        return subtract(row, above, [](int, int, int) { return 0; });
    }
  }

  /// Tries a guess, and returns the sum of the differences from it.
  template <class Guess>
  std::uint64_t subtract(std::span<const std::uint8_t> row, std::span<const std::uint8_t> above,
                         const Guess& guess) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const int left = i < pixel_bytes_ ? 0 : row[i - pixel_bytes_];
      const int up = above.empty() ? 0 : above[i];
      const int corner = i < pixel_bytes_ || above.empty() ? 0 : above[i - pixel_bytes_];
      const auto difference = static_cast<std::uint8_t>(row[i] - guess(left, up, corner));
      tried_[1 + i] = difference;
      sum += static_cast<std::uint64_t>(std::abs(static_cast<std::int8_t>(difference)));
    }
    return sum;
  }

  /// Returns the one of three that is nearest to left + up - corner (chapter 9.4).
  static int paeth(int left, int up, int corner) {
    const int to_left = std::abs(up - corner);
    const int to_up = std::abs(left - corner);
    const int to_corner = std::abs(left + up - 2 * corner);
    if (to_left <= to_up && to_left <= to_corner) return left;
    return to_up <= to_corner ? up : corner;
  }

  std::size_t pixel_bytes_;
  Bytes best_;
  Bytes tried_;
};

void append_pixels(Bytes& file, const BytePicture& picture) {
  const auto pixel_bytes = static_cast<std::size_t>(picture.channels);
  const std::size_t row_bytes = static_cast<std::size_t>(picture.width) * pixel_bytes;
  RowFilter filter(row_bytes, pixel_bytes);
  Packer packer([&](std::span<const std::uint8_t> packed) { append_chunk(file, "IDAT", packed); });
  std::span<const std::uint8_t> above;
  for (std::size_t y = 0; y < static_cast<std::size_t>(picture.height); ++y) {
    const std::span<const std::uint8_t> row = picture.bytes.subspan(y * row_bytes, row_bytes);
    packer.add(filter.filtered(row, above));
    above = row;
  }
  packer.finish();
}

}  // namespace

std::vector<std::byte> png_file(const BytePicture& picture, const FileTexts& texts) {
  constexpr std::array<std::uint8_t, 8> signature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  Bytes file(signature.begin(), signature.end());
  append_header(file, picture);
  append_texts(file, texts);
  append_pixels(file, picture);
  append_chunk(file, "IEND", {});
  const auto* const first = reinterpret_cast<const std::byte*>(file.data());
  return {first, first + file.size()};
}

}  // namespace crt::core
