// A camera turns a place in the picture into a ray in the world.
//
// Notation: a pixel position (x, y) counts pixels from the picture's top left corner, so the middle
// of the first pixel is (0.5, 0.5). nx and ny are the same place from -1 to 1, to the right and up.
// The camera's directions are left-handed and of unit length: right, up, and forward.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/camera/aperture_shape.hpp"
#include "core/geometry/bounds.hpp"
#include "core/ray/plain_ray.hpp"
#include "crt/camera.hpp"
#include "crt/vec.hpp"

namespace crt::core {

struct CameraRay {
  Vec3 origin{0, 0, 0};
  Vec3 direction{0, 0, 1};  ///< unit length
};

/// A PicturePlace is a pixel position.
using PicturePlace = PlanePoint;
using PicturePlaceLanes = PlanePointLanes;

/// A CameraRays is a camera prepared for a picture of some size. It is immutable.
class CameraRays {
 public:
  /// Takes a camera whose values are valid (crt::validate), a picture of at least one pixel, and
  /// Settings::compat. With `aperture`, a lens of 2015 reaches aperture / width across and
  /// aperture / height up, in units.
  CameraRays(const Camera& camera, int width, int height, int compat = 0);

  /// Returns the ray through the middle of the lens.
  CameraRay ray(double x, double y) const;
  void ray(double x, double y, CameraRay& ray) const;

  /// Returns the ray from a point of the lens (see aperture_point) to where the ray through its
  /// middle is in focus. For pinhole and orthographic cameras that is on the plane at the focal
  /// distance. Spherical and cylindrical ones look backwards too, where no such plane is. They are
  /// in focus at the focal distance along each ray, that is, on a sphere.
  void ray(double x, double y, const LensPoint& lens_point, CameraRay& result) const;
  CameraRay ray(double x, double y, const LensPoint& lens_point) const;

  /// Computes `count` such rays, as many side by side as there are lanes. Without points of the
  /// lens the rays pass through its middle. Lanes beyond the last ray get values of no meaning.
  void rays(std::size_t count, std::span<const PicturePlaceLanes> places,
            std::span<const LensPointLanes> lens_points, std::span<RayLanes> result) const;

  /// Returns where a point appears to a camera without a lens, which may be beside the picture.
  /// Returns nothing for a point behind a camera that does not look there.
  std::optional<PicturePlace> place_of(const Vec3& point) const;

  /// Returns how many pixels there are at least to a unit of length across the view, at a point.
  double least_pixels_per_unit(const Vec3& point) const;

  /// Returns the lens point of two numbers in [0, 1).
  LensPoint lens_point(double u, double v) const { return aperture_point(aperture_shape_, u, v); }

  LensPointLanes lens_points(const Lanes& u, const Lanes& v) const {
    return aperture_points(aperture_shape_, u, v);
  }

  /// Returns a box around all points of the lens.
  Bounds lens_bounds() const;

  /// Returns whether the lens has any size.
  bool has_lens() const { return lens_radius_ > 0; }

  const Vec3& right() const { return right_; }
  const Vec3& up() const { return up_; }
  const Vec3& forward() const { return forward_; }

 private:
  /// Returns the vector from the lens's middle to the plane at distance 1.
  Vec3 to_plane(double nx, double ny) const;
  void spherical_ray(double nx, double ny, CameraRay& ray) const;
  void cylindrical_ray(double nx, double ny, CameraRay& ray) const;
  void orthographic_ray(double nx, double ny, CameraRay& ray) const;
  /// Computes the rays of a pinhole or an orthographic camera. Without lens points they pass
  /// through the middle of the lens. Returns false if lengths are so extreme that each ray must be
  /// computed by itself.
  bool rays_to_plane(const PicturePlaceLanes& places, const LensPointLanes* lens_points,
                     RayLanes& result) const;
  template <class Real>
  Real across(const Real& x) const {
    return 2.0 * x / width_ - 1.0;
  }
  template <class Real>
  Real upwards(const Real& y) const {
    return 1.0 - 2.0 * y / height_;
  }

  Vec3 position_;
  Vec3 right_;
  Vec3 up_;
  Vec3 forward_;
  Projection projection_;
  ApertureShape aperture_shape_;
  double width_;
  double height_;
  /// These are what nx = 1 and ny = 1 stand for: angles in radians where the projection turns,
  /// otherwise lengths on the plane at distance 1.
  double half_across_;
  double half_up_;
  double focal_distance_;
  double lens_radius_;
  Vec3 lens_right_;  ///< `right`, scaled by the lens's width over its height
};

}  // namespace crt::core
