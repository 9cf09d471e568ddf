// A TIFF file has directories of tagged entries.
//
// Sources: Adobe, TIFF revision 6.0, section 2 (structure) and appendix A (tags); the BigTIFF
// design of the TIFF library, which widens counts and offsets to 8 bytes.
#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "core/image/byte_order.hpp"
#include "core/image/essential_bytes.hpp"

namespace crt::core {

namespace {

/// These tags say how to get pixels from the data. They are in ascending order.
constexpr auto pixel_tags = std::to_array<std::uint64_t>({
    254,    // NewSubfileType
    256,    // ImageWidth
    257,    // ImageLength
    258,    // BitsPerSample
    259,    // Compression
    262,    // PhotometricInterpretation
    266,    // FillOrder
    273,    // StripOffsets
    274,    // Orientation
    277,    // SamplesPerPixel
    278,    // RowsPerStrip
    279,    // StripByteCounts
    284,    // PlanarConfiguration
    292,    // T4Options
    293,    // T6Options
    317,    // Predictor
    320,    // ColorMap
    322,    // TileWidth
    323,    // TileLength
    324,    // TileOffsets
    325,    // TileByteCounts
    332,    // InkSet
    334,    // NumberOfInks
    336,    // DotRange
    338,    // ExtraSamples
    339,    // SampleFormat
    340,    // SMinSampleValue
    341,    // SMaxSampleValue
    347,    // JPEGTables
    512,    // JPEGProc
    513,    // JPEGInterchangeFormat
    514,    // JPEGInterchangeFormatLength
    515,    // JPEGRestartInterval
    517,    // JPEGLosslessPredictors
    518,    // JPEGPointTransforms
    519,    // JPEGQTables
    520,    // JPEGDCTables
    521,    // JPEGACTables
    529,    // YCbCrCoefficients
    530,    // YCbCrSubSampling
    531,    // YCbCrPositioning
    532,    // ReferenceBlackWhite
    32995,  // Matteing, an older ExtraSamples
    32996,  // DataType, an older SampleFormat
});

/// A Layout says where the parts of a file's first directory are, in bytes. BigTIFF differs in
/// widths alone.
struct Layout {
  std::size_t first_offset_at;
  std::size_t count_size;
  std::size_t entry_size;
  std::size_t offset_size;
};

constexpr Layout classic = {
    .first_offset_at = 4, .count_size = 2, .entry_size = 12, .offset_size = 4};
constexpr Layout big = {.first_offset_at = 8, .count_size = 8, .entry_size = 20, .offset_size = 8};

}  // namespace

FileBytes essential_tiff(FileBytes content) {
  constexpr std::size_t tag_size = 2;
  if (content.size() < 16) throw RefusedFile("it is cut short");
  const bool little = content[0] == std::byte{'I'};
  const auto number = [&](std::size_t at, std::size_t size) {
    const FileView bytes = FileView(content).subspan(at, size);
    return little ? little_endian(bytes) : big_endian(bytes);
  };
  constexpr std::uint64_t big_version = 43;
  const Layout& layout = number(2, 2) == big_version ? big : classic;

  const std::uint64_t directory = number(layout.first_offset_at, layout.offset_size);
  if (directory > content.size() - layout.count_size) throw RefusedFile("it is cut short");
  const std::uint64_t count = number(directory, layout.count_size);
  const std::size_t entries = directory + layout.count_size;
  if (count > (content.size() - entries) / layout.entry_size ||
      count * layout.entry_size + layout.offset_size > content.size() - entries) {
    throw RefusedFile("it is cut short");
  }

  // The entries that stay move up, and the directory ends after them. No other picture follows.
  std::uint64_t kept = 0;
  for (std::uint64_t entry = 0; entry < count; ++entry) {
    const std::size_t from = entries + entry * layout.entry_size;
    if (!std::binary_search(pixel_tags.begin(), pixel_tags.end(), number(from, tag_size))) continue;
    std::copy_n(content.begin() + static_cast<std::ptrdiff_t>(from), layout.entry_size,
                content.begin() + static_cast<std::ptrdiff_t>(entries + kept * layout.entry_size));
    ++kept;
  }
  for (std::size_t i = 0; i < layout.count_size; ++i) {
    const std::size_t shift = 8 * (little ? i : layout.count_size - 1 - i);
    content[directory + i] = static_cast<std::byte>(kept >> shift & 0xff);
  }
  std::fill_n(content.begin() + static_cast<std::ptrdiff_t>(entries + kept * layout.entry_size),
              layout.offset_size, std::byte{0});
  return content;
}

}  // namespace crt::core
