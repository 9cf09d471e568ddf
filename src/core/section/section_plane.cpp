#include "core/section/section_plane.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "core/geometry/bounds.hpp"
#include "core/math/drawing_axes.hpp"
#include "crt/error.hpp"

namespace crt::core {

namespace {

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
  const DrawingAxes axes = axes_across(unit);
  SectionPlane plane{.frame = {.origin = unit * offset,
                               .x_axis = axes.x,
                               .y_axis = axes.y,
                               .normal = unit,
                               .offset = offset}};
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
