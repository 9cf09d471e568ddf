#include "studio/channel_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <crt/entity.hpp>
#include <cstddef>
#include <span>

namespace crt::studio {

namespace {

using Rgb = std::array<double, 3>;

constexpr std::size_t rgba_bytes = 4;
/// This is what a pixel that shows nothing looks like.
constexpr Rgb nothing = {0.1, 0.1, 0.1};
/// A scale leads from few to many by these colours.
constexpr std::array<Rgb, 5> color_scale = {
    {{0.05, 0.03, 0.3}, {0.15, 0.35, 0.65}, {0.1, 0.65, 0.55}, {0.7, 0.85, 0.25}, {1, 0.95, 0.6}}};
/// An error of so many steps of 8 bits has the last colour of the scale.
constexpr double greatest_error = 8.0 / 255;

Rgb on_scale(double share) {
  const double place = std::clamp(share, 0.0, 1.0) * (color_scale.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), color_scale.size() - 2);
  const double between = place - static_cast<double>(below);
  Rgb result{};
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = color_scale[below][i] * (1 - between) + color_scale[below + 1][i] * between;
  return result;
}

/// Gives numbers that follow one another hues that lie far apart.
Rgb color_of(std::uint32_t id) {
  if (id == no_entity_id) return nothing;
  constexpr double golden_ratio = 0.6180339887498949;
  const double turn = 6 * std::fmod(golden_ratio * id, 1.0);
  const double light = id % 2 == 0 ? 0.95 : 0.7;
  const auto channel = [&](double shift) {
    const double ramp = std::fmod(turn + shift, 6.0);
    return light * (0.25 + 0.75 * std::clamp(std::abs(ramp - 3) - 1, 0.0, 1.0));
  };
  return {channel(0), channel(4), channel(2)};
}

/// Writes the colour of each pixel that is rendered.
template <class ColorOf>
std::vector<std::uint8_t> painted(const Image& image, const ColorOf& color) {
  const std::span<const float> pixels = image.pixels();
  std::vector<std::uint8_t> rgba(pixels.size());
  for (std::size_t i = 0; i < pixels.size() / rgba_bytes; ++i) {
    if (pixels[rgba_bytes * i + 3] == 0) continue;
    const Rgb rgb = color(i);
    for (std::size_t k = 0; k < 3; ++k)
      rgba[rgba_bytes * i + k] =
          static_cast<std::uint8_t>(std::lround(255 * std::clamp(rgb[k], 0.0, 1.0)));
    rgba[rgba_bytes * i + 3] = 255;
  }
  return rgba;
}

/// Shows what is near light and what is far dark. The scale is one of 1 / distance, so that a floor
/// which goes far does not take all of it.
std::vector<std::uint8_t> painted_depth(const Image& image) {
  const std::span<const float> depth = image.channel("Z");
  double nearest = 0;
  double farthest = HUGE_VAL;
  for (const float z : depth) {
    if (!(z > 0) || std::isinf(z)) continue;
    nearest = std::max(nearest, 1.0 / z);
    farthest = std::min(farthest, 1.0 / z);
  }
  const double range = nearest - farthest;
  return painted(image, [&](std::size_t i) {
    if (std::isinf(depth[i])) return nothing;
    const double share = range > 0 ? (1.0 / depth[i] - farthest) / range : 1;
    const double grey = 0.15 + 0.85 * std::clamp(share, 0.0, 1.0);
    return Rgb{grey, grey, grey};
  });
}

std::vector<std::uint8_t> painted_normals(const Image& image) {
  const std::array normal = {image.channel("N.X"), image.channel("N.Y"), image.channel("N.Z")};
  return painted(image, [&](std::size_t i) {
    const Rgb n = {normal[0][i], normal[1][i], normal[2][i]};
    if (n == Rgb{0, 0, 0}) return nothing;
    return Rgb{0.5 + 0.5 * n[0], 0.5 + 0.5 * n[1], 0.5 + 0.5 * n[2]};
  });
}

std::vector<std::uint8_t> painted_albedo(const Image& image) {
  const std::array albedo = {image.channel("albedo.R"), image.channel("albedo.G"),
                             image.channel("albedo.B")};
  const double exponent = 1 / image.settings().gamma;
  return painted(image, [&](std::size_t i) {
    Rgb result{};
    for (std::size_t k = 0; k < 3; ++k) result[k] = std::pow(double{albedo[k][i]}, exponent);
    return result;
  });
}

std::vector<std::uint8_t> painted_samples(const Image& image) {
  const std::span<const std::uint32_t> samples = image.integer_channel("samples");
  std::uint32_t most = 1;
  for (const std::uint32_t count : samples) most = std::max(most, count);
  return painted(image, [&](std::size_t i) {
    return on_scale(std::log2(1.0 + samples[i]) / std::log2(1.0 + most));
  });
}

}  // namespace

Aovs aovs_of(Channel channel) {
  return {.depth = channel == Channel::depth,
          .normal = channel == Channel::normal,
          .id = channel == Channel::id,
          .part = channel == Channel::part,
          .albedo = channel == Channel::albedo,
          .samples = channel == Channel::samples,
          .error = channel == Channel::error};
}

bool is_geometric(Channel channel) {
  return channel != Channel::color && channel != Channel::samples && channel != Channel::error;
}

std::vector<std::uint8_t> displayed(const Image& image, Channel channel) {
  switch (channel) {
    case Channel::color:
      return image.to_rgba8();
    case Channel::depth:
      return painted_depth(image);
    case Channel::normal:
      return painted_normals(image);
    case Channel::albedo:
      return painted_albedo(image);
    case Channel::samples:
      return painted_samples(image);
    case Channel::id:
    case Channel::part: {
      const auto ids = image.integer_channel(channel == Channel::id ? "id" : "part");
      return painted(image, [&](std::size_t i) { return color_of(ids[i]); });
    }
    case Channel::error: {
      const std::span<const float> errors = image.channel("error");
      return painted(image, [&](std::size_t i) { return on_scale(errors[i] / greatest_error); });
    }
  }
  return {};
}

std::vector<std::uint8_t> placed(const std::vector<std::uint8_t>& rgba, const Region& region,
                                 int width, int height) {
  const auto bytes = [](int pixels) { return rgba_bytes * static_cast<std::size_t>(pixels); };
  std::vector<std::uint8_t> whole(bytes(width) * static_cast<std::size_t>(height));
  for (int row = 0; row < region.height; ++row) {
    const std::size_t from = bytes(region.width) * static_cast<std::size_t>(row);
    const std::size_t to = bytes(width) * static_cast<std::size_t>(region.y + row);
    std::copy_n(rgba.begin() + static_cast<std::ptrdiff_t>(from), bytes(region.width),
                whole.begin() + static_cast<std::ptrdiff_t>(to + bytes(region.x)));
  }
  return whole;
}

}  // namespace crt::studio
