// Some rays start where others have ended.
#pragma once

#include <algorithm>
#include <glm/common.hpp>

#include "core/compile/compile.hpp"
#include "core/csg/evaluate.hpp"

namespace crt::test {

/// Returns a ray that continues from a hit, through it or back.
inline core::WorldRay continued(const core::CompiledScene& scene, const core::CsgObject& object,
                                const core::WorldRay& ray, const core::CsgHit& hit,
                                const Vec3& direction, core::Side side) {
  core::WorldRay next;
  next.origin = ray.origin + hit.t * ray.direction;
  next.direction = direction;
  const core::Leaf& leaf = scene.leaves[object.first_leaf + hit.leaf];
  const core::FaceSurface& surface = scene.face_surfaces[leaf.first_face + hit.face];
  const bool outside = (side == core::Side::outside) != surface.flipped;
  const Vec3 size = glm::abs(next.origin);
  next.start = {.leaf = object.first_leaf + hit.leaf,
                .face = hit.face,
                .surface = surface.surface,
                .side = outside ? core::Side::outside : core::Side::inside,
                .t_error = core::start_rounding * std::max({size.x, size.y, size.z})};
  return next;
}

}  // namespace crt::test
