#include "core/csg/one_place.hpp"

#include <glm/geometric.hpp>

#include "core/math/vector.hpp"

namespace crt::core {

namespace {

/// Returns the largest side of a leaf's primitive in the world, or 0 if it has no end.
double size_of(const PlacedLeaf& leaf) {
  const Bounds bounds = leaf.leaf.shape->bounds();
  if (!bounds.finite()) return 0;
  return largest_component(leaf.placement.direction_to_world(bounds.upper - bounds.lower));
}

}  // namespace

double reach_of_place(const PlacedLeaf& leaf, const WorldRay& ray, const Crossing& crossing) {
  if (leaf.leaf.exact) return crossing.error;
  const ObjectRay object_ray = leaf.placement.to_object(ray.origin, ray.direction);
  const SurfacePoint point = leaf.leaf.shape->surface_point(object_ray, crossing, false);
  const Vec3 normal = leaf.placement.normal_to_world(point.normal);
  const double slope = std::abs(glm::dot(normal, ray.direction));
  const Vec3 anchor = leaf.leaf.shape->anchor(crossing.face);
  const double size =
      size_of(leaf) + std::max(largest_component(leaf.placement.point_to_world(point.position)),
                               largest_component(leaf.placement.point_to_world(anchor)));
  // An error of more than the standard tier's own bound is one that the shape states. Where the ray
  // is all but parallel to the surface, the slope does not tell.
  constexpr double largest_rounding = 32 * unit_roundoff;
  constexpr double least_slope = max_reach;
  const bool is_stated = crossing.error * slope > largest_rounding * size &&
                         slope > least_slope * glm::length(ray.direction);
  if (is_stated || !(slope >= 0)) return crossing.error;
  const double across = roundings_of_place * unit_roundoff * size;
  const double farthest = std::fma(std::abs(crossing.t), largest_component(ray.direction),
                                   largest_component(ray.origin));
  const double most = max_reach * std::min(size, farthest) / glm::length(ray.direction);
  const double reach = std::max(crossing.error, slope * most > across ? across / slope : most);
  return std::max(std::min(reach, most), std::min(crossing.error, 2 * rounding_of(crossing.t)));
}

}  // namespace crt::core
