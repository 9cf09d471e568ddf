#include "core/image/pixel_conversion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "core/math/power.hpp"
#include "core/math/tone_curve.hpp"

namespace crt::core {

namespace {

/// Returns the value clamped to [0, 1], or 0 for NaN.
template <class Real>
Real clamped(const Real& value) {
  return select(value > 0.0, min(value, broadcast<Real>(1)), Real{});
}

/// This covers a few roundings of floats. Colours have them that were divided by their alpha or
/// raised to a power.
constexpr double float_rounding = 0x1p-20;

/// A Levels gives values in [0, 1] one of 256 levels.
class Levels {
 public:
  explicit Levels(int compat)
      : factor_(compat == compat_2015 ? 255 * (1 + float_rounding) : 255),
        shift_(compat == compat_2015 ? 0 : 0.5) {}

  /// Returns the nearest level, and of two equally near ones the upper. In 2015 it is the level
  /// below, but for what rounding has taken from values that are a level.
  Lanes operator()(const Lanes& values) const { return floor(values * factor_ + shift_); }

 private:
  double factor_;
  double shift_;
};

/// Returns where a channel is above what a display can show.
LaneMask clips(const Lanes& values) {
  return values > 1 + float_rounding;
}

constexpr std::array<std::uint8_t, 4> clip_mark = {255, 0, 0, 255};

/// Returns the bytes of display_bytes(). `tone` brings light to what is shown, but for gamma.
template <class Tone>
std::vector<std::uint8_t> toned_bytes(const Image& image, AlphaMode mode, const Tone& tone) {
  const double exponent = image.display_encoded() ? 1.0 : 1 / image.settings().gamma;
  const bool show_clip = image.settings().show_clip;
  const Levels levels_of(image.settings().compat);
  const std::span<const float> pixels = image.pixels();
  std::vector<std::uint8_t> bytes(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); i += 4) {
    const double alpha = clamped(double{pixels[i + 3]});
    const Lanes covered = lanes_of(pixels[i], pixels[i + 1], pixels[i + 2], 0);
    const Lanes whole = tone(alpha > 0 ? covered / alpha : Lanes{});
    Lanes levels = clamped(mode == AlphaMode::straight ? whole : tone(covered));
    if (exponent != 1) levels = power(levels, lanes_of(exponent));
    levels[3] = alpha;
    levels = levels_of(levels);
    for (std::size_t channel = 0; channel < lane_count; ++channel) {
      bytes[i + channel] = static_cast<std::uint8_t>(levels[channel]);
    }
    if (show_clip && any(clips(whole)))
      std::copy(clip_mark.begin(), clip_mark.end(), bytes.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return bytes;
}

}  // namespace

double displayed(double light, const Settings& settings) {
  const double level = clamped(ToneCurve(settings)(light));
  return settings.gamma == 1 ? level : power(level, 1 / settings.gamma);
}

std::vector<std::uint8_t> display_bytes(const Image& image, AlphaMode mode) {
  const ToneCurve tone(image.settings());
  if (!image.display_encoded() && !tone.is_identity()) return toned_bytes(image, mode, tone);
  return toned_bytes(image, mode, [](const Lanes& light) { return light; });
}

std::vector<float> linear_floats(const Image& image) {
  constexpr double largest = std::numeric_limits<float>::max();
  const double gamma = image.display_encoded() ? image.settings().gamma : 1.0;
  const std::span<const float> pixels = image.pixels();
  std::vector<float> floats(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); i += 4) {
    const double alpha = clamped(double{pixels[i + 3]});
    Lanes values = lanes_of(pixels[i], pixels[i + 1], pixels[i + 2], alpha);
    if (gamma != 1 && alpha > 0) {
      const Lanes light = alpha * power(max(Lanes{}, values / alpha), lanes_of(gamma));
      values = select(values > 0.0, light, values);
      values[3] = alpha;
    }
    const LaneMask are_numbers = values > 0.0 || values <= 0.0;
    values = select(are_numbers, clamp(values, lanes_of(-largest), lanes_of(largest)), Lanes{});
    const FloatLanes in_range = to_floats(values);
    for (std::size_t channel = 0; channel < lane_count; ++channel) {
      floats[i + channel] = in_range[channel];
    }
  }
  return floats;
}

}  // namespace crt::core
