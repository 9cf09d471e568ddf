#include "core/shading/not_finite.hpp"

#include <algorithm>
#include <cmath>

#include "core/shading/pixel_range.hpp"

namespace crt::core {

namespace {

bool is_not_finite(float value) {
  return !std::isfinite(value);
}

}  // namespace

NotFiniteValues find_not_finite(const Image& image) {
  constexpr std::size_t channels = 4;
  const std::span<const float> values = image.pixels();
  NotFiniteValues found;
  if (values.empty() || pixel_range(values).is_finite) return found;
  for (std::size_t first = 0; first < values.size(); first += channels) {
    const std::span<const float> pixel = values.subspan(first, channels);
    if (std::none_of(pixel.begin(), pixel.end(), is_not_finite)) continue;
    if (found.pixels++ > 0) continue;
    const auto width = static_cast<std::size_t>(image.width());
    found.x = static_cast<int>(first / channels % width);
    found.y = static_cast<int>(first / channels / width);
  }
  return found;
}

NotFiniteValues replace_not_finite(Image& image) {
  NotFiniteValues found = find_not_finite(image);
  const std::span<float> values = image.pixels();
  if (found.pixels > 0) std::replace_if(values.begin(), values.end(), is_not_finite, 0.0f);
  return found;
}

}  // namespace crt::core
