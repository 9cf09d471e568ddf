// PixelsAside adds samples to copies of pixels, so that what is known of them stays whole until all
// samples are there. A checkpoint may be made in between, and a render may end.
#pragma once

#include <array>
#include <span>
#include <utility>

#include "core/render/pixel.hpp"
#include "core/render/tiles.hpp"
#include "core/render/workspace.hpp"

namespace crt::core {

class PixelsAside {
 public:
  /// Replaces what is kept of some pixels of a tile by copies, in the places themselves and in
  /// memory of the workspace. Neither may be used for anything else until put_back().
  /// `have_samples` says that the pixels have samples already.
  PixelsAside(std::span<PixelPlace> places, bool have_samples, Workspace& work) : places_(places) {
    work.pixel_samples.resize(Tiles::most_pixels);
    work.first_hits.resize(Tiles::most_pixels);
    for (std::size_t i = 0; i < places.size(); ++i) {
      PixelPlace& place = places[i];
      samples_[i] = std::exchange(place.samples, &work.pixel_samples[i]);
      if (have_samples) *place.samples = *samples_[i];
      first_hits_[i] = place.first_hits;
      if (place.first_hits == nullptr) continue;
      place.first_hits = &work.first_hits[i];
      *place.first_hits = *first_hits_[i];
    }
  }

  /// Copies the copies back to the originals, and restores the places.
  void put_back() {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      PixelPlace& place = places_[i];
      *samples_[i] = *std::exchange(place.samples, samples_[i]);
      if (first_hits_[i] != nullptr)
        *first_hits_[i] = *std::exchange(place.first_hits, first_hits_[i]);
    }
  }

 private:
  std::span<PixelPlace> places_;
  // These are the originals:
  std::array<PixelSamples*, Tiles::most_pixels> samples_;
  std::array<FirstHit*, Tiles::most_pixels> first_hits_;
};

}  // namespace crt::core
