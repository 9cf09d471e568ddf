// Lights are sampled as a point that may be lit sees them.
#pragma once

#include <numbers>
#include <optional>

#include "core/geometry/bounds.hpp"
#include "core/geometry/surface_piece.hpp"
#include "core/math/vector_lanes.hpp"
#include "core/ray/plain_ray.hpp"
#include "core/shading/light_numbers.hpp"
#include "core/shading/rgb.hpp"
#include "core/shading/spherical_rectangle.hpp"
#include "crt/light.hpp"
#include "crt/settings.hpp"

namespace crt::core {

/// LightSamples are a light seen from as many points as there are lanes, as if nothing obstructed
/// it.
struct LightSamples {
  VectorLanes directions;  ///< to the light, unit length
  Lanes distances{};       ///< to the light; infinite for a parallel one
  /// Says what distance and the light's own shape leave of it. Of a light with a size it is the
  /// projected solid angle over pi, over the density of the sample.
  Lanes intensities{};
  VectorLanes colors;
  /// This is the share of diffuse light that the samples stand for. Rays that surfaces send on find
  /// the rest.
  Lanes diffuse_shares = lanes_of(1);
  Lanes radii{};  ///< of balls and tubes; 0 of what is flat

  /// Returns the densities with which lights that have a size drew these, by solid angle.
  Lanes densities() const { return 1.0 / (std::numbers::pi * intensities); }
};

/// Returns the weight of what one of two ways to draw a direction finds: the balance heuristic.
///
/// Source: Veach, Guibas, Optimally combining sampling techniques for Monte Carlo rendering, 1995.
template <class Real>
Real balanced(const Real& own_density, const Real& other_density) {
  return own_density / (own_density + other_density);
}

class Environment;

/// A LightMet is where rays meet a light that is seen itself.
struct LightMet {
  LaneMask met{};
  Lanes t{};
};

/// A LightView is what points see of a light, whichever samples of it they take. The first one
/// finds it out.
struct LightView {
  bool is_known = false;
  LaneMask near{};                           ///< the points that a flat light is near to
  std::optional<SphericalRectangle> around;  ///< what these see, if there are any
};

/// A LightExtent is where a light with a size is, for all that matters from afar.
struct LightExtent {
  Bounds bounds;
  /// It shines most along this axis, and not at all backwards unless it is two-sided. The axis is 0
  /// if it shines to all sides.
  Vec3 axis{0, 0, 0};
  bool is_two_sided = false;
  double strength = 0;  ///< radiance times the area that is seen, along the axis
};

class PreparedLight {
 public:
  /// `environment` is that of the scene's background, which EnvironmentLights need. It must outlive
  /// the light.
  PreparedLight(const Light& light, FalloffModel falloff_model,
                const Environment* environment = nullptr);

  /// Makes a light of a piece of a surface that gives light off. Rays meet the surface itself.
  PreparedLight(const SurfacePiece& piece, const Rgb& radiance, bool is_two_sided);

  /// Returns its colour, which is 1 for an EnvironmentLight.
  const Rgb& color() const { return color_; }

  /// Returns what every point gets of the light, lit or not, if it mirrors nothing.
  Rgb ambient() const { return ambient_ * color_; }

  /// Returns whether the light has a size, so that sample() needs numbers.
  bool has_size() const { return has_size_; }
  /// Returns whether meet() ever finds anything.
  bool is_visible() const { return is_visible_; }
  /// Returns whether rays that surfaces send on find the light, too.
  bool is_found_by_rays() const { return is_found_by_rays_; }
  /// Returns whether it has a size, and is at a place.
  bool has_extent() const {
    return kind_ == Kind::sphere || kind_ == Kind::disc || kind_ == Kind::rectangle ||
           kind_ == Kind::triangle || kind_ == Kind::tube;
  }
  /// Returns where a light is that has_extent().
  LightExtent extent() const;

  /// Samples the light at points and returns where it shines. `path_lengths` are the lengths of the
  /// paths from the camera to the points, over all bounces. The view is of these points and of this
  /// light, or not known.
  LaneMask sample(const VectorLanes& points, const Lanes& path_lengths, const LightNumbers& numbers,
                  LightSamples& light, LightView& view) const;
  LaneMask sample(const VectorLanes& points, const Lanes& path_lengths, const LightNumbers& numbers,
                  LightSamples& light) const {
    LightView view;
    return sample(points, path_lengths, numbers, light, view);
  }

