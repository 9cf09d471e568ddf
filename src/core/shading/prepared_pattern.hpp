// Patterns made ready for looking up.
#pragma once

#include <memory>

#include "core/shading/texture.hpp"
#include "crt/pattern.hpp"

namespace crt::core {

/// A point of a surface as a pattern sees it.
struct PatternPoint {
  Vec3 position{0, 0, 0};  ///< in the primitive's own space
  Vec3 normal{0, 1, 0};    ///< unit length, in that space, out of the solid
  double u = 0;
  double v = 0;
};

/// A pattern with its picture, if it has one, in linear light.
class PreparedPattern {
 public:
  PreparedPattern(const Pattern& pattern, TexturePool& textures);

  Color color(const PatternPoint& point) const;

  /// Whether alpha is 1 everywhere.
  bool opaque() const { return opaque_; }

  const Pattern& description() const { return pattern_; }

  /// The picture of an image map, null for other patterns.
  const Texture* texture() const { return texture_.get(); }

 private:
  Pattern pattern_;
  std::shared_ptr<const Texture> texture_;
  bool opaque_ = true;
};

}  // namespace crt::core
