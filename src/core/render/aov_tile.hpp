// What the pixels of a tile get beside their colours (RenderOptions::aovs), and the channels that
// it goes into.
#pragma once

#include <array>
#include <span>

#include "core/render/first_hit.hpp"
#include "core/render/pixel_measures.hpp"
#include "core/render/tiles.hpp"
#include "core/render/tracer.hpp"

namespace crt::core {

inline bool is_any(const Aovs& aovs) {
  return aovs != Aovs{};
}

/// Whether they tell how the surfaces look that samples meet first.
inline bool ask_for_first_hits(const Aovs& aovs) {
  return aovs.normal || aovs.albedo;
}

/// Gives an image the channels that are asked for, as they are where nothing is met. Throws Error
/// (out_of_memory).
void add_channels(const Aovs& aovs, Image& image);

/// What is known of a pixel's colour.
struct PixelMeasure {
  std::uint32_t samples = 0;
  float half_width = 1;  ///< in display units
};

/// Only for a render that has some; made anew for each tile.
class AovTile {
 public:
  AovTile(const Aovs& aovs, const Region& tile) : aovs_(aovs), tile_(tile) {}

  /// Where the means of the pixels' first hits are to be put (see trace_pixels); nowhere if nobody
  /// asks.
  std::span<FirstHit> first_hits();

  /// How many samples each pixel has, where all have as many and nobody knows their error.
  void set_samples(std::uint32_t count) { measures_.fill({.samples = count, .half_width = 1}); }

  /// Takes first hits and measures from those of all pixels of a region.
  void take(const PixelMeasures& measures, const Region& region);

  /// Sends a ray through the middle of each pixel, if somebody asks for what it meets.
  void look(const CameraRays& camera, Tracer& tracer);

  /// Copies all into the channels of an image that shows `region` of the picture.
  void put(const Region& region, Image& image) const;

 private:
  Aovs aovs_;
  Region tile_;
  std::array<FirstHit, Tiles::most_pixels> first_hits_;
  std::array<FirstPlace, Tiles::most_pixels> first_places_;
  std::array<PixelMeasure, Tiles::most_pixels> measures_;
};

}  // namespace crt::core
