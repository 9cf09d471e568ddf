// This font has letters of straight strokes, for the pictures of drawings.
#pragma once

#include <string_view>
#include <vector>

#include "cli/drawing.hpp"

namespace crt::cli {

/// Returns how wide a text is, in the units of `size`, the height of a line.
double width_of_text(std::string_view text, double size);

/// Returns the strokes of a text that begins at (0, 0) on the line that it stands on.
std::vector<std::vector<Place>> strokes_of_text(std::string_view text, double size);

}  // namespace crt::cli
