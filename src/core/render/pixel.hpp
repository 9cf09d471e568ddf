// Pixels' colours: each is the mean over its samples.
#pragma once

#include "core/render/tracer.hpp"
#include "crt/render.hpp"

namespace crt::core {

/// The pixels of a part of the picture, row by row, into `pixels`. Each is the mean over a grid of subpixels,
/// sampled at their centres, and for each of them over points of the lens if there is one: a function of the
/// scene and of its place alone. Neighbouring rays are traced together.
void trace_pixels(const Frame& frame, const Region& region, Tracer& tracer, std::span<Tracer::Sample> pixels,
                  RenderStats& stats);

}  // namespace crt::core
