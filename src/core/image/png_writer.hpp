// PNG files are written here, so that the most usual pictures need no module and no OpenImageIO.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/image/file_texts.hpp"

namespace crt::core {

/// A BytePicture has rows of 8-bit pixels from the top, without gaps.
struct BytePicture {
  int width;
  int height;
  int channels;  ///< 3, or 4 with a straight alpha
  std::span<const std::uint8_t> bytes;
};

/// Returns a PNG file that holds the picture and the texts (under PNG's names for them).
std::vector<std::byte> png_file(const BytePicture& picture, const FileTexts& texts);

}  // namespace crt::core
