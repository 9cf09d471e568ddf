// Pixels to which samples are added aside, so that what is known of them stays whole until all are there: a
// checkpoint may be made in between, and a render may end.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "core/render/pixel.hpp"
#include "core/render/tiles.hpp"
#include "core/render/workspace.hpp"

namespace crt::core {

class PixelsAside {
 public:
  /// Has copies stand for what is kept of some pixels of a tile, in the places themselves and in memory of
  /// the workspace, neither of which may be used for anything else until put_back(). `have_samples`: that
  /// they have some already.
  PixelsAside(std::span<PixelPlace> places, bool have_samples, Workspace& work) : places_(places) {
    work.pixel_samples.resize(Tiles::most_pixels);
    std::copy(places.begin(), places.end(), originals_.begin());
    for (std::size_t i = 0; i < places.size(); ++i) {
      PixelPlace& place = places[i];
      if (have_samples) work.pixel_samples[i] = *place.samples;
      place.samples = &work.pixel_samples[i];
      if (place.first_hits == nullptr) continue;
      first_hits_[i] = *place.first_hits;
      place.first_hits = &first_hits_[i];
    }
  }

  /// Puts the copies where the originals are, and the places as they were.
  void put_back() {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const PixelPlace& original = originals_[i];
      *original.samples = *places_[i].samples;
      if (original.first_hits != nullptr) *original.first_hits = first_hits_[i];
      places_[i] = original;
    }
  }

 private:
  std::span<PixelPlace> places_;
  std::array<PixelPlace, Tiles::most_pixels> originals_;
  std::array<FirstHit, Tiles::most_pixels> first_hits_;
};

}  // namespace crt::core
