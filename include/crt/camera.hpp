#pragma once

#include <crt/vec.hpp>
#include <numbers>

namespace crt {

/// Says how a camera maps directions to the picture.
enum class Projection { pinhole, spherical, cylindrical, orthographic };

/// Lists the shapes of the lens opening. All but the gaussian are sampled uniformly in area.
/// Lengths are in units of the lens's radius. The polygons have their corners at distance 1, one of
/// them at the top, but the sides of the square are aligned with the picture. `uniform` is the
/// whole square from -1 to 1. `gaussian` has a standard deviation of 1/2 and ends at 2. `line` is
/// horizontal, from -1 to 1.
enum class ApertureShape {
  circle,
  uniform,
  gaussian,
  triangle,
  square,
  pentagon,
  hexagon,
  octagon,
  line
};

/// A Camera says where the picture is seen from.
struct Camera {
  Vec3 position{0, 0, -1};
  /// This is the point looked at. It must not be `position`.
  Vec3 pointing{0, 0, 0};
  /// This is the vertical field of view in radians: in (0, pi) for pinhole and orthographic, in (0,
  /// pi] of latitude for spherical, in (0, pi) for cylindrical.
  double fov = std::numbers::pi / 3;
  /// Turns the camera about its direction, in radians. Positive values tip the picture's top to the
  /// right. At 0 the top is towards y. If the camera looks straight up or down (within 1e-9
  /// radians), the top is towards z.
  double roll = 0;
  Projection projection = Projection::pinhole;
  /// This is the radius of the lens in thousandths of a scene unit (>= 0). 0 is a pinhole: all is
  /// sharp.
  double aperture = 0;
  /// This is the radius of the lens in scene units (>= 0), instead of `aperture`: one of the two
  /// must be 0. With compat_2015, too, it is the radius in all directions.
  double lens_radius = 0;
  /// This is the distance along the view direction to the plane that is in focus (> 0). Spherical
  /// and cylindrical cameras see all around, and are in focus at this distance along each ray. For
  /// an orthographic camera it is also where the image plane has the size that `fov` gives it. Its
  /// rays start in the plane through `position`.
  double focal_distance = 1;
  ApertureShape aperture_shape = ApertureShape::circle;
  /// Cuts the scene open if it is not 0: of solids, only what is against this normal of the plane
  /// {p : section_normal . p = section_offset |section_normal|} is there. Cuts are hatched, as
  /// sectioned() says.
  Vec3 section_normal{0, 0, 0};
  /// This is how far the plane is from the origin along the normal, in scene units.
  double section_offset = 0;
  /// This is the distance of hatching lines in scene units (>= 0). 0 is a 40th of the longest side
  /// of the box around what is cut.
  double section_hatch = 0;
};

/// Says whether the camera cuts the scene open.
inline bool has_section(const Camera& camera) {
  return camera.section_normal != Vec3(0, 0, 0);
}

/// Says whether the camera has a lens of any size. It takes Settings::dof_samples to show.
inline bool has_lens(const Camera& camera) {
  return camera.aperture > 0 || camera.lens_radius > 0;
}

}  // namespace crt
