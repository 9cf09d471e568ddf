// Solids that are made of others put these into place.
#pragma once

#include "crt/entity.hpp"

namespace crt::core {

/// Moves an entity so that its axes become x, y and z, and its origin becomes a point.
inline Entity placed(const Entity& entity, const Vec3& x, const Vec3& y, const Vec3& z,
                     const Vec3& origin) {
  return entity.transformed({.row_x = {x.x, y.x, z.x},
                             .row_y = {x.y, y.y, z.y},
                             .row_z = {x.z, y.z, z.z},
                             .translation = origin});
}

}  // namespace crt::core
