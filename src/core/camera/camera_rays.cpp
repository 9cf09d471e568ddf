#include "core/camera/camera_rays.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/direction_and_length.hpp"

namespace crt::core {

namespace {

Vec3 unit(const Vec3& v) {
  return direction_and_length(v).direction;
}

/// Where "up" comes from. Within a billionth of a radian of straight up or down the direction's
/// share across y is more rounding than intention, and z takes the place of y.
Vec3 reference_up(const Vec3& forward) {
  constexpr double vertical_angle = 1e-9;
  const bool vertical = std::hypot(forward.x, forward.z) < vertical_angle;
  return vertical ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
}

bool turns_across(Projection projection) {
  return projection == Projection::spherical || projection == Projection::cylindrical;
}

}  // namespace

CameraRays::CameraRays(const Camera& camera, int width, int height)
    : position_(camera.position),
      forward_(unit(camera.pointing - camera.position)),
      projection_(camera.projection),
      aperture_shape_(camera.aperture_shape),
      width_(width),
      height_(height),
      focal_distance_(camera.focal_distance),
      lens_radius_(camera.aperture / 1000) {
  const Vec3 level_right = unit(glm::cross(reference_up(forward_), forward_));
  const Vec3 level_up = glm::cross(forward_, level_right);
  const double cosine = std::cos(camera.roll);
  const double sine = std::sin(camera.roll);
  right_ = unit(cosine * level_right - sine * level_up);
  up_ = unit(cosine * level_up + sine * level_right);

  const double aspect = width_ / height_;
  const double half_angle = camera.fov / 2;
  const double half_length = std::tan(half_angle);
  half_across_ = (turns_across(projection_) ? half_angle : half_length) * aspect;
  half_up_ = projection_ == Projection::spherical ? half_angle : half_length;
}

CameraRay CameraRays::ray(double x, double y) const {
  const CentralRay central = central_ray(x, y);
  return {central.origin, central.direction};
}

CameraRay CameraRays::ray(double x, double y, const LensPoint& lens_point) const {
  const CentralRay central = central_ray(x, y);
  const Vec3 offset = lens_radius_ * (lens_point.x * right_ + lens_point.y * up_);
  const Vec3 to_focus = central.to_focus - offset;
  // A lens wider than the focal distance of a spherical camera can hold the point in focus itself.
  if (to_focus == Vec3(0)) return {central.origin + offset, central.direction};
  return {central.origin + offset, unit(to_focus)};
}

CameraRays::CentralRay CameraRays::central_ray(double x, double y) const {
  const double nx = 2 * x / width_ - 1;
  const double ny = 1 - 2 * y / height_;
  switch (projection_) {
    case Projection::pinhole:
      return pinhole_ray(nx, ny);
    case Projection::spherical:
      return spherical_ray(nx, ny);
    case Projection::cylindrical:
      return cylindrical_ray(nx, ny);
    case Projection::orthographic:
      return orthographic_ray(nx, ny);
  }
  return {position_, forward_, focal_distance_ * forward_};
}

CameraRays::CentralRay CameraRays::pinhole_ray(double nx, double ny) const {
  // Its part along `forward` is 1: times the focal distance it ends on the focal plane.
  const Vec3 to_plane = forward_ + (nx * half_across_) * right_ + (ny * half_up_) * up_;
  return {position_, unit(to_plane), focal_distance_ * to_plane};
}

CameraRays::CentralRay CameraRays::spherical_ray(double nx, double ny) const {
  const double longitude = nx * half_across_;
  const double latitude = ny * half_up_;
  const Vec3 level = std::cos(longitude) * forward_ + std::sin(longitude) * right_;
  const Vec3 direction = unit(std::cos(latitude) * level + std::sin(latitude) * up_);
  return {position_, direction, focal_distance_ * direction};
}

CameraRays::CentralRay CameraRays::cylindrical_ray(double nx, double ny) const {
  const double longitude = nx * half_across_;
  const Vec3 level = std::cos(longitude) * forward_ + std::sin(longitude) * right_;
  const Vec3 direction = unit(level + (ny * half_up_) * up_);
  return {position_, direction, focal_distance_ * direction};
}

CameraRays::CentralRay CameraRays::orthographic_ray(double nx, double ny) const {
  const double across = nx * half_across_ * focal_distance_;
  const double upwards = ny * half_up_ * focal_distance_;
  return {position_ + across * right_ + upwards * up_, forward_, focal_distance_ * forward_};
}

}  // namespace crt::core
