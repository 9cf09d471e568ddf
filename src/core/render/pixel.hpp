// Pixels' colours: each is the mean over its samples.
#pragma once

#include "core/render/tracer.hpp"
#include "core/sampling/pixel_samples.hpp"
#include "crt/render.hpp"

namespace crt::core {

/// A pixel: the mean over its samples.
struct PixelMean {
  Lanes channels;  ///< red, green, blue, alpha
  double dropped;  ///< see Sample
};

/// The pixels of a part of the picture, row by row, into `pixels`. Each is the mean over a grid of
/// subpixels, sampled at their centres, and for each of them over points of the lens if there is
/// one: a function of the scene and of its place alone. Neighbouring rays are traced together. The
/// same means of what the samples meet first go into `first_hits`, if that has margin for them.
void trace_pixels(const Frame& frame, const Region& region, Tracer& tracer,
                  std::span<PixelMean> pixels, std::span<FirstHit> first_hits, RenderStats& stats);

/// A pixel, and what is kept of its samples.
struct PixelPlace {
  int x = 0;
  int y = 0;
  PixelSamples* samples = nullptr;
  FirstHit* first_hits =
      nullptr;  ///< where the sum of what they meet first is kept, if somebody asks
};

/// Of the samples of a pixel's sequence those from `begin` to before `end`, both of which end a
/// step (see schedule.hpp).
struct SampleRange {
  std::int64_t begin = 0;
  std::int64_t end = 0;
};

/// Adds samples to pixels that have had those before; with the first ones what is kept of them is
/// constructed. What a pixel gets is a function of the scene, of its place and of the range alone,
/// and it makes no difference if a range is cut into several.
void trace_passes(const Frame& frame, std::span<const PixelPlace> pixels, const SampleRange& range,
                  Tracer& tracer, RenderStats& stats);

}  // namespace crt::core
