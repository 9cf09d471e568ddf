// Small things: what the first samples of a pixel may all miss, though it covers some of it. Where
// such things are the scene tells: pixels in front of them get more samples from the start.
#pragma once

#include <vector>

#include "core/render/frame.hpp"
#include "crt/render.hpp"

namespace crt::core {

/// For each pixel of the region, rows from the top, whether an object that is less than a pixel
/// high or wide may be seen there; empty if there is none. Mere surfaces do not count, as meshes
/// are made of small ones. Nor does anything count with a lens, or what is seen in mirrors.
std::vector<bool> subpixel_objects(const Frame& frame, const Region& region);

}  // namespace crt::core
