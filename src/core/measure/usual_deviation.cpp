// How near triangles are made to surfaces where nobody says it.
#include "core/geometry/finite_sides.hpp"
#include "crt/surface_mesh.hpp"

namespace crt {

double usual_deviation(std::span<const Entity> entities) {
  constexpr double share_of_side = 1e-3;
  core::FiniteSides sides;
  for (const Entity& entity : entities) {
    if (!entity.is_solid()) continue;
    const BoundingBox box = bounding_box(entity);
    sides.include(box.lower, box.upper);
  }
  const double longest = sides.longest();
  return longest > 0 ? share_of_side * longest : share_of_side;
}

}  // namespace crt