  /// Returns where lines first meet the light's shining side after their origin. t is off by some
  /// roundings of the coordinates.
  LightMet meet(const RayLanes& lines) const;

  /// Returns the densities with which sample() at the origins draws the directions, which are of
  /// unit length and meet the light at t. They are 0 where it does not shine to.
  Lanes densities(const RayLanes& lines, const Lanes& t) const;

 private:
  explicit PreparedLight(const PointLight& light);
  explicit PreparedLight(const ParallelLight& light);
  explicit PreparedLight(const SpotLight& light);
  explicit PreparedLight(const CylinderLight& light);
  explicit PreparedLight(const SphereLight& light);
  explicit PreparedLight(const DiscLight& light);
  explicit PreparedLight(const RectangleLight& light);
  explicit PreparedLight(const EnvironmentLight& light);

  enum class Kind {
    point,
    parallel,
    spot,
    cylinder,
    ball,
    sun,
    sphere,
    disc,
    rectangle,
    triangle,
    tube,
    environment
  };

  /// Returns how far the light has come along its axis. It is 0 beside the cylinder, and not above
  /// 0 before the cylinder begins.
  Lanes way_in_cylinder(const VectorLanes& points) const;
  Lanes cone_share(const VectorLanes& to_light) const;
  /// Fill in directions, distances and intensities of lights with a size.
  void sample_ball(const VectorLanes& points, const LightNumbers& numbers,
                   LightSamples& light) const;
  void sample_area(const VectorLanes& points, const VectorLanes& on_light,
                   const VectorLanes& normals, const Lanes& areas_over_pi,
                   LightSamples& light) const;
  /// Returns the cosines of directions to a surface with the normals, or 0 where it does not shine.
  Lanes shining_cosines(const VectorLanes& directions, const VectorLanes& normals) const;
  void sample_flat(const VectorLanes& points, const VectorLanes& on_light,
                   LightSamples& light) const;
  /// Returns places of a flat light, spread evenly over its area.
  VectorLanes places(const LightNumbers& numbers) const;
  void sample_tube(const VectorLanes& points, const LightNumbers& numbers,
                   LightSamples& light) const;
  /// Replaces the samples of points that a flat light is near to. They are drawn evenly over the
  /// solid angle of the rectangle around it, and those beside the light find nothing.
  void sample_near(const VectorLanes& points, const LightView& view, const LightNumbers& numbers,
                   LightSamples& light) const;
  /// Returns the points to which a flat light is so near.
  LaneMask are_near(const VectorLanes& points) const;
  /// Returns which places of a flat light's plane, relative to its origin, are on it.
  LaneMask holds(const VectorLanes& places) const;
  /// Finds the points' directions to the tube's axis and across both, and the angle up to which
  /// they see it to either side. It is 0 within.
  struct TubeView {
    VectorLanes outwards;
    VectorLanes across;
    Lanes half_angles{};
  };
  TubeView view_of_tube(const VectorLanes& points) const;
  void set_flat(const Vec3& normal, double area);
  void set_rectangle_around(double area);
  LightMet meet_sphere(const RayLanes& lines) const;
  LightMet meet_plane(const RayLanes& lines) const;

  Kind kind_;
  Rgb color_;
  double ambient_;
  double falloff_ = 0;
  bool counts_path_ = false;
  Vec3 origin_{0, 0, 0};
  Vec3 axis_{0, 0, 0};  ///< the direction in which it shines, or of a tube its own; unit length
  double radius_ = 0;
  /// The versine 1 - cos of a cone's half angle separates narrow cones, unlike the cosine.
  double rim_versine_ = 0;
  double fading_versine_ = 0;  ///< from the cone's edge to where the light is full
  bool has_size_ = false;
  bool is_visible_ = false;
  bool is_found_by_rays_ = false;
  bool is_two_sided_ = false;
  const Environment* environment_ = nullptr;
  double area_over_pi_ = 0;  ///< of a flat light; of a tube that which is seen from afar
  Vec3 edge_a_{0, 0, 0};     ///< of a disc these are half axes
  Vec3 edge_b_{0, 0, 0};
  std::optional<RectangleFrame> around_;  ///< a rectangle around a flat light, if it fits well
  bool fills_around_ = false;             ///< whether it is all of that rectangle
  Vec3 corner_{0, 0, 0};                  ///< of that rectangle
  double near_ = 0;                       ///< the distance from its middle up to which it counts
};

}  // namespace crt::core
