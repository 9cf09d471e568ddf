// Lights are sampled as a point that may be lit sees them.
#pragma once

#include "core/math/vector_lanes.hpp"
#include "core/shading/rgb.hpp"
#include "crt/light.hpp"
#include "crt/settings.hpp"

namespace crt::core {

/// LightSamples are a light seen from as many points as there are lanes, as if nothing obstructed
/// it.
struct LightSamples {
  VectorLanes directions;  ///< to the light, unit length
  Lanes distances{};       ///< to the light; infinite for a parallel one
  Lanes intensities{};     ///< what distance and the light's own shape leave of it
};

class PreparedLight {
 public:
  PreparedLight(const Light& light, FalloffModel falloff_model);

  const Rgb& color() const { return color_; }

  /// Returns what every point gets of the light, lit or not, if it mirrors nothing.
  Rgb ambient() const { return ambient_ * color_; }

  /// Samples the light at points and returns where it shines. `path_lengths` are the lengths of the
  /// paths from the camera to the points, over all bounces.
  LaneMask sample(const VectorLanes& points, const Lanes& path_lengths, LightSamples& light) const;

 private:
  explicit PreparedLight(const PointLight& light);
  explicit PreparedLight(const ParallelLight& light);
  explicit PreparedLight(const SpotLight& light);
  explicit PreparedLight(const CylinderLight& light);

  enum class Kind { point, parallel, spot, cylinder };

  /// Returns how far the light has come along its axis. It is 0 beside the cylinder, and not above
  /// 0 before the cylinder begins.
  Lanes way_in_cylinder(const VectorLanes& points) const;
  Lanes cone_share(const VectorLanes& to_light) const;

  Kind kind_;
  Rgb color_;
  double ambient_;
  double falloff_ = 0;
  bool counts_path_ = false;
  Vec3 origin_{0, 0, 0};
  Vec3 axis_{0, 0, 0};  ///< the direction in which it shines, unit length
  double radius_ = 0;
  /// The versine 1 - cos of a cone's half angle separates narrow cones, unlike the cosine.
  double rim_versine_ = 0;
  double fading_versine_ = 0;  ///< from the cone's edge to where the light is full
};

}  // namespace crt::core
