#pragma once

#include <crt/color.hpp>
#include <crt/image.hpp>
#include <memory>
#include <variant>

namespace crt {

/// A SolidBackground has one colour in every direction.
struct SolidBackground {
  Color color = {1, 1, 1};
};

/// A GradientBackground changes from `horizon` (level) to `sky` (straight up, and mirrored straight
/// down), linearly in |d.y|.
struct GradientBackground {
  Color horizon = {1, 1, 1};
  Color sky = {0.4, 0.6, 1.0};
};

/// Says how a panorama maps directions to the picture.
enum class PanoramaProjection {
  spherical,    ///< equirectangular: the full turn across, straight up to straight down
  cylindrical,  ///< the full turn across, a cylinder of height 2 pi h/w up and down; the picture's
                ///< edge beyond that
  equal_area,   ///< the full turn across; the height from the top is (1 - y) / 2 of the unit
                ///< direction's y, so that equal areas of the picture show equal solid angles
};

/// A PanoramaBackground is a picture all around. At angle 0 its middle column is straight ahead
/// (+z) and its right half to the right (+x).
struct PanoramaBackground {
  std::shared_ptr<const Image> image{};
  PanoramaProjection projection = PanoramaProjection::spherical;
  /// Turns the picture about y, in radians.
  double angle = 0;
};

/// A Background is what a ray that hits nothing sees.
using Background = std::variant<SolidBackground, GradientBackground, PanoramaBackground>;

}  // namespace crt
