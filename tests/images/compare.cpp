#include "images/compare.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

namespace crt::tests {

namespace {

/// Returns how much red, green, blue and alpha of the pixel that starts at byte `i` differ.
int largest_step(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b,
                 std::size_t i) {
  int largest = 0;
  for (std::size_t channel = i; channel < i + 4; ++channel) {
    largest = std::max(largest, std::abs(a[channel] - b[channel]));
  }
  return largest;
}

}  // namespace

Difference compare(const Image& picture, const Image& reference) {
  Difference difference;
  difference.same_size =
      picture.width() == reference.width() && picture.height() == reference.height();
  if (!difference.same_size) return difference;

  const std::vector<std::uint8_t> a = picture.to_rgba8();
  const std::vector<std::uint8_t> b = reference.to_rgba8();
  double squares = 0;
  std::size_t visible = 0;
  for (std::size_t i = 0; i < a.size(); i += 4) {
    for (std::size_t channel = i; channel < i + 4; ++channel) {
      const double step = a[channel] - b[channel];
      squares += step * step;
    }
    if (largest_step(a, b, i) > Difference::visible_step) ++visible;
  }
  difference.rmse = std::sqrt(squares / static_cast<double>(a.size()));
  difference.share_of_visible = static_cast<double>(visible) / (static_cast<double>(a.size()) / 4);
  return difference;
}

Image difference_picture(const Image& picture, const Image& reference) {
  constexpr double amplified = 8;
  const std::vector<std::uint8_t> a = picture.to_rgba8();
  const std::vector<std::uint8_t> b = reference.to_rgba8();
  Image result(picture.width(), picture.height());
  std::size_t i = 0;
  for (int y = 0; y < result.height(); ++y) {
    for (int x = 0; x < result.width(); ++x, i += 4) {
      const auto channel = [&](std::size_t c) {
        return amplified * std::abs(a[i + c] - b[i + c]) / 255;
      };
      result.set(x, y, {channel(0), channel(1), channel(2)});
    }
  }
  return result;
}

}  // namespace crt::tests
