#include "core/measure/entity_cells.hpp"

#include <algorithm>

#include "crt/error.hpp"

namespace crt::core {

EntityCells::EntityCells(const Entity& entity) {
  if (!entity.is_solid()) {
    throw Error(ErrorCode::invalid_argument,
                "only a solid can be measured: " + entity.solid_fault());
  }
  scene_ = compile(std::span(&entity, 1));
  for (const SceneObject& object : scene_.objects) {
    solids_.emplace_back(scene_, object);
    bounds_.include(object.bounds);
  }
}

void EntityCells::unite_near_faces() {
  for (CellSolid& solid : solids_) solid.unite_near_faces();
}

void EntityCells::check_bounded() const {
  if (!solids_.empty() && !bounds_.finite())
    throw Error(ErrorCode::invalid_argument, "the solid has no box around it: it is infinite");
}

bool EntityCells::has_all_functions() const {
  return std::ranges::all_of(solids_, &CellSolid::has_all_functions);
}

void check_points(std::span<const Vec3> points, std::size_t places, const char* name_of_places) {
  if (places < points.size())
    throw Error(ErrorCode::invalid_argument, "there are fewer places than points", name_of_places);
  for (const Vec3& point : points) {
    if (!Bounds{point, point}.finite())
      throw Error(ErrorCode::invalid_argument, "a point must be finite", "points");
  }
}

Bounds first_box(const Bounds& bounds) {
  const CellFrame frame(bounds);
  const Vec3 below = Vec3(0.0171, 0.0193, 0.0127) * frame.half;
  const Vec3 above = Vec3(0.0139, 0.0111, 0.0183) * frame.half;
  return {bounds.lower - below, bounds.upper + above};
}

}  // namespace crt::core
