// Files of pictures are limited by their length and by the size that their headers claim.
#pragma once

#include <cstddef>
#include <cstdint>

#include "crt/image_limits.hpp"

namespace crt::core {

/// An image file is at most so long. The largest picture as floats without compression needs half
/// of it.
inline constexpr std::size_t max_image_file_bytes = std::size_t{1} << 32;

/// A SizeLimit decides by the size in a file's header whether its picture is decoded.
class SizeLimit {
 public:
  /// Takes the most pixels that the caller allows; 0 is what is affordable.
  explicit SizeLimit(std::uint64_t most_pixels);

  /// Returns the most pixels that a picture may have.
  std::size_t most_pixels() const { return max_pixels_; }
  /// Returns the most bytes that its file may have.
  std::size_t max_file_bytes() const;
  bool allows(std::uint64_t width, std::uint64_t height) const {
    return height == 0 || width <= max_pixels_ / height;
  }
  /// Throws RefusedFile, or TooLarge if it is the caller who allows no more.
  void check(std::uint64_t width, std::uint64_t height) const;

 private:
  std::size_t max_pixels_;
};

}  // namespace crt::core
