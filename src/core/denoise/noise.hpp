// The filter has to know how noisy each pixel is.
#pragma once

#include <span>

#include "core/denoise/planes.hpp"

namespace crt::core {

/// Finds for some rows the squares of what pixels differ from their neighbours by, summed over the
/// channels, as far as they stand for the pixels' own noise. So even slopes of light are no noise.
void find_residuals(const PicturePlanes& planes, int first_row, int last_row, Plane& squares);

/// Finds the variances of some rows. Where the pixels' own estimates are missing, what neighbours
/// differ by stands in for them. Where there are few, similar neighbours' estimates join them.
void find_variances(const PicturePlanes& planes, std::span<const Guide> guides,
                    std::span<const float> own, std::span<const float> residuals, int first_row,
                    int last_row, Plane& variances);

}  // namespace crt::core
