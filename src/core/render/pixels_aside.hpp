// Pixels to which samples are added aside, so that what is known of them stays whole until all are
// there: a checkpoint may be made in between, and a render may end.
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
  /// Has copies stand for what is kept of some pixels of a tile, in the places themselves and in
  /// memory of the workspace, neither of which may be used for anything else until put_back().
  /// `have_samples`: that they have some already.
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

  /// Puts the copies where the originals are, and the places as they were.
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
  // The originals:
  std::array<PixelSamples*, Tiles::most_pixels> samples_;
  std::array<FirstHit*, Tiles::most_pixels> first_hits_;
};

}  // namespace crt::core
