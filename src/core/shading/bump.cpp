#include "core/shading/bump.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/math/direction_and_length.hpp"
#include "core/shading/rgb.hpp"

namespace crt::core {

namespace {

/// Differences are taken over this part of a pattern's smallest feature.
constexpr double step_of_feature = 1.0 / 64;

double smallest_feature(const Checker& pattern) {
  return pattern.scale;
}
double smallest_feature(const Stripes& pattern) {
  return pattern.scale;
}
double smallest_feature(const Gradient& pattern) {
  return pattern.scale;
}

/// Returns the grain of Noise, Marble or Wood, whose last octave is the finest.
template <class Noisy>
requires requires(const Noisy& pattern) {
  pattern.octaves;
}
double smallest_feature(const Noisy& pattern) {
  return std::scalbn(pattern.scale, 1 - pattern.octaves);
}

/// Returns the size for which a step is half a texel of the picture, as it lies in space.
double smallest_feature(const ImageMap& map, const Texture& texture) {
  const double texels = std::max(map.repeat_u * texture.width(), map.repeat_v * texture.height());
  return map.scale / texels / (2 * step_of_feature);
}

/// Returns the smallest feature of a pattern and of those within it. A picture that lies on (u, v)
/// within another pattern has none, as its slopes are not known in space.
double smallest_feature(const PreparedPattern& pattern) {
  double feature = std::visit(
      [&](const auto& kind) {
        if constexpr (std::is_same_v<std::decay_t<decltype(kind)>, ImageMap>) {
          return kind.mapping == ImageMapping::uv ? std::numeric_limits<double>::max()
                                                  : smallest_feature(kind, *pattern.texture());
        } else {
          return smallest_feature(kind);
        }
      },
      pattern.description());
  for (const PreparedPattern* inner : {pattern.pattern_a(), pattern.pattern_b()}) {
    if (inner) feature = std::min(feature, smallest_feature(*inner));
  }
  return feature;
}

double luminance_at(const PreparedPattern& pattern, const SurfacePoint& point) {
  return luminance(pattern.color(point));
}

Vec3 gradient_in_space(const PreparedPattern& pattern, const SurfacePoint& point, double step) {
  Vec3 result(0);
  for (int axis = 0; axis < 3; ++axis) {
    SurfacePoint before = point;
    SurfacePoint after = point;
    before.position[axis] -= step;
    after.position[axis] += step;
    const double width = after.position[axis] - before.position[axis];
    if (!(width > 0)) continue;  // so far out that doubles cannot separate the two
    result[axis] = (luminance_at(pattern, after) - luminance_at(pattern, before)) / width;
  }
  return result;
}

/// Returns the change of luminance per unit of u or v, over one texel.
double slope(const PreparedPattern& pattern, SurfacePoint point, double SurfacePoint::*coordinate,
             double texels_per_unit) {
  if (!(std::abs(texels_per_unit) > 0)) return 0;
  const double half_texel = 0.5 / std::abs(texels_per_unit);
  const double middle = point.*coordinate;
  point.*coordinate = middle - half_texel;
  const double before = luminance_at(pattern, point);
  point.*coordinate = middle + half_texel;
  return (luminance_at(pattern, point) - before) * std::abs(texels_per_unit);
}

}  // namespace

LuminanceGradient luminance_gradient(const PreparedPattern& pattern, const SurfacePoint& point,
                                     const Shape& shape, std::uint32_t face,
                                     CrossingList& scratch) {
  const auto* map = std::get_if<ImageMap>(&pattern.description());
  if (map && map->mapping == ImageMapping::uv) {
    const UvGradient uv = uv_gradient(shape, face, point.position, point.normal, scratch);
    const double slope_u =
        slope(pattern, point, &SurfacePoint::u, map->repeat_u * pattern.texture()->width());
    const double slope_v =
        slope(pattern, point, &SurfacePoint::v, map->repeat_v * pattern.texture()->height());
    return {slope_u * uv.u + slope_v * uv.v, 4};
  }
  const double feature = smallest_feature(pattern);
  return {gradient_in_space(pattern, point, step_of_feature * feature), 6};
}

Vec3 tilted_normal(const Vec3& normal, const Vec3& height_gradient) {
  const Vec3 within_surface = height_gradient - glm::dot(height_gradient, normal) * normal;
  const DirectionAndLength tilted = direction_and_length(normal - within_surface);
  return tilted.direction == Vec3(0) ? normal : tilted.direction;
}

Vec3 mapped_normal(const Vec3& normal, const UvGradient& uv, const Rgb& color) {
  const auto within_surface = [&normal](const Vec3& v) {
    return direction_and_length(v - glm::dot(v, normal) * normal).direction;
  };
  const Vec3 across = within_surface(uv.u);
  const Vec3 up = within_surface(uv.v);
  if (across == Vec3(0) || up == Vec3(0)) return normal;
  const Vec3 tilt = 2.0 * color - Vec3(1);
  const DirectionAndLength mapped =
      direction_and_length(tilt.x * across + tilt.y * up + std::max(0.0, tilt.z) * normal);
  return mapped.direction == Vec3(0) ? normal : mapped.direction;
}

Vec3 visible_normal(const Vec3& normal, const Vec3& view) {
  const double away = glm::dot(normal, view);
  if (away <= 0) return normal;
  const DirectionAndLength bent = direction_and_length(normal - away * view);
  return bent.direction == Vec3(0) ? -view : bent.direction;
}

}  // namespace crt::core
