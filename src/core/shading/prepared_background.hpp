// What rays see that hit nothing.
#pragma once

#include <memory>

#include "core/shading/rgb.hpp"
#include "core/shading/texture.hpp"
#include "crt/background.hpp"
#include "crt/vec.hpp"

namespace crt::core {

/// A background made ready. A panorama's middle column is straight ahead (+z) at angle 0, and +x is
/// to the right of it: across the picture goes atan2(d.x, d.z) + angle.
class PreparedBackground {
 public:
  /// `compat` as in Settings: spherical panoramas of 2015 are of equal area, and angles turn them
  /// all the other way.
  PreparedBackground(const Background& background, TexturePool& textures, int compat = 0);

  /// The colour in a direction (unit length), not premultiplied.
  Color color(const Vec3& direction) const;
  /// The same, to the last bit, in the lanes that have their bit in `lanes`.
  ColorLanes colors(const VectorLanes& directions, std::uint32_t lanes) const;

 private:
  Color panorama(const PanoramaBackground& panorama, const Vec3& direction) const;

  Background background_;
  std::shared_ptr<const Texture> texture_;
};

}  // namespace crt::core
