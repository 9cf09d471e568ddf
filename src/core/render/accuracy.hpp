// A few numbers say how far a picture may be from the truth.
#pragma once

#include "core/render/passes.hpp"
#include "core/render/workspace.hpp"
#include "crt/background.hpp"

namespace crt::core {

/// Reports on pixels that were rendered pass by pass. There must be a pixel, and half-widths.
void report_measures(const PixelMeasures& measures, RenderStats& stats);

/// Returns how many samples each pixel has if it is not rendered pass by pass.
std::uint64_t samples_of_grid(const Settings& settings, bool lens);

/// Reports on pixels that all have the same number of samples.
void report_grid(const Settings& settings, bool lens, RenderStats& stats);

/// Takes out what is said of how near to the truth a picture is, which holds before a filter alone.
void forget_accuracy(RenderStats& stats);

/// Returns the brightest channel that a ray which hits nothing can see, or white if that is
/// brighter.
double brightest_of(const Background& background);

/// Reports what cutting off paths may have taken from the pixels that `stats` counts.
void report_cutoff(const CutoffSum& cutoff, const Background& background, RenderStats& stats);
/// Returns the mean that is reported of a sum in the units of CutoffSum.
double cutoff_mean(std::uint64_t units, double brightest, std::uint64_t pixels);
/// Returns the units of which this is the mean that was reported.
std::uint64_t cutoff_units(double mean, double brightest, std::uint64_t pixels);

}  // namespace crt::core
