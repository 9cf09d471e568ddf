#include "core/shading/prepared_background.hpp"

#include <numbers>

#include "core/math/quick_angle.hpp"
#include "crt/settings.hpp"

namespace crt::core {

namespace {
constexpr double full_turn = 2 * std::numbers::pi;
}

PreparedBackground::PreparedBackground(const Background& background, TexturePool& textures,
                                       int compat)
    : background_(background) {
  if (const auto* sky = std::get_if<SkyBackground>(&background_)) sky_.emplace(*sky);
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
  return colors(lanes_of(direction), 1).lane(0);
}

ColorLanes PreparedBackground::colors(const VectorLanes& directions, std::uint32_t lanes) const {
  if (const auto* solid = std::get_if<SolidBackground>(&background_)) return lanes_of(solid->color);
  if (const auto* gradient = std::get_if<GradientBackground>(&background_)) {
    return mix(lanes_of(gradient->horizon), lanes_of(gradient->sky),
               min(lanes_of(1), abs(directions.y)));
  }
  if (sky_) return {sky_->light(directions), lanes_of(1)};
  return panorama(std::get<PanoramaBackground>(background_), directions, lanes);
}

ColorLanes PreparedBackground::panorama(const PanoramaBackground& panorama,
                                        const VectorLanes& directions, std::uint32_t lanes) const {
  const double width = texture_->width();
  const double height = texture_->height();
  const Lanes across = quick_atan2(directions.x, directions.z) + panorama.angle;
  const Lanes x = (0.5 + across * (1 / full_turn)) * width;
  const Lanes level = sqrt(directions.x * directions.x + directions.z * directions.z);

  Lanes y = lanes_of(0.5 * height);
  switch (panorama.projection) {
    case PanoramaProjection::spherical:
      y -= quick_atan2(directions.y, level) * (height / std::numbers::pi);
      break;
    case PanoramaProjection::cylindrical:
      // The cylinder has radius 1, so that a texel is as high as it is wide.
      y -= directions.y / level * (width / full_turn);
      break;
    case PanoramaProjection::equal_area:
      // By Archimedes, as much of the sphere lies between two heights as of the cylinder around it.
      y -= 0.5 * directions.y * height;
      break;
  }
  return texture_->bilinear(x, y, TextureWrap::repeat, TextureWrap::clamp, lanes);
}

}  // namespace crt::core
