// The page puts pictures over one another: a draft, then what of the picture is rendered. They are
// kept as light, so that they can be shown again in another exposure, or without noise.
#pragma once

#include <crt/image.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "studio/picture_frame.hpp"
#include "studio/view_options.hpp"

namespace crt::studio {

/// A Layer is a picture with what it is of.
struct Layer {
  PictureKind kind = PictureKind::draft;
  std::shared_ptr<const Image> image;
  Channel channel = Channel::color;
  std::uint32_t revision = 0;
  int width = 0;  ///< of the whole picture
  int height = 0;
  std::optional<Region> region{};           ///< the part of it that the image is, if it is no draft
  std::shared_ptr<const Image> denoised{};  ///< is the image without noise, if that is known
};

/// Layers are what the page shows, the lowest first.
class Layers {
 public:
  /// Puts another layer on top. Those that nothing is seen of go.
  void add(Layer layer);
  const std::vector<Layer>& all() const { return layers_; }

 private:
  std::vector<Layer> layers_;
};

/// Returns a layer as a display shows it.
EncodedPicture encoded(const Layer& layer, const Display& display, std::uint32_t number);

}  // namespace crt::studio
