// RenderOptions::aovs asks for what pixels have beside their colours. An AovTile computes it for a
// tile, and puts it into the image's channels.
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

/// Returns whether AOVs ask how the surfaces look that samples meet first.
inline bool ask_for_first_hits(const Aovs& aovs) {
  return aovs.normal || aovs.albedo;
}

/// Gives an image the channels that are asked for, with the values of pixels that meet nothing.
/// Throws Error (out_of_memory).
void add_channels(const Aovs& aovs, Image& image);

/// A PixelMeasure is what is known of a pixel's colour.
struct PixelMeasure {
  std::uint32_t samples = 0;
  float half_width = 1;  ///< in display units
};

/// An AovTile is for a render that has AOVs. Each tile gets a new one.
class AovTile {
 public:
  AovTile(const Aovs& aovs, const Region& tile) : aovs_(aovs), tile_(tile) {}

  /// Returns where the means of the pixels' first hits are to be put (see trace_pixels). It is
  /// empty if nobody wants them.
  std::span<FirstHit> first_hits(bool are_wanted);

  /// Sets how many samples each pixel has, if all have as many and their error is not known.
  void set_samples(std::uint32_t count) { measures_.fill({.samples = count, .half_width = 1}); }

  /// Takes first hits and measures from those of all pixels of a region.
  void take(const PixelMeasures& measures, const Region& region);

  /// Traces a ray through the middle of each pixel, if somebody asks for what it meets.
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
