// How far a picture may be from the truth, in few numbers.
#pragma once

#include "core/render/passes.hpp"
#include "core/render/workspace.hpp"
#include "crt/background.hpp"

namespace crt::core {

/// Tells of pixels that were rendered pass by pass. Half-widths must be of use: there is a pixel.
void report_measures(const PixelMeasures& measures, RenderStats& stats);

/// How many samples each pixel has if it is not rendered pass by pass.
std::uint64_t samples_of_grid(const Settings& settings, bool lens);

/// Tells of pixels that all have the same number of samples.
void report_grid(const Settings& settings, bool lens, RenderStats& stats);

/// Tells what cutting off paths may have taken from the pixels that `stats` counts.
void report_cutoff(const CutoffSum& cutoff, const Background& background, RenderStats& stats);

}  // namespace crt::core
