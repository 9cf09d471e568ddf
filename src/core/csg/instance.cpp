#include "core/csg/instance.hpp"

#include "core/math/vector.hpp"

namespace crt::core {

void ComposedPlacement::set(const TransformChain* second, const TransformChain* first,
                            Precision precision) {
  const TransformChain* map = second != nullptr ? second : first;
  if (second != nullptr && first != nullptr) {
    chain_ = compose(*second, *first);
    map = &chain_;
  }
  if (map == nullptr) {
    placement_ = {};
  } else {
    placement_ = precision == Precision::exact ? Placement(*map) : Placement(map->product);
  }
}

RaySlabs InstanceFrame::slabs(const WorldRay& ray) const {
  const Placement& of_space = placement(0);
  const ObjectRay local = of_space.to_object(ray.origin, ray.direction);
  // The ray is rounded once, and so are the numbers of the map that places a leaf in the world.
  constexpr double rounding = 0x1p-50;
  const Transform& map = of_space.to_world();
  const double stretch =
      largest_component(map.row_x) + largest_component(map.row_y) + largest_component(map.row_z);
  const double in_world = largest_component(map.translation) + 3 * stretch * prototype_.farthest;
  return {local.origin, local.direction,
          rounding * largest_component(local.origin) +
              of_space.largest_stretch_to_object() * (ray.start.t_error + rounding * in_world)};
}

}  // namespace crt::core
