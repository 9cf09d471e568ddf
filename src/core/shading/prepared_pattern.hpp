// Patterns made ready for looking up.
#pragma once

#include <memory>

#include "core/geometry/shape.hpp"
#include "core/shading/rgb.hpp"
#include "core/shading/texture.hpp"
#include "crt/pattern.hpp"

namespace crt::core {

/// A pattern with its picture, if it has one, in linear light. The normals of points point out of
/// the solid that is seen, also where a cutter made its surface.
class PreparedPattern {
 public:
  PreparedPattern(const Pattern& pattern, TexturePool& textures);

  Color color(const SurfacePoint& point) const;
  /// The same, to the last bit, in the lanes that have their bit in `lanes`.
  ColorLanes colors(const SurfacePointLanes& points, std::uint32_t lanes) const;

  /// Whether it looks at u and v.
  bool uses_uv() const { return texture_ != nullptr; }

  /// Whether alpha is 1 everywhere.
  bool opaque() const { return opaque_; }

  /// What no channel of its colours passes.
  double brightest() const { return brightest_; }

  const Pattern& description() const { return pattern_; }

  /// The picture of an image map, null for other patterns.
  const Texture* texture() const { return texture_.get(); }

 private:
  Pattern pattern_;
  std::shared_ptr<const Texture> texture_;
  bool opaque_ = true;
  double brightest_ = 0;
};

}  // namespace crt::core
