// A pixel's colour is the mean over its samples.
#pragma once

#include "core/denoise/denoise.hpp"
#include "core/render/tracer.hpp"
#include "core/sampling/pixel_samples.hpp"
#include "crt/render.hpp"

namespace crt::core {

/// A PixelMean is a pixel: the mean over its samples.
struct PixelMean {
  Lanes channels;  ///< red, green, blue, alpha
  double dropped;  ///< see Sample
};

/// A PixelNoise is how much the samples of a pixel of the grid differ: as many as there are fall
/// into blocks of equal length, whose sums are compared.
struct PixelNoise {
  Lanes block{};    ///< the sum of the block that is not full
  Lanes sum{};      ///< of the full blocks
  Lanes squares{};  ///< of their sums
  std::uint32_t samples = 0;
};

/// Returns the guide of a pixel of the grid that has so many samples, for denoise().
Guide guide_of(const FirstHit& hit, const PixelNoise& noise, std::uint64_t samples);
/// Returns that of one whose means have these variances, as so many estimates show.
Guide guide_of(const FirstHit& hit, const Lanes& variances, std::size_t estimates);

/// Computes the pixels of a part of the picture, row by row, into `pixels`. Each is the mean over a
/// grid of subpixels, sampled at their centres, and for each of them over points of the lens if
/// there is one. So it is a function of the scene and of its place alone. Neighbouring rays are
/// traced together. The means of what the samples meet first go into `first_hits`, and how they
/// differ into `noise`, unless these are empty.
void trace_pixels(const Frame& frame, const Region& region, Tracer& tracer,
                  std::span<PixelMean> pixels, std::span<FirstHit> first_hits,
                  std::span<PixelNoise> noise, RenderStats& stats);

/// A PixelPlace is a pixel, and what is kept of its samples.
struct PixelPlace {
  int x = 0;
  int y = 0;
  PixelSamples* samples = nullptr;
  FirstHit* first_hits = nullptr;  ///< the sum of what its samples meet first, if somebody asks
};

/// A SampleRange has the samples of a pixel's sequence from `begin` to before `end`. Both end a
/// step (see schedule.hpp).
struct SampleRange {
  std::int64_t begin = 0;
  std::int64_t end = 0;
};

/// Adds samples to pixels that have had those before. With the first samples, what is kept of them
/// is constructed. What a pixel gets is a function of the scene, of its place and of the range
/// alone. It makes no difference if a range is cut into several.
void trace_passes(const Frame& frame, std::span<const PixelPlace> pixels, const SampleRange& range,
                  Tracer& tracer, RenderStats& stats);

}  // namespace crt::core
