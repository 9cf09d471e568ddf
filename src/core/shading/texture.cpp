#include "core/shading/texture.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/power.hpp"
#include "core/shading/not_finite.hpp"
#include "core/shading/rgb.hpp"

namespace crt::core {

namespace {

/// Converts a display-encoded picture to linear light. The gamma curve applies to straight colours.
std::shared_ptr<const Image> to_linear_light(const Image& encoded, double gamma) {
  auto linear = std::make_shared<Image>(encoded);
  const std::span<float> values = linear->pixels();
  for (std::size_t pixel = 0; pixel + 3 < values.size(); pixel += 4) {
    const double alpha = values[pixel + 3];
    if (!(alpha > 0)) continue;
    const Lanes shown = lanes_of(values[pixel], values[pixel + 1], values[pixel + 2], 0);
    const Lanes light = alpha * power(max(Lanes{}, shown / alpha), lanes_of(gamma));
    for (std::size_t channel = 0; channel < 3; ++channel) {
      values[pixel + channel] = static_cast<float>(light[channel]);
    }
  }
  linear->set_display_encoded(false);
  return linear;
}

/// Neighbours are two neighbouring texels along one side of the picture, and the share of the
/// second.
struct Neighbours {
  int first = 0;
  int second = 0;
  double share = 0;
};

Neighbours neighbours(double position, int size, TextureWrap wrap) {
  double from_center = position - 0.5;
  if (wrap == TextureWrap::clamp) {
    from_center = std::clamp(from_center, 0.0, size - 1.0);
  } else {
    from_center = std::fmod(from_center, size);
    if (from_center < 0) from_center += size;
    if (!(from_center < size)) from_center = 0;  // a tiny negative number rounds up to the size
  }
  Neighbours result;
  result.first = static_cast<int>(from_center);
  result.share = from_center - result.first;
  const int next = result.first + 1;
  result.second = next < size ? next : (wrap == TextureWrap::clamp ? size - 1 : 0);
  return result;
}

Color straight(const Color& premultiplied) {
  const double alpha = std::clamp(premultiplied.a, 0.0, 1.0);
  if (alpha == 1) return {premultiplied.r, premultiplied.g, premultiplied.b, 1};
  if (!(alpha > 0)) return {0, 0, 0, 0};
  return {premultiplied.r / alpha, premultiplied.g / alpha, premultiplied.b / alpha, alpha};
}

}  // namespace

Texture::Texture(std::shared_ptr<const Image> image, double gamma)
    : image_(std::move(image)), not_finite_(image_->not_finite()) {
  if (NotFiniteValues values = find_not_finite(*image_); values.pixels > 0) {
    auto finite = std::make_shared<Image>(*image_);
    replace_not_finite(*finite);
    image_ = std::move(finite);
    not_finite_ = std::move(values);
    own_bytes_ = sizeof(Image) + image_->pixels().size_bytes();
  }
  if (image_->display_encoded() && gamma != 1) {
    image_ = to_linear_light(*image_, gamma);
    own_bytes_ = sizeof(Image) + image_->pixels().size_bytes();
  }
  // Colours between texels are means of these, weighted by alpha, and no brighter.
  Lanes brightest{};
  const std::span<const float> values = image_->pixels();
  for (std::size_t pixel = 0; pixel + 3 < values.size(); pixel += 4) {
    const double alpha = std::clamp(double{values[pixel + 3]}, 0.0, 1.0);
    opaque_ = opaque_ && alpha == 1;
    if (!(alpha > 0)) continue;
    brightest =
        max(brightest, lanes_of(values[pixel], values[pixel + 1], values[pixel + 2], 0) / alpha);
  }
  brightest_ = std::max<double>({brightest[0], brightest[1], brightest[2]});
}

Color Texture::bilinear(double x, double y, TextureWrap wrap_x, TextureWrap wrap_y) const {
  const Neighbours column = neighbours(x, width(), wrap_x);
  const Neighbours row = neighbours(y, height(), wrap_y);
  const Color upper =
      mix(image_->at(column.first, row.first), image_->at(column.second, row.first), column.share);
  const Color lower = mix(image_->at(column.first, row.second),
                          image_->at(column.second, row.second), column.share);
  return straight(mix(upper, lower, row.share));
}

std::uint64_t TexturePool::bytes() const {
  std::uint64_t bytes = 0;
  for (const auto& [image, texture] : textures_) bytes += texture->bytes();
  return bytes;
}

std::vector<std::string> TexturePool::warnings() const {
  std::vector<std::string> warnings;
  for (const auto& [image, texture] : textures_) {
    if (texture->not_finite().pixels > 0) warnings.push_back(texture->not_finite().message());
  }
  std::sort(warnings.begin(), warnings.end());
  return warnings;
}

std::shared_ptr<const Texture> TexturePool::get(const std::shared_ptr<const Image>& image) {
  std::shared_ptr<const Texture>& texture = textures_[image];
  if (!texture && earlier_ != nullptr) {
    const auto found = earlier_->textures_.find(image);
    if (found != earlier_->textures_.end()) texture = found->second;
  }
  if (!texture) texture = std::make_shared<const Texture>(image, gamma_);
  return texture;
}

}  // namespace crt::core
