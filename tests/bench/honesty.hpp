// Whether the half-width that is told of a pixel holds what it promises, by class of pixel.
#pragma once

#include <array>
#include <crt/render.hpp>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace crt::bench {

/// What a pixel is by the rays through it, not by what a renderer thinks of it.
enum class PixelClass {
  flat,       ///< all rays see nearly the same
  edge,       ///< they do not: silhouettes, creases, shadows, patterns
  sub_pixel,  ///< some meet a thing, or a gap, that nowhere around covers a whole pixel
  defocused,  ///< not flat, seen through a lens
  special,    ///< not flat, and some first meet one of the entities of interest: glass, or mirrors
};

/// Of entities, by their ids; none if last is before first.
struct EntityRange {
  std::uint32_t first = 1;
  std::uint32_t last = 0;
};

/// Of each pixel of a part of the scene's picture, rows from the top.
std::vector<PixelClass> classes_of(const Scene& scene, const Region& region,
                                   const EntityRange& interest);

/// What a viewer sees of a colour, each channel from 0 to 1.
using Shown = std::array<double, 3>;

/// The pixels of a part of a picture with their true values.
struct TruePixels {
  Scene scene{};
  Region region{};
  std::vector<bool> chosen{};  ///< whether it is of the class that is looked at
  std::vector<Shown> truth{};
  double uncertainty = 0;  ///< of the truth, in display units: root of the mean square
};

/// The truth is the mean of two renders with so many samples a pixel each and random numbers of
/// their own.
TruePixels true_pixels(const Scene& scene, const Region& region, std::vector<bool> chosen,
                       int samples);

/// One pixel, rendered with one seed.
struct Trial {
  std::size_t pixel = 0;  ///< of those that are chosen
  double claimed = 0;     ///< half-width, in display units
  double error = 0;       ///< of the worst channel
};

/// Of all chosen pixels, each with the seeds from 1 on, where the renderer stopped.
std::vector<Trial> trials_of(const TruePixels& pixels, double target_error, int seeds);

}  // namespace crt::bench
