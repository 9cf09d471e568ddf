// A picture's linear floats are converted to what files hold.
#pragma once

#include <cstdint>
#include <vector>

#include "crt/image.hpp"

namespace crt::core {

/// Says what happens to the colour where a pixel is not fully covered.
enum class AlphaMode {
  straight,    ///< the colour as if it were fully covered, with the alpha beside it
  over_black,  ///< the colour in front of black, for files without an alpha
};

/// Returns what a display shows of a channel of linear light (crt::displayed).
double displayed(double light, const Settings& settings);

/// Returns 8-bit RGBA as displays want it (Image::to_rgba8).
std::vector<std::uint8_t> display_bytes(const Image& image, AlphaMode mode);

/// Returns linear floats with premultiplied alpha, 4 a pixel, all finite. NaN becomes 0, and the
/// infinities become the largest floats.
std::vector<float> linear_floats(const Image& image);

/// Returns the first three of every four values.
template <class Value>
std::vector<Value> without_alpha(const std::vector<Value>& rgba) {
  std::vector<Value> rgb;
  rgb.reserve(rgba.size() / 4 * 3);
  for (std::size_t i = 0; i < rgba.size(); i += 4)
    rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
  return rgb;
}

/// Returns whether any fourth value is below `full`.
template <class Value>
bool has_partial_alpha(const std::vector<Value>& rgba, Value full) {
  for (std::size_t i = 3; i < rgba.size(); i += 4) {
    if (rgba[i] < full) return true;
  }
  return false;
}

}  // namespace crt::core
