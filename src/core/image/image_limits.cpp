#include "core/image/image_limits.hpp"

#include <algorithm>

#include "core/base/memory_limit.hpp"
#include "core/image/essential_bytes.hpp"
#include "text/format.hpp"

namespace crt {

std::uint64_t affordable_image_pixels() {
  constexpr std::uint64_t bytes_of_pixel = 4 * sizeof(float);
  constexpr std::uint64_t share = 4;
  return std::min(most_image_pixels, core::memory_limit() / share / bytes_of_pixel);
}

namespace core {

SizeLimit::SizeLimit(std::uint64_t most_pixels)
    : max_pixels_(std::min(most_image_pixels,
                           most_pixels == 0 ? affordable_image_pixels() : most_pixels)) {}

std::size_t SizeLimit::max_file_bytes() const {
  constexpr std::size_t besides_pixels = std::size_t{1} << 26;
  constexpr std::size_t bytes_of_pixel = 32;
  return std::min(max_image_file_bytes, besides_pixels + bytes_of_pixel * max_pixels_);
}

void SizeLimit::check(std::uint64_t width, std::uint64_t height) const {
  if (allows(width, height)) return;
  const std::string message = text::format(
      "its header says {} x {} pixels; the limit is {} altogether", width, height, max_pixels_);
  if (width > most_image_pixels / height) throw RefusedFile(message);
  throw TooLarge(message);
}

}  // namespace core

}  // namespace crt
