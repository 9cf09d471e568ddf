#include "studio/layers.hpp"

#include <algorithm>
#include <utility>

#include "studio/channel_picture.hpp"

namespace crt::studio {

namespace {

/// There are so many at most. Where more regions were refined one by one, the first is forgotten.
constexpr std::size_t most_layers = 8;

/// Returns an image that is displayed in another exposure, or by another tone map.
Image displayed_by(Image image, const Display& display) {
  // The setting's own limits are at 100 stops.
  constexpr double most_stops = 100;
  Settings settings = image.settings();
  settings.exposure = std::clamp(settings.exposure + display.exposure, -most_stops, most_stops);
  settings.tone_map = display.tone_map.value_or(settings.tone_map);
  image.set_settings(std::move(settings));
  return image;
}

}  // namespace

void Layers::add(Layer layer) {
  if (layer.kind != PictureKind::progress) {
    layers_.clear();
  } else if (!layers_.empty() && layers_.back().kind == PictureKind::progress &&
             is_same_region(layers_.back().region, layer.region)) {
    layers_.pop_back();
  }
  if (layers_.size() == most_layers) layers_.erase(layers_.begin() + 1);
  layers_.push_back(std::move(layer));
}

EncodedPicture encoded(const Layer& layer, const Display& display, std::uint32_t number) {
  const bool is_denoised = display.denoise && layer.denoised;
  const Image& image = is_denoised ? *layer.denoised : *layer.image;
  EncodedPicture picture{layer.kind,
                         number,
                         layer.revision,
                         static_cast<std::uint32_t>(layer.width),
                         static_cast<std::uint32_t>(layer.height),
                         static_cast<std::uint32_t>(image.width()),
                         static_cast<std::uint32_t>(image.height()),
                         display == Display{}
                             ? displayed(image, layer.channel)
                             : displayed(displayed_by(image, display), layer.channel)};
  picture.is_denoised = image.settings().denoise && layer.channel == Channel::color;
  if (layer.region && layer.kind != PictureKind::draft) {
    picture.rgba = placed(picture.rgba, *layer.region, layer.width, layer.height);
    picture.width = picture.full_width;
    picture.height = picture.full_height;
  }
  reduce(picture);
  return picture;
}

}  // namespace crt::studio
