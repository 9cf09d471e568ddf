#pragma once

#include <crt/vec.hpp>
#include <numbers>

namespace crt {

enum class Projection { pinhole, spherical, cylindrical, orthographic };

/// Shapes of the lens opening; sampled uniformly in area, but for the gaussian. In units of the
/// lens's radius: the polygons have their corners at distance 1, one of them at the top (square:
/// its sides are aligned with the picture); `uniform` is the whole square from -1 to 1; `gaussian`
/// has a standard deviation of 1/2 and ends at 2; `line` is horizontal, from -1 to 1.
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

/// Where the picture is seen from.
struct Camera {
  Vec3 position{0, 0, -1};
  /// The point looked at; must not be `position`.
  Vec3 pointing{0, 0, 0};
  /// Vertical field of view in radians: in (0, pi) for pinhole and orthographic, in (0, pi] of
  /// latitude for spherical, in (0, pi) for cylindrical.
  double fov = std::numbers::pi / 3;
  /// Turns the camera about its direction, in radians; positive tips the picture's top to the
  /// right. At 0 the top is towards y; looking straight up or down (within 1e-9 radians) it is
  /// towards z.
  double roll = 0;
  Projection projection = Projection::pinhole;
  /// Radius of the lens in thousandths of a scene unit (>= 0); 0 is a pinhole: all is sharp.
  double aperture = 0;
  /// Distance along the view direction to the plane that is in focus (> 0); spherical and
  /// cylindrical cameras, which see all around, are in focus at this distance along each ray. For
  /// an orthographic camera also where the image plane has the size that `fov` gives it; its rays
  /// start in the plane through `position`.
  double focal_distance = 1;
  ApertureShape aperture_shape = ApertureShape::circle;
};

}  // namespace crt
