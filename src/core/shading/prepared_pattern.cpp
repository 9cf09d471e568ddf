#include "core/shading/prepared_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>
#include <type_traits>

#include "core/math/direction_and_length.hpp"
#include "core/shading/noise.hpp"
#include "core/shading/rgb.hpp"

namespace crt::core {

namespace {

/// Where in its period a coordinate is, in [0, 1); 0 where doubles no longer tell.
double period_share(double coordinate) {
  const double share = coordinate - std::floor(coordinate);
  return share < 1 ? share : 0;  // also for NaN, of coordinates beyond all bounds
}

bool is_odd(double whole_number) {
  return std::fmod(whole_number, 2) != 0;
}

/// From 0 to 1 and back, smoothly, once a period.
double wave(double coordinate) {
  return 0.5 - 0.5 * std::cos(2 * std::numbers::pi * period_share(coordinate));
}

/// A little under the surface: of patterns with edges, a surface that lies exactly on an edge wears
/// what is inside of it and not a mixture that rounding makes.
Vec3 under_surface(const PatternPoint& point, double scale) {
  constexpr double of_scale = 0x1p-20;
  constexpr double of_coordinates = 0x1p-48;
  const double largest =
      std::max({std::abs(point.position.x), std::abs(point.position.y), std::abs(point.position.z)});
  return point.position - point.normal * std::max(scale * of_scale, largest * of_coordinates);
}

template <class Solid>
Vec3 in_periods(const Solid& pattern, const Vec3& position) {
  return (position - pattern.offset) / pattern.scale;
}

Color color_of(const Checker& checker, const PatternPoint& point) {
  const Vec3 cell = glm::floor(in_periods(checker, under_surface(point, checker.scale)));
  const bool odd = is_odd(cell.x) != (is_odd(cell.y) != is_odd(cell.z));
  return odd ? checker.color_b : checker.color_a;
}

Color color_of(const Stripes& stripes, const PatternPoint& point) {
  const Vec3 place = in_periods(stripes, under_surface(point, stripes.scale));
  return period_share(glm::dot(place, stripes.direction)) < 0.5 ? stripes.color_a : stripes.color_b;
}

Color color_of(const Gradient& gradient, const PatternPoint& point) {
  const Vec3 place = in_periods(gradient, point.position);
  return mix(gradient.color_a, gradient.color_b, wave(glm::dot(place, gradient.direction)));
}

Color color_of(const Noise& noise, const PatternPoint& point) {
  const double level = fractal_noise(in_periods(noise, point.position), noise.octaves);
  return mix(noise.color_a, noise.color_b, 0.5 + 0.5 * level);
}

Color color_of(const Marble& marble, const PatternPoint& point) {
  const Vec3 place = in_periods(marble, point.position);
  const double shift = marble.turbulence * fractal_noise(place, marble.octaves);
  return mix(marble.color_a, marble.color_b, wave(glm::dot(place, marble.direction) + shift));
}

Color color_of(const Wood& wood, const PatternPoint& point) {
  const Vec3 place = in_periods(wood, point.position);
  const Vec3 from_line = place - glm::dot(place, wood.direction) * wood.direction;
  const double shift = wood.turbulence * fractal_noise(place, wood.octaves);
  return mix(wood.color_a, wood.color_b, wave(direction_and_length(from_line).length + shift));
}

Color color_of(const ImageMap& map, const Texture& texture, const PatternPoint& point) {
  // v runs up the surface, rows run down the picture.
  const double x = period_share(point.u * map.repeat_u) * texture.width();
  const double y = (1 - period_share(point.v * map.repeat_v)) * texture.height();
  return texture.bilinear(x, y, TextureWrap::repeat, TextureWrap::repeat);
}

template <class Solid>
constexpr bool has_direction = requires(Solid pattern) {
  pattern.direction;
};

}  // namespace

PreparedPattern::PreparedPattern(const Pattern& pattern, TexturePool& textures) : pattern_(pattern) {
  std::visit(
      [&](auto& kind) {
        using Kind = std::decay_t<decltype(kind)>;
        if constexpr (std::is_same_v<Kind, ImageMap>) {
          texture_ = textures.get(kind.image);
          opaque_ = texture_->opaque();
        } else {
          opaque_ = kind.color_a.a == 1 && kind.color_b.a == 1;
          if constexpr (has_direction<Kind>) kind.direction = direction_and_length(kind.direction).direction;
        }
      },
      pattern_);
}

Color PreparedPattern::color(const PatternPoint& point) const {
  return std::visit(
      [&](const auto& kind) {
        if constexpr (std::is_same_v<std::decay_t<decltype(kind)>, ImageMap>) {
          return color_of(kind, *texture_, point);
        } else {
          return color_of(kind, point);
        }
      },
      pattern_);
}

}  // namespace crt::core
