// When a picture has been rendered pass by pass, more is known of its pixels than their colours.
#pragma once

#include <cstdint>
#include <vector>

#include "core/render/first_hit.hpp"

namespace crt::core {

/// PixelMeasures go by rows from the top.
struct PixelMeasures {
  std::vector<std::uint32_t> samples;
  std::vector<float> half_widths;    ///< in display units; empty for the plain grid
  std::vector<FirstHit> first_hits;  ///< means over the samples; empty if nobody asks
};

}  // namespace crt::core
