// A picture of few samples is freed of noise by a filter: each pixel becomes a mean of pixels
// around it that look like it, as far as their noise lets that be seen, and that show the same kind
// of surface.
//
// Sources: Buades, Coll, Morel, A non-local algorithm for image denoising, 2005. Rousselle, Knaus,
// Zwicker, Adaptive rendering with non-local means filtering, 2012, whose distance this is, and
// Robust denoising using feature and color information, 2013, for surfaces.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>

namespace crt::core {

/// A Guide is what the filter knows of a pixel beside its colour. Means are over its samples.
struct Guide {
  std::array<float, 3> albedo{};    ///< of what samples meet first, 0 where they meet nothing
  std::array<float, 3> normal{};    ///< likewise
  float cover = 0;                  ///< the share of samples that meet something
  float nearness = 0;               ///< the mean of 1 / distance, 0 where they meet nothing
  std::array<float, 3> variance{};  ///< of the means of red, green and blue
  /// The number of independent estimates that the variance is of. Of 1 it is not known, and 0 says
  /// that there is no pixel yet.
  float estimates = 0;
};

/// The colour of a pixel depends on those that are at most so far away in x and y.
inline constexpr int denoise_reach = 11;

/// A StripRunner calls task(0) ... task(count - 1), in any order and on any threads.
using StripRunner =
    std::function<void(std::size_t count, const std::function<void(std::size_t)>& task)>;

/// Filters the colours of a picture: rows of red, green, blue and alpha, of which the last stays.
/// Pixels without noise stay as they are, to the bit. The result does not depend on who runs what.
void denoise(int width, int height, std::span<float> pixels, std::span<const Guide> guides,
             const StripRunner& run);

}  // namespace crt::core
