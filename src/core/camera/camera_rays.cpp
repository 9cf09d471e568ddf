#include "core/camera/camera_rays.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <crt/elementary.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/math/direction_and_length.hpp"
#include "crt/settings.hpp"

namespace crt::core {

namespace {

Vec3 unit(const Vec3& v) {
  return direction_and_length(v).direction;
}

/// Returns the direction that is up. That is y, but z within a billionth of a radian of straight up
/// or down. There the direction's component across y is more rounding than intention.
Vec3 reference_up(const Vec3& forward) {
  constexpr double vertical_angle = 1e-9;
  const bool vertical = elementary::hypot(forward.x, forward.z) < vertical_angle;
  return vertical ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
}

/// Returns how far the lens reaches up and down, in units.
double lens_height(const Camera& camera, int height, int compat) {
  if (camera.lens_radius > 0) return camera.lens_radius;
  return compat == compat_2015 ? camera.aperture / height : camera.aperture / 1000;
}

bool turns_across(Projection projection) {
  return projection == Projection::spherical || projection == Projection::cylindrical;
}

}  // namespace

CameraRays::CameraRays(const Camera& camera, int width, int height, int compat)
    : position_(camera.position),
      forward_(unit(camera.pointing - camera.position)),
      projection_(camera.projection),
      aperture_shape_(camera.aperture_shape),
      width_(width),
      height_(height),
      focal_distance_(camera.focal_distance),
      lens_radius_(lens_height(camera, height, compat)) {
  const Vec3 level_right = unit(glm::cross(reference_up(forward_), forward_));
  const Vec3 level_up = glm::cross(forward_, level_right);
  const double cosine = elementary::cos(camera.roll);
  const double sine = elementary::sin(camera.roll);
  right_ = unit(cosine * level_right - sine * level_up);
  up_ = unit(cosine * level_up + sine * level_right);

  const double aspect = width_ / height_;
  const bool is_round = compat != compat_2015 || camera.lens_radius > 0;
  lens_right_ = is_round ? right_ : right_ / aspect;
  const double half_angle = camera.fov / 2;
  const double half_length = elementary::tan(half_angle);
  half_across_ = (turns_across(projection_) ? half_angle : half_length) * aspect;
  half_up_ = projection_ == Projection::spherical ? half_angle : half_length;
}

Bounds CameraRays::lens_bounds() const {
  constexpr double farthest_point = 2;  // of all aperture shapes
  const Vec3 reach = farthest_point * lens_radius_ * (glm::abs(lens_right_) + glm::abs(up_));
  Bounds bounds;
  bounds.include_around(position_, reach);
  return bounds;
}

CameraRay CameraRays::ray(double x, double y) const {
  CameraRay result;
  ray(x, y, result);
  return result;
}

CameraRay CameraRays::ray(double x, double y, const LensPoint& lens_point) const {
  CameraRay result;
  ray(x, y, lens_point, result);
  return result;
}

std::optional<PicturePlace> CameraRays::place_of(const Vec3& point) const {
  const Vec3 direction = point - position_;
  const double to_right = glm::dot(direction, right_);
  const double to_top = glm::dot(direction, up_);
  const double depth = glm::dot(direction, forward_);
  if (depth <= 0 && !turns_across(projection_)) return std::nullopt;
  const double level = elementary::hypot(to_right, depth);
  double nx = 0;
  double ny = 0;
  switch (projection_) {
    case Projection::pinhole:
      nx = to_right / depth;
      ny = to_top / depth;
      break;
    case Projection::spherical:
      nx = elementary::atan2(to_right, depth);
      ny = elementary::atan2(to_top, level);
      break;
    case Projection::cylindrical:
      nx = elementary::atan2(to_right, depth);
      ny = to_top / level;
      break;
    case Projection::orthographic:
      nx = to_right / focal_distance_;
      ny = to_top / focal_distance_;
      break;
  }
  return PicturePlace{0.5 * width_ * (1 + nx / half_across_), 0.5 * height_ * (1 - ny / half_up_)};
}

double CameraRays::least_pixels_per_unit(const Vec3& point) const {
  const double distance =
      projection_ == Projection::orthographic ? focal_distance_ : glm::length(point - position_);
  return 0.5 * std::min(width_ / half_across_, height_ / half_up_) / distance;
}

void CameraRays::ray(double x, double y, CameraRay& ray) const {
  const double nx = across(x);
  const double ny = upwards(y);
  switch (projection_) {
    case Projection::pinhole:
      ray.origin = position_;
      ray.direction = unit(to_plane(nx, ny));
      break;
    case Projection::spherical:
      spherical_ray(nx, ny, ray);
      break;
    case Projection::cylindrical:
      cylindrical_ray(nx, ny, ray);
      break;
    case Projection::orthographic:
      orthographic_ray(nx, ny, ray);
      break;
  }
}

void CameraRays::ray(double x, double y, const LensPoint& lens_point, CameraRay& result) const {
  ray(x, y, result);
  // A pinhole camera's direction has the component 1 along `forward`. Times the focal distance it
  // ends on the focal plane.
  const bool is_pinhole = projection_ == Projection::pinhole;
  const Vec3 in_focus =
      focal_distance_ * (is_pinhole ? to_plane(across(x), upwards(y)) : result.direction);
  const Vec3 offset = lens_radius_ * (lens_point.x * lens_right_ + lens_point.y * up_);
  const Vec3 to_focus = in_focus - offset;
  result.origin += offset;
  // A lens wider than the focal distance of a spherical camera can hold the point in focus itself.
  if (to_focus != Vec3(0)) result.direction = unit(to_focus);
}

void CameraRays::rays(std::size_t count, std::span<const PicturePlaceLanes> places,
                      std::span<const LensPointLanes> lens_points,
                      std::span<RayLanes> result) const {
  for (std::size_t group = 0; group * lane_count < count; ++group) {
    const PicturePlaceLanes& at = places[group];
    const LensPointLanes* const through = lens_points.empty() ? nullptr : &lens_points[group];
    RayLanes& found = result[group];
    if (!turns_across(projection_) && rays_to_plane(at, through, found)) continue;
    for (std::size_t lane = 0; lane < lane_count && group * lane_count + lane < count; ++lane) {
      CameraRay one;
      if (through != nullptr) {
        ray(at.x[lane], at.y[lane], lane_of(*through, lane), one);
      } else {
        ray(at.x[lane], at.y[lane], one);
      }
      found.origin.set(lane, one.origin);
      found.direction.set(lane, one.direction);
    }
  }
}

bool CameraRays::rays_to_plane(const PicturePlaceLanes& places, const LensPointLanes* lens_points,
                               RayLanes& result) const {
  const bool is_pinhole = projection_ == Projection::pinhole;
  const double scale = is_pinhole ? 1 : focal_distance_;
  const Lanes to_right = across(places.x) * half_across_ * scale;
  const Lanes to_top = upwards(places.y) * half_up_ * scale;
  std::array<Lanes, 3> direction;
  std::array<Lanes, 3> origin;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    direction[i] = lanes_of(forward_[axis]);
    origin[i] = lanes_of(position_[axis]);
    Lanes& moved = is_pinhole ? direction[i] : origin[i];
    moved = moved + to_right * right_[axis] + to_top * up_[axis];
    if (lens_points == nullptr) continue;
    const Lanes offset =
        lens_radius_ * (lens_points->x * lens_right_[axis] + lens_points->y * up_[axis]);
    direction[i] = focal_distance_ * direction[i] - offset;
    origin[i] += offset;
  }
  if (is_pinhole || lens_points != nullptr) {
    const Lanes square = dot(direction, direction);
    if (!all((square > safe_square_min) & (square < safe_square_max))) return false;
    const Lanes length = sqrt(square);
    for (Lanes& component : direction) component /= length;
  }
  result = {.origin = {origin[0], origin[1], origin[2]},
            .direction = {direction[0], direction[1], direction[2]}};
  return true;
}

Vec3 CameraRays::to_plane(double nx, double ny) const {
  return forward_ + (nx * half_across_) * right_ + (ny * half_up_) * up_;
}

void CameraRays::spherical_ray(double nx, double ny, CameraRay& ray) const {
  const double longitude = nx * half_across_;
  const double latitude = ny * half_up_;
  const Vec3 level = elementary::cos(longitude) * forward_ + elementary::sin(longitude) * right_;
  ray.origin = position_;
  ray.direction = unit(elementary::cos(latitude) * level + elementary::sin(latitude) * up_);
}

void CameraRays::cylindrical_ray(double nx, double ny, CameraRay& ray) const {
  const double longitude = nx * half_across_;
  const Vec3 level = elementary::cos(longitude) * forward_ + elementary::sin(longitude) * right_;
  ray.origin = position_;
  ray.direction = unit(level + (ny * half_up_) * up_);
}

void CameraRays::orthographic_ray(double nx, double ny, CameraRay& ray) const {
  const double right = nx * half_across_ * focal_distance_;
  const double up = ny * half_up_ * focal_distance_;
  ray.origin = position_ + right * right_ + up * up_;
  ray.direction = forward_;
}

}  // namespace crt::core
