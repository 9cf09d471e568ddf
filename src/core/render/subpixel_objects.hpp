// Subpixel objects may all be missed by the first samples of a pixel, though they cover some of it.
// The scene shows where they are. Pixels in front of them get more samples from the start.
#pragma once

#include <vector>

#include "core/render/frame.hpp"
#include "crt/render.hpp"

namespace crt::core {

/// Returns for each pixel of the region, rows from the top, whether an object that is less than a
/// pixel high or wide may be seen there. It is empty if there is none. Surfaces without an inside
/// do not count, as meshes are made of small ones. Nothing counts with a lens, or if it is seen in
/// mirrors.
std::vector<bool> subpixel_objects(const Frame& frame, const Region& region);

}  // namespace crt::core
