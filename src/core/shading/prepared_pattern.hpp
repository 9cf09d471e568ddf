// Patterns are prepared for looking up.
#pragma once

#include <memory>

#include "core/geometry/shape.hpp"
#include "core/shading/rgb.hpp"
#include "core/shading/texture.hpp"
#include "crt/pattern.hpp"

namespace crt::core {

/// A PreparedPattern is a pattern with its picture, if it has one, in linear light. The normals of
/// points point out of the solid that is seen, also where a cutter made its surface.
class PreparedPattern {
 public:
  PreparedPattern(const Pattern& pattern, TexturePool& textures);

  Color color(const SurfacePoint& point) const;
  /// Returns the colours that color() gives, to the last bit, in the lanes that have their bit in
  /// `lanes`.
  ColorLanes colors(const SurfacePointLanes& points, std::uint32_t lanes) const;

  /// Returns whether the pattern uses u and v.
  bool uses_uv() const { return uses_uv_; }

  /// Returns whether alpha is 1 everywhere.
  bool opaque() const { return opaque_; }

  /// Returns a bound on all channels of the pattern's colours.
  double brightest() const { return brightest_; }

  const Pattern& description() const { return pattern_; }

  /// Returns the picture of an image map, or null for other patterns.
  const Texture* texture() const { return texture_.get(); }

  /// These are the patterns in the place of its colours, or null.
  const PreparedPattern* pattern_a() const { return pattern_a_.get(); }
  const PreparedPattern* pattern_b() const { return pattern_b_.get(); }

 private:
  template <class Kind>
  void prepare_colors(const Kind& kind, TexturePool& textures);
  Color composed_color(const SurfacePoint& point) const;

  Pattern pattern_;
  std::shared_ptr<const Texture> texture_;
  std::shared_ptr<const PreparedPattern> pattern_a_;
  std::shared_ptr<const PreparedPattern> pattern_b_;
  bool is_composed_ = false;  ///< of patterns, or of more colours than two
  bool uses_uv_ = false;
  bool opaque_ = true;
  double brightest_ = 0;
};

}  // namespace crt::core
