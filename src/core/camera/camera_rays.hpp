// From a place in the picture to a ray in the world.
//
// Notation: a pixel position (x, y) counts pixels from the picture's top left corner, so the middle
// of the first pixel is (0.5, 0.5). nx and ny are the same place from -1 to 1, to the right and up.
// The camera's directions are left-handed and of unit length: right, up, and forward.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/camera/aperture_shape.hpp"
#include "core/ray/plain_ray.hpp"
#include "crt/camera.hpp"
#include "crt/vec.hpp"

namespace crt::core {

struct CameraRay {
  Vec3 origin{0, 0, 0};
  Vec3 direction{0, 0, 1};  ///< unit length
};

/// A place in the picture, as above.
using PicturePlace = PlanePoint;
using PicturePlaceLanes = PlanePointLanes;

/// A camera made ready for a picture of some size. Immutable.
class CameraRays {
 public:
  /// Takes a camera whose values are valid (crt::validate), a picture of at least one pixel, and
  /// Settings::compat: a lens of 2015 reaches aperture / width across and aperture / height up, in
  /// units.
  CameraRays(const Camera& camera, int width, int height, int compat = 0);

  /// The ray through the middle of the lens.
  CameraRay ray(double x, double y) const;
  void ray(double x, double y, CameraRay& ray) const;

  /// The ray from a point of the lens (see aperture_point) to where the ray through its middle is
  /// in focus: on the plane at the focal distance for pinhole and orthographic cameras. Spherical
  /// and cylindrical ones look backwards too, where no such plane is; they are in focus at the
  /// focal distance along each ray, that is on a sphere.
  void ray(double x, double y, const LensPoint& lens_point, CameraRay& result) const;
  CameraRay ray(double x, double y, const LensPoint& lens_point) const;

  /// `count` of the same rays, as many side by side as there are lanes; without points of the lens
  /// those through its middle. What lanes beyond the last ray get is of no use.
  void rays(std::size_t count, std::span<const PicturePlaceLanes> places,
            std::span<const LensPointLanes> lens_points, std::span<RayLanes> result) const;

  /// Where a point appears, be it beside the picture, of a camera without a lens; nothing behind a
  /// camera that does not look there.
  std::optional<PicturePlace> place_of(const Vec3& point) const;

  /// How many pixels there are at least to a unit of length across the view, at a point.
  double least_pixels_per_unit(const Vec3& point) const;

  /// The lens point of two numbers in [0, 1).
  LensPoint lens_point(double u, double v) const { return aperture_point(aperture_shape_, u, v); }

  LensPointLanes lens_points(const Lanes& u, const Lanes& v) const {
    return aperture_points(aperture_shape_, u, v);
  }

  /// Whether the lens has any size.
  bool has_lens() const { return lens_radius_ > 0; }

  const Vec3& right() const { return right_; }
  const Vec3& up() const { return up_; }
  const Vec3& forward() const { return forward_; }

 private:
  /// Leads from the lens's middle to the plane at distance 1.
  Vec3 to_plane(double nx, double ny) const;
  void spherical_ray(double nx, double ny, CameraRay& ray) const;
  void cylindrical_ray(double nx, double ny, CameraRay& ray) const;
  void orthographic_ray(double nx, double ny, CameraRay& ray) const;
  /// Of a pinhole or an orthographic camera; no lens points for the rays through its middle. False
  /// if lengths are so extreme that each must be found by itself.
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
  /// What nx = 1 and ny = 1 stand for: angles in radians where the projection turns, otherwise
  /// lengths on the plane at distance 1.
  double half_across_;
  double half_up_;
  double focal_distance_;
  double lens_radius_;
  Vec3 lens_right_;  ///< `right`, or as much shorter or longer as the lens is narrower or wider
                     ///< than high
};

}  // namespace crt::core
