// A Canvas is the picture while it is being rendered. Tiles come in from any thread, and anyone may
// look.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "core/denoise/denoise.hpp"
#include "core/math/lanes.hpp"
#include "core/render/aov_tile.hpp"
#include "crt/render.hpp"

namespace crt::core {

/// Returns a channel as the image's floats hold it, which is finite.
inline float finite_float(double value) {
  constexpr double largest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -largest, largest));
}
inline FloatLanes finite_floats(const Lanes& values) {
  const Lanes largest = lanes_of(std::numeric_limits<float>::max());
  return to_floats(min(largest, max(values, -largest)));
}

struct PlacedPixel {
  int x = 0;
  int y = 0;
  std::array<float, 4> values{};
};

struct PlacedGuide {
  int x = 0;
  int y = 0;
  Guide guide;
};

class Canvas {
 public:
  /// Makes a canvas that is all transparent black.
  Canvas(const Region& region, const Settings& settings);

  const Region& region() const { return region_; }

  /// Puts in the pixels of a tile (in picture coordinates): rows of RGBA from the top.
  void put(const Region& tile, std::span<const float> pixels);

  /// Puts in single pixels of the region.
  void put(std::span<const PlacedPixel> pixels);
  /// Adds the channels for AOVs. It must be called before the first tile. Throws Error
  /// (out_of_memory).
  void add_channels(const Aovs& aovs) { core::add_channels(aovs, image_); }
  /// Puts in the AOVs of a tile.
  void put_aovs(const AovTile& tile);

  /// Keeps a guide for each pixel from now on. It must be called before the first tile. Throws
  /// Error (out_of_memory).
  void add_guides();
  bool has_guides() const { return !guides_.empty(); }
  /// Puts in guides of pixels of the region.
  void put(std::span<const PlacedGuide> guides);
  /// Returns and takes all guides, to keep them elsewhere for a while.
  std::vector<Guide> guides() const;
  void set_guides(std::vector<Guide> guides);
  /// Frees the picture of noise, and keeps that part of it alone. All tiles must be in, and the
  /// guides go.
  void denoise(const StripRunner& run, const Region& part);
  /// Returns a part of the picture with what is done at the time, freed of noise if there are
  /// guides.
  Image denoised_copy(const StripRunner& run, const Region& part) const;

  void set_stats(const RenderStats& stats);

  /// Returns the picture with what is done at the time.
  Image copy() const;

  /// Returns the picture and takes it from the canvas. All tiles must be in.
  Image take() { return std::move(image_); }

 private:
  Region region_;
  Image image_;
  std::vector<Guide> guides_;
  mutable std::mutex mutex_;
};

}  // namespace crt::core
