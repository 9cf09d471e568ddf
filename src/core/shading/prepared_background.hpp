// Rays that hit nothing see the background.
#pragma once

#include <memory>
#include <optional>

#include "core/shading/rgb.hpp"
#include "core/shading/sky.hpp"
#include "core/shading/texture.hpp"
#include "crt/background.hpp"
#include "crt/vec.hpp"

namespace crt::core {

/// A PreparedBackground is a background ready for looking up. A panorama's middle column is
/// straight ahead (+z) at angle 0, and +x is to the right of it. The picture's columns follow
/// atan2(d.x, d.z) + angle.
class PreparedBackground {
 public:
  /// `compat` is that of Settings. Spherical panoramas of 2015 are of equal area, and angles turn
  /// all panoramas in the other direction.
  PreparedBackground(const Background& background, TexturePool& textures, int compat = 0);

  /// Returns the colour in a direction (unit length), not premultiplied.
  Color color(const Vec3& direction) const;
  /// Returns the colours in directions, in the lanes that have their bit in `lanes`.
  ColorLanes colors(const VectorLanes& directions, std::uint32_t lanes) const;

  /// Returns about how many rows of a picture have all that there is to see.
  int detail() const {
    constexpr int detail_of_sky = 128;
    return texture_ != nullptr ? texture_->height() : sky_ ? detail_of_sky : 1;
  }

  /// Returns the sky if the background is one. Colours are those without its sun.
  const Sky* sky() const { return sky_ ? &*sky_ : nullptr; }

 private:
  ColorLanes panorama(const PanoramaBackground& panorama, const VectorLanes& directions,
                      std::uint32_t lanes) const;

  Background background_;
  std::shared_ptr<const Texture> texture_;
  std::optional<Sky> sky_;
};

}  // namespace crt::core
