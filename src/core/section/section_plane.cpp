#include "core/section/section_plane.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "core/geometry/bounds.hpp"
#include "core/math/vector.hpp"
#include "crt/error.hpp"

namespace crt::core {

namespace {

/// Returns a direction of length 1. Coordinate axes come out exactly.
Vec3 unit_normal(const Vec3& normal) {
  if (!Bounds{normal, normal}.finite())
    throw Error(ErrorCode::invalid_argument, "the normal must be finite", "normal");
  const double largest = largest_component(normal);
  if (!(largest > 0))
    throw Error(ErrorCode::invalid_argument, "the normal must have a length above 0", "normal");
  const Vec3 scaled = normal * inverse_of_power(power_of_two_below(largest));
  return scaled / glm::length(scaled);
}

/// Returns the place of the one component that is not 0, or -1.
int only_axis(const Vec3& direction) {
  int axis = -1;
  for (int i = 0; i < 3; ++i) {
    if (direction[i] == 0) continue;
    if (axis >= 0) return -1;
    axis = i;
  }
  return axis;
}

/// Returns the frame in which y of the world, or z for a plane across it, is upwards. The world is
/// left-handed: who looks against the normal has x to the right.
SectionFrame frame_of(const Vec3& normal, double offset) {
  SectionFrame frame{.origin = normal * offset, .normal = normal};
  if (normal.x == 0 && normal.z == 0) {
    frame.x_axis = {1, 0, 0};
    frame.y_axis = {0, 0, normal.y > 0 ? 1.0 : -1.0};
    return frame;
  }
  const double length = std::sqrt(normal.x * normal.x + normal.z * normal.z);
  frame.x_axis = Vec3(0 - normal.z, 0, normal.x) / length;
  frame.y_axis = glm::cross(frame.x_axis, normal);
  return frame;
}

}  // namespace

void SectionPlane::move(double by) {
  place += normal_sign * by;
  frame.origin += frame.normal * by;
  frame.offset += by;
}

SectionPlane section_plane(const Vec3& normal, double offset, Entity& entity) {
  if (!std::isfinite(offset))
    throw Error(ErrorCode::invalid_argument, "the offset must be finite", "offset");
  const Vec3 unit = unit_normal(normal);
  SectionPlane plane{.frame = frame_of(unit, offset)};
  plane.frame.offset = offset;
  const int axis = only_axis(unit);
  if (axis >= 0) {
    plane.across = axis;
    plane.normal_sign = unit[axis];
    plane.place = plane.normal_sign * offset;
    plane.first_axis = only_axis(plane.frame.x_axis);
    plane.second_axis = only_axis(plane.frame.y_axis);
    plane.first_sign = plane.frame.x_axis[plane.first_axis];
    plane.second_sign = plane.frame.y_axis[plane.second_axis];
    return plane;
  }
  // The turned entity has x of the drawing along its x, and y along its z.
  entity = entity.transformed({.row_x = plane.frame.x_axis,
                               .row_y = unit,
                               .row_z = plane.frame.y_axis,
                               .translation = {0, 0, 0}});
  plane.across = 1;
  plane.first_axis = 0;
  plane.second_axis = 2;
  plane.place = offset;
  return plane;
}

}  // namespace crt::core
