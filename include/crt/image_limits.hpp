// Pictures in files may be limited by the size in their headers, before anything is decoded.
#pragma once

#include <crt/image.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace crt {

/// A picture, made or read, has at most so many pixels.
inline constexpr std::uint64_t most_image_pixels = std::uint64_t{1} << 27;

/// Returns how many pixels a quarter of the memory that this process may have is enough for, at 16
/// bytes each. It is most_image_pixels where that is less. Image::read() and Image::decode() allow
/// so many.
std::uint64_t affordable_image_pixels();

/// Reads a picture as Image::read() does, but for one whose header says that it has more than
/// `most_pixels`, of which nothing is decoded. 0 stands for affordable_image_pixels(). Throws
/// Error: limit for such a picture, io if it is larger than any may be, and as Image::read() does.
Image read_image(const std::filesystem::path& path, std::uint64_t most_pixels = 0);

/// Reads a picture from a file's content in memory, otherwise as read_image(). `name` is for
/// messages.
Image decode_image(std::span<const std::byte> content, const std::string& name,
                   std::uint64_t most_pixels = 0);

}  // namespace crt
