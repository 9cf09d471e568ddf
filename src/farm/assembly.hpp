// An Assembly is the picture of a frame while its pieces come in.
#pragma once

#include "farm/part.hpp"

namespace crt::farm {

class Assembly {
 public:
  explicit Assembly(const Manifest& manifest)
      : manifest_(manifest), image_(manifest.width, manifest.height) {}

  /// Takes a piece. Throws Error (io) if it does not fit those that are there.
  void add(const RenderedPiece& rendered);

  bool is_complete() const { return pixels_ == covered_.size(); }

  /// Returns the picture, as one machine would have rendered it.
  Image finish();

 private:
  void begin(const RenderedPiece& first);
  void add_channels(const RenderedPiece& rendered);

  const Manifest& manifest_;
  Image image_;
  std::vector<ImageChannel> channels_;
  std::vector<bool> covered_ = std::vector<bool>(image_.pixels().size() / 4);
  std::size_t pixels_ = 0;
  std::uint64_t cutoff_units_ = 0;
  double brightest_ = 1;
};

}  // namespace crt::farm
