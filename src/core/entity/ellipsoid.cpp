#include "crt/ellipsoid.hpp"

#include "core/geometry/check_fields.hpp"
#include "crt/schema_primitives.hpp"

namespace crt {

Ellipsoid::operator Entity() const {
  core::check_fields(*this);
  if (radii == Vec3(radii.x))
    return Sphere{.center = center, .radius = radii.x, .material = material};
  const Entity scaled = Entity(Sphere{}).transformed({.row_x = {radii.x, 0, 0},
                                                      .row_y = {0, radii.y, 0},
                                                      .row_z = {0, 0, radii.z},
                                                      .translation = center});
  // What it wears is not scaled.
  return material ? scaled.with_material(*material) : scaled;
}

}  // namespace crt
