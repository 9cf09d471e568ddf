// Rectangles are sampled evenly over the solid angle that they are seen under.
#pragma once

#include <array>

#include "core/math/vector_lanes.hpp"
#include "core/shading/light_numbers.hpp"

namespace crt::core {

/// A RectangleFrame has unit vectors along a rectangle's edges and out of it, and their lengths.
struct RectangleFrame {
  Vec3 x;
  Vec3 y;
  Vec3 z;
  double width;
  double height;
};

/// A SphericalRectangle is what points see of a rectangle: its projection onto the unit sphere
/// about each of them.
///
/// Source: Urena, Fajardo, King, An area-preserving parametrization for spherical rectangles, EGSR
/// 2013.
class SphericalRectangle {
 public:
  /// `corner` is the rectangle's relative to the points, which must not be in its plane.
  SphericalRectangle(const RectangleFrame& frame, const VectorLanes& corner);

  /// Returns the solid angles, with an absolute error of some roundings.
  const Lanes& solid_angles() const { return solid_angles_; }

  /// Returns points of the rectangle relative to those that see it, spread evenly over the solid
  /// angle.
  VectorLanes sample(const LightNumbers& numbers) const;

 private:
  const RectangleFrame& frame_;
  // The rectangle is [x0, x1] times [y0, y1] at z. These are the notations of the source.
  Lanes x0_;
  Lanes x1_;
  Lanes y0_;
  Lanes y1_;
  Lanes z_;  ///< not above 0
  Lanes b0_;
  Lanes b1_;
  Lanes w0_;  ///< with b0 it is a unit vector
  Lanes cosine_of_k_;
  Lanes sine_of_k_;
  Lanes z_sign_;
  Lanes solid_angles_;
};

}  // namespace crt::core
