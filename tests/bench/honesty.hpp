// These functions measure whether the half-width that is claimed for a pixel holds what it
// promises, by class of pixel.
#pragma once

#include <array>
#include <crt/render.hpp>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace crt::bench {

/// Classifies a pixel by the rays through it, not by what a renderer estimates.
enum class PixelClass {
  flat,       ///< all rays see nearly the same
  edge,       ///< they do not: silhouettes, creases, shadows, patterns
  sub_pixel,  ///< some meet a thing, or a gap, that nowhere around covers a whole pixel
  defocused,  ///< not flat, seen through a lens
  special,    ///< not flat, and some first meet one of the entities of interest: glass, or mirrors
};

/// Holds the ids of entities from first to last. It is empty if last is before first.
struct EntityRange {
  std::uint32_t first = 1;
  std::uint32_t last = 0;
};

/// Returns the class of each pixel of a part of the scene's picture, rows from the top.
std::vector<PixelClass> classes_of(const Scene& scene, const Region& region,
                                   const EntityRange& interest);

/// Holds what a viewer sees of a colour, each channel from 0 to 1.
using Shown = std::array<double, 3>;

/// TruePixels are the pixels of a part of a picture with their true values.
struct TruePixels {
  Scene scene{};
  Region region{};
  std::vector<bool> chosen{};  ///< whether it is of the chosen class
  std::vector<Shown> truth{};
  double uncertainty = 0;  ///< of the truth, in display units: root of the mean square
};

/// Returns the mean of two renders with so many samples a pixel each and independent random
/// numbers.
TruePixels true_pixels(const Scene& scene, const Region& region, std::vector<bool> chosen,
                       int samples);

/// A Trial is one pixel, rendered with one seed.
struct Trial {
  std::size_t pixel = 0;  ///< of those that are chosen
  double claimed = 0;     ///< half-width, in display units
  double error = 0;       ///< of the worst channel
};

/// Returns the trials of all chosen pixels, each with the seeds from 1 on, where the renderer
/// stopped.
std::vector<Trial> trials_of(const TruePixels& pixels, double target_error, int seeds);

}  // namespace crt::bench
