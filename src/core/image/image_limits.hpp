#pragma once

#include <cstddef>

namespace crt::core {

/// Pixels of a picture, made or read.
inline constexpr std::size_t max_image_pixels = std::size_t{1} << 27;

/// Length of an image file: the largest picture as floats without compression needs half of it.
inline constexpr std::size_t max_image_file_bytes = std::size_t{1} << 32;

}  // namespace crt::core
