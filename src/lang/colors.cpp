#include "lang/colors.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <crt/elementary.hpp>
#include <cstddef>

namespace crt::lang {

double light_of_srgb(double channel) {
  // IEC 61966-2-1, for channels below 0 mirrored.
  const double size = std::abs(channel);
  const double light =
      size <= 0.04045 ? size / 12.92 : elementary::pow((size + 0.055) / 1.055, 2.4);
  return std::copysign(light, channel);
}

std::optional<Color> color_of_text(std::string_view text) {
  constexpr int base = 16;
  constexpr double most = 255;
  constexpr int repeated_digit = base + 1;
  const std::size_t digits = text.size() - (text.empty() ? 0 : 1);
  if (!text.starts_with('#') || (digits != 3 && digits != 6 && digits != 8)) return std::nullopt;
  const std::size_t width = digits == 3 ? 1 : 2;
  std::array<double, 4> channels = {0, 0, 0, 1};
  for (std::size_t i = 0; i < digits / width; ++i) {
    const char* const begin = text.data() + 1 + i * width;
    unsigned number = 0;
    const auto result = std::from_chars(begin, begin + width, number, base);
    if (result.ec != std::errc{} || result.ptr != begin + width) return std::nullopt;
    channels.at(i) = (width == 1 ? repeated_digit * number : number) / most;
  }
  return Color{light_of_srgb(channels[0]), light_of_srgb(channels[1]), light_of_srgb(channels[2]),
               channels[3]};
}

}  // namespace crt::lang
