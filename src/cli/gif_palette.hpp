// This reduces a picture to 256 colours.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace crt::cli {

/// A PalettePicture has 256 colours, of 3 bytes each, and the number of one for each pixel.
struct PalettePicture {
  std::array<std::uint8_t, std::size_t{3} * 256> colors{};
  std::vector<std::uint8_t> indices;
};

/// Reduces a picture of 3 bytes a pixel. A pattern of small differences hides the steps between
/// colours where there are more.
PalettePicture with_palette(const std::vector<std::uint8_t>& rgb, int width);

}  // namespace crt::cli
