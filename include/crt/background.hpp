#pragma once

#include <crt/color.hpp>
#include <crt/image.hpp>
#include <memory>
#include <variant>

namespace crt {

/// One colour in every direction.
struct SolidBackground {
  Color color = {1, 1, 1};
};

/// From `horizon` (level) to `sky` (straight up, and mirrored straight down), linear in |d.y|.
struct GradientBackground {
  Color horizon = {1, 1, 1};
  Color sky = {0.4, 0.6, 1.0};
};

enum class PanoramaProjection {
  spherical,    ///< equirectangular: the full turn across, straight up to straight down
  cylindrical,  ///< the full turn across, a cylinder of height 2 pi h/w up and down; its edge
                ///< beyond that
  equal_area,   ///< the full turn across; down goes (1 - y) / 2 of the unit direction's y, so that
                ///< equal areas of the picture show equal solid angles
};

/// A picture all around: its middle column is straight ahead (+z) and its right half to the right
/// (+x) at angle 0.
struct PanoramaBackground {
  std::shared_ptr<const Image> image{};
  PanoramaProjection projection = PanoramaProjection::spherical;
  /// Turns the picture about y, in radians.
  double angle = 0;
};

/// What a ray that hits nothing sees.
using Background = std::variant<SolidBackground, GradientBackground, PanoramaBackground>;

}  // namespace crt
