#include "core/image/pixel_conversion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace crt::core {

namespace {

/// In [0, 1]; 0 for what is not a number.
double clamped(double value) {
  return value > 0 ? std::min(value, 1.0) : 0.0;
}

/// The nearest of 256 levels to a value in [0, 1]; halves go up.
std::uint8_t nearest_level(double value) {
  return static_cast<std::uint8_t>(std::floor(value * 255 + 0.5));
}

/// Whether a channel is past what a display can show. A colour divided by its alpha carries a few
/// roundings of floats, which are not meant.
bool clips(double value) {
  constexpr double rounding = 0x1p-20;
  return value > 1 + rounding;
}

constexpr std::array<std::uint8_t, 4> clip_mark = {255, 0, 0, 255};

}  // namespace

std::vector<std::uint8_t> display_bytes(const Image& image, AlphaMode mode) {
  const double exponent = image.display_encoded() ? 1.0 : 1 / image.settings().gamma;
  const bool show_clip = image.settings().show_clip;
  const std::span<const float> pixels = image.pixels();
  std::vector<std::uint8_t> bytes(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); i += 4) {
    const double alpha = clamped(double{pixels[i + 3]});
    bool clipped = false;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const double covered = double{pixels[i + channel]};
      const double whole = alpha > 0 ? covered / alpha : 0.0;
      const double level = clamped(mode == AlphaMode::straight ? whole : covered);
      bytes[i + channel] = nearest_level(exponent == 1 ? level : std::pow(level, exponent));
      clipped = clipped || clips(whole);
    }
    bytes[i + 3] = nearest_level(alpha);
    if (show_clip && clipped)
      std::copy(clip_mark.begin(), clip_mark.end(), bytes.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return bytes;
}

std::vector<float> linear_floats(const Image& image) {
  constexpr float largest = std::numeric_limits<float>::max();
  const double gamma = image.display_encoded() ? image.settings().gamma : 1.0;
  const std::span<const float> pixels = image.pixels();
  std::vector<float> floats(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); i += 4) {
    const double alpha = clamped(double{pixels[i + 3]});
    for (std::size_t channel = 0; channel < 3; ++channel) {
      float value = pixels[i + channel];
      if (gamma != 1 && alpha > 0 && value > 0) {
        value = static_cast<float>(std::min(double{largest}, std::pow(double{value} / alpha, gamma) * alpha));
      }
      floats[i + channel] = std::isnan(value) ? 0.0f : std::clamp(value, -largest, largest);
    }
    floats[i + 3] = static_cast<float>(alpha);
  }
  return floats;
}

}  // namespace crt::core
