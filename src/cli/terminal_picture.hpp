// A picture is shown in a terminal by what that terminal can do.
#pragma once

#include <crt/image.hpp>
#include <string>

namespace crt::cli {

/// Returns what shows the picture on the terminal that is standard output. It is a PNG file in the
/// graphics protocol of kitty, a picture in sixels, or characters whose upper and lower halves have
/// the colours of pixels. The last is also for what is no terminal.
std::string terminal_picture(const Image& image);

}  // namespace crt::cli
