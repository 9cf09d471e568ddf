// How near triangles are made to surfaces where nobody says it.
#include <algorithm>
#include <cmath>
#include <limits>

#include "crt/surface_mesh.hpp"

namespace crt {

double usual_deviation(std::span<const Entity> entities) {
  constexpr double share_of_side = 1e-3;
  Vec3 lower(std::numeric_limits<double>::infinity());
  Vec3 upper = -lower;
  double longest = 0;
  for (const Entity& entity : entities) {
    if (!entity.is_solid()) continue;
    const BoundingBox box = bounding_box(entity);
    for (int axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(box.upper[axis] - box.lower[axis])) continue;
      lower[axis] = std::min(lower[axis], box.lower[axis]);
      upper[axis] = std::max(upper[axis], box.upper[axis]);
      longest = std::max(longest, upper[axis] - lower[axis]);
    }
  }
  return longest > 0 ? share_of_side * longest : share_of_side;
}

}  // namespace crt
