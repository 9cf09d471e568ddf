// Pictures with values that are no finite numbers: where they are, and that they count as 0.
#pragma once

#include "crt/image.hpp"

namespace crt::core {

/// Where they are in a picture; without a file's name.
NotFiniteValues find_not_finite(const Image& image);

/// Puts 0 in their place. Returns where they were.
NotFiniteValues replace_not_finite(Image& image);

}  // namespace crt::core
