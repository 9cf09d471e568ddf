// The sky of a clear day and its sun are given by a model of daylight.
#pragma once

#include <array>
#include <utility>

#include "core/shading/rgb.hpp"
#include "crt/background.hpp"
#include "crt/light.hpp"

namespace crt::core {

/// A Sky is a SkyBackground ready for looking up. Colours are in its unit, linear sRGB.
///
/// Source: Preetham, Shirley, Smits, A practical analytic model for daylight, SIGGRAPH 1999. The
/// dome is that of its appendix A.2: luminance and chromaticity by formulas of Perez and others.
class Sky {
 public:
  explicit Sky(const SkyBackground& background);

  /// Returns what comes from directions (unit length), without the sun: the dome, or the ground.
  VectorLanes light(const VectorLanes& directions) const;

  /// Returns how bright the sun is in directions: 0 beside it.
  VectorLanes sun(const VectorLanes& directions) const;

  /// Returns the sun as a light. What faces it is as bright as sun() makes it.
  ParallelLight sunlight() const;

  /// Returns whether the sun is above the horizon, even if by a little.
  bool has_sun() const { return !is_black(sun_light_); }

  /// Returns the brightest channel of what is seen, to 10^-3.
  double brightest() const;

 private:
  /// A Part is a quantity that depends on the angles from the zenith and from the sun.
  struct Part {
    double zenith = 0;                     ///< in the zenith, over the formula's value there
    std::array<double, 5> coefficients{};  ///< A to E of the formula; B and D are to base 2

    Lanes operator()(const Lanes& per_height, const Lanes& angle, const Lanes& cosine) const;
  };
  static Part part(const std::array<double, 5>& coefficients, double zenith, double sun_angle);

  /// Returns the level direction towards the sun, and one across it.
  std::pair<Vec3, Vec3> level_axes() const;
  VectorLanes dome(const VectorLanes& directions) const;
  /// Returns what the dome gives a white level surface.
  Rgb dome_on_level() const;

  Vec3 to_sun_;
  double scale_;
  Rgb sun_light_;  ///< what it gives a white surface that faces it
  Rgb sun_disc_;   ///< its radiance
  double rim_;     ///< of the disc, as the chord from its middle
  Part luminance_;
  Part x_;
  Part y_;
  Rgb ground_{0, 0, 0};
};

}  // namespace crt::core
