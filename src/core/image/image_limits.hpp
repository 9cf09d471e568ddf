#pragma once

#include <cstddef>

namespace crt::core {

/// A picture, made or read, has at most so many pixels.
inline constexpr std::size_t max_image_pixels = std::size_t{1} << 27;

/// An image file is at most so long. The largest picture as floats without compression needs half
/// of it.
inline constexpr std::size_t max_image_file_bytes = std::size_t{1} << 32;

}  // namespace crt::core
