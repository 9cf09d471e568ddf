#pragma once

#include <crt/color.hpp>
#include <crt/image.hpp>
#include <crt/vec.hpp>
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

/// A SkyBackground is a clear sky with its sun, above a level ground. It is the one background that
/// is a light by itself: the dome as an EnvironmentLight is, the sun as a ParallelLight with an
/// angle. An EnvironmentLight among the scene's lights takes the place of the dome's.
///
/// The colours of all three are in one unit. In the light of a sun in the zenith at turbidity 3 a
/// white level surface is 1, so that pictures at other times of the day need an exposure. Source:
/// Preetham, Shirley, Smits, A practical analytic model for daylight, SIGGRAPH 1999.
struct SkyBackground {
  /// This is the direction to the sun, of any length but 0. At or below the horizon, which is
  /// level, the sky gets dark, and there is no sun.
  Vec3 sun{-1, 1, -1};
  /// Says how hazy the air is, in [2, 10]: 2 is very clear, 3 clear, 6 and more is haze.
  double turbidity = 3;
  /// Multiplies all of its light.
  double scale = 1;
  /// Is the colour of the ground that is seen below the horizon. Its alpha is ignored.
  Color ground = {0.3, 0.3, 0.3};
  /// It lights the scene. Otherwise it is merely seen, as other backgrounds are.
  bool shines = true;
};

/// This is how wide the sun of a SkyBackground is seen, in radians.
inline constexpr double sun_angle = 0.0093;

/// A Background is what a ray that hits nothing sees.
using Background =
    std::variant<SolidBackground, GradientBackground, PanoramaBackground, SkyBackground>;

}  // namespace crt
