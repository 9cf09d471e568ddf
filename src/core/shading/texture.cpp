#include "core/shading/texture.hpp"

#include <algorithm>
#include <array>

#include "core/math/power.hpp"
#include "core/shading/not_finite.hpp"
#include "core/shading/pixel_range.hpp"

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
/// second, for as many positions as there are lanes.
struct Neighbours {
  IntLanes first;
  IntLanes second;
  Lanes share;
};

Neighbours neighbours(const Lanes& position, double size, TextureWrap wrap) {
  const bool is_clamped = wrap == TextureWrap::clamp;
  const Lanes last = lanes_of(size - 1);
  Lanes from_center = position - 0.5;
  if (is_clamped) {
    from_center = min(max(Lanes{}, from_center), last);
  } else {
    from_center = fma(-floor(from_center / size), lanes_of(size), from_center);
    // A tiny negative number is rounded up to the size.
    from_center = select(from_center >= 0.0 && from_center < size, from_center, Lanes{});
  }
  const Lanes first = floor(from_center);
  const Lanes second = select(first < last, Lanes(first + 1.0), is_clamped ? last : Lanes{});
  return {stdx::static_simd_cast<IntLanes>(first), stdx::static_simd_cast<IntLanes>(second),
          from_center - first};
}

/// Interpolates from a (share 0) to b (share 1), in every channel.
Lanes mix(const Lanes& a, const Lanes& b, double share) {
  return a + share * (b - a);
}

/// Returns the straight colours of pixels.
ColorLanes straight(const std::array<Lanes, lane_count>& pixels) {
  const auto [red, green, blue, unclamped] = transposed(pixels);
  const VectorLanes premultiplied = {red, green, blue};
  const Lanes alpha = clamp(unclamped, Lanes{}, lanes_of(1));
  if (all(alpha == 1.0)) return {premultiplied, alpha};
  const LaneMask covers = alpha > 0.0;
  const VectorLanes color = premultiplied / select(covers, alpha, lanes_of(1));
  return {select(covers, color, VectorLanes{}), alpha};
}

/// Returns a bound on the straight colours of pixels.
double brightest_of(std::span<const float> values) {
  Lanes brightest{};
  for (std::size_t pixel = 0; pixel < values.size(); pixel += lane_count) {
    const double alpha = std::clamp(double{values[pixel + 3]}, 0.0, 1.0);
    if (!(alpha > 0)) continue;
    brightest = max(brightest, to_doubles(lanes_at<FloatLanes>(&values[pixel])) / alpha);
  }
  return std::max<double>({brightest[0], brightest[1], brightest[2]});
}

}  // namespace

Texture::Texture(std::shared_ptr<const Image> image, double gamma)
    : image_(std::move(image)), not_finite_(image_->not_finite()) {
  const auto take_own = [this](std::shared_ptr<const Image> own) {
    image_ = std::move(own);
    own_bytes_ = sizeof(Image) + image_->pixels().size_bytes();
    return pixel_range(image_->pixels());
  };
  PixelRange range = pixel_range(image_->pixels());
  if (!range.is_finite) {
    auto finite = std::make_shared<Image>(*image_);
    not_finite_ = replace_not_finite(*finite);
    range = take_own(std::move(finite));
  }
  if (image_->display_encoded() && gamma != 1) range = take_own(to_linear_light(*image_, gamma));
  opaque_ = range.least[3] >= 1;
  // Colours between texels are means of these, weighted by alpha, and no brighter.
  brightest_ = opaque_ ? std::max<float>({range.most[0], range.most[1], range.most[2]})
                       : brightest_of(image_->pixels());
}

ColorLanes Texture::bilinear(const Lanes& x, const Lanes& y, TextureWrap wrap_x, TextureWrap wrap_y,
                             std::uint32_t lanes) const {
  const Neighbours columns = neighbours(x, width(), wrap_x);
  const Neighbours rows = neighbours(y, height(), wrap_y);
  const float* const values = image_->pixels().data();
  const auto row_size = static_cast<std::size_t>(width());
  std::array<Lanes, lane_count> pixels{};
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    if ((lanes >> lane & 1u) == 0) continue;
    const auto left = static_cast<std::size_t>(columns.first[lane]);
    const auto right = static_cast<std::size_t>(columns.second[lane]);
    const auto mean_of_row = [&](std::int32_t row) {
      const float* const first = values + lane_count * row_size * static_cast<std::size_t>(row);
      return mix(to_doubles(lanes_at<FloatLanes>(first + lane_count * left)),
                 to_doubles(lanes_at<FloatLanes>(first + lane_count * right)), columns.share[lane]);
    };
    pixels[lane] =
        mix(mean_of_row(rows.first[lane]), mean_of_row(rows.second[lane]), rows.share[lane]);
  }
  return straight(pixels);
}

Color Texture::bilinear(double x, double y, TextureWrap wrap_x, TextureWrap wrap_y) const {
  return bilinear(lanes_of(x), lanes_of(y), wrap_x, wrap_y, 1).lane(0);
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
