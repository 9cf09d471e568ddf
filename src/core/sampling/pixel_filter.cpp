#include "core/sampling/pixel_filter.hpp"

#include <cmath>
#include <crt/elementary.hpp>
#include <numbers>

namespace crt::core {

namespace {

/// Returns the share of the Blackman-Harris window up to x in [-1/2, 1/2], where the window ends.
/// Source: Harris, On the use of windows for harmonic analysis with the discrete Fourier transform,
/// Proceedings of the IEEE 66(1), 1978 (the minimum four-term window), integrated.
double blackman_harris_share(double x) {
  constexpr double constant = 0.35875;
  constexpr std::array<double, 3> waves = {0.48829, 0.14128, 0.01168};
  double integral = constant * (x + 0.5);
  for (std::size_t i = 0; i < waves.size(); ++i) {
    const double angular_frequency = 2 * std::numbers::pi * static_cast<double>(i + 1);
    integral += waves[i] * elementary::sin(angular_frequency * x) / angular_frequency;
  }
  return integral / constant;
}

/// Returns the x where the share is reached. The share increases with x throughout.
double blackman_harris_quantile(double share) {
  double low = -0.5;
  double high = 0.5;
  constexpr int bits = 53;
  for (int i = 0; i < bits; ++i) {
    const double middle = 0.5 * (low + high);
    (blackman_harris_share(middle) < share ? low : high) = middle;
  }
  return high;
}

}  // namespace

FilterPlaces::FilterPlaces(const Settings& settings)
    : is_box_(settings.filter == PixelFilter::box) {
  if (is_box_) return;
  constexpr double middle = 0.5;
  places_[0] = middle - 0.5 * settings.filter_width;
  for (std::size_t i = 1; i <= intervals / 2; ++i) {
    const double share = static_cast<double>(i) / double{intervals};
    places_[i] = middle + settings.filter_width * blackman_harris_quantile(share);
  }
  places_[intervals / 2] = middle;
  for (std::size_t i = intervals / 2 + 1; i <= intervals; ++i)
    places_[i] = 1 - places_[intervals - i];
}

}  // namespace crt::core
