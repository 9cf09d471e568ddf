// Values in pictures that are not finite are found, and count as 0.
#pragma once

#include "crt/image.hpp"

namespace crt::core {

/// Returns where the values of a picture are not finite, without a file's name.
NotFiniteValues find_not_finite(const Image& image);

/// Replaces values that are not finite by 0, and returns where they were.
NotFiniteValues replace_not_finite(Image& image);

}  // namespace crt::core
