// Colours as screens and browsers write them: in sRGB, and in hexadecimal digits.
#pragma once

#include <optional>
#include <string_view>

#include "crt/color.hpp"

namespace crt::lang {

/// Returns the light, 0 for black and 1 for white, of a channel as sRGB stores it.
double light_of_srgb(double channel);

/// Returns the Color of a text such as "#ff8800", "#f80" or "#ff8800cc", or nothing for any other.
std::optional<Color> color_of_text(std::string_view text);

}  // namespace crt::lang
