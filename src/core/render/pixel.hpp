// A pixel's colour: the mean over its samples.
#pragma once

#include "core/render/tracer.hpp"

namespace crt::core {

/// The mean over a grid of subpixels, each sampled at its centre, and for each of them over points of
/// the lens if there is one. A function of the scene and of (x, y) alone.
Tracer::Sample trace_pixel(const Frame& frame, int x, int y, Tracer& tracer, RenderStats& stats);

}  // namespace crt::core
