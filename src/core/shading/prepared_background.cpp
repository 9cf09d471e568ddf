#include "core/shading/prepared_background.hpp"

#include <algorithm>
#include <cmath>
#include <crt/elementary.hpp>
#include <numbers>

#include "crt/settings.hpp"

namespace crt::core {

namespace {
constexpr double full_turn = 2 * std::numbers::pi;
}

PreparedBackground::PreparedBackground(const Background& background, TexturePool& textures,
                                       int compat)
    : background_(background) {
  auto* const panorama = std::get_if<PanoramaBackground>(&background_);
  if (panorama == nullptr) return;
  texture_ = textures.get(panorama->image);
  if (compat != compat_2015) return;
  panorama->angle = -panorama->angle;
  if (panorama->projection == PanoramaProjection::spherical) {
    panorama->projection = PanoramaProjection::equal_area;
  }
}

Color PreparedBackground::color(const Vec3& direction) const {
  if (const auto* solid = std::get_if<SolidBackground>(&background_)) return solid->color;
  if (const auto* gradient = std::get_if<GradientBackground>(&background_)) {
    return mix(gradient->horizon, gradient->sky, std::min(1.0, std::abs(direction.y)));
  }
  return panorama(std::get<PanoramaBackground>(background_), direction);
}

ColorLanes PreparedBackground::colors(const VectorLanes& directions, std::uint32_t lanes) const {
  if (const auto* solid = std::get_if<SolidBackground>(&background_)) return lanes_of(solid->color);
  ColorLanes colors;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    if ((lanes >> lane & 1u) != 0) colors.set(lane, color(directions.lane(lane)));
  }
  return colors;
}

Color PreparedBackground::panorama(const PanoramaBackground& panorama,
                                   const Vec3& direction) const {
  const double width = texture_->width();
  const double height = texture_->height();
  const double across = elementary::atan2(direction.x, direction.z) + panorama.angle;
  const double level = elementary::hypot(direction.x, direction.z);
  const double x = (0.5 + across / full_turn) * width;

  double y = 0.5 * height;
  switch (panorama.projection) {
    case PanoramaProjection::spherical:
      y -= elementary::atan2(direction.y, level) / std::numbers::pi * height;
      break;
    case PanoramaProjection::cylindrical:
      // The cylinder has radius 1, so that a texel is as high as it is wide.
      y -= direction.y / level * width / full_turn;
      break;
    case PanoramaProjection::equal_area:
      // By Archimedes, as much of the sphere lies between two heights as of the cylinder around it.
      y -= 0.5 * direction.y * height;
      break;
  }
  return texture_->bilinear(x, y, TextureWrap::repeat, TextureWrap::clamp);
}

}  // namespace crt::core
