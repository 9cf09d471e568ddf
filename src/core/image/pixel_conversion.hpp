// From a picture's linear floats to what files hold.
#pragma once

#include <cstdint>
#include <vector>

#include "crt/image.hpp"

namespace crt::core {

/// What becomes of the colour where a pixel is not fully covered.
enum class AlphaMode {
  straight,    ///< the colour as if it were fully covered, with the alpha beside it
  over_black,  ///< the colour in front of black: for files without an alpha
};

/// 8-bit RGBA as displays want it (Image::to_rgba8).
std::vector<std::uint8_t> display_bytes(const Image& image, AlphaMode mode);

/// Linear floats with premultiplied alpha, 4 a pixel, all finite: what is not a number is 0, the
/// infinities are the largest floats.
std::vector<float> linear_floats(const Image& image);

/// The first three of every four values.
template <class Value>
std::vector<Value> without_alpha(const std::vector<Value>& rgba) {
  std::vector<Value> rgb;
  rgb.reserve(rgba.size() / 4 * 3);
  for (std::size_t i = 0; i < rgba.size(); i += 4)
    rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
  return rgb;
}

/// Whether any fourth value is below `full`.
template <class Value>
bool has_partial_alpha(const std::vector<Value>& rgba, Value full) {
  for (std::size_t i = 3; i < rgba.size(); i += 4) {
    if (rgba[i] < full) return true;
  }
  return false;
}

}  // namespace crt::core
