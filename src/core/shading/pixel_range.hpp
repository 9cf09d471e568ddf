// What all pixels of a picture have in common is found in one pass over its memory.
#pragma once

#include <span>

#include "core/simd/lanes.hpp"

namespace crt::core {

/// A PixelRange is what the pixels of a picture are at most and at least, by channel.
struct PixelRange {
  FloatLanes most{};  ///< at least 0
  FloatLanes least{};
  bool is_finite = true;  ///< Else, most and least count some of the numbers only.
};

/// Returns the range of the pixels (of four channels each). There is at least one.
inline PixelRange pixel_range(std::span<const float> values) {
  PixelRange range;
  range.least = lanes_at<FloatLanes>(values.data());
  FloatLanes zeros{};  // and NaN where a value is not finite
  for (std::size_t pixel = 0; pixel < values.size(); pixel += lane_count) {
    const auto channels = lanes_at<FloatLanes>(&values[pixel]);
    range.most = max(range.most, channels);
    range.least = min(range.least, channels);
    zeros += 0.0F * channels;
  }
  range.is_finite = all(zeros == 0.0F);
  return range;
}

}  // namespace crt::core
