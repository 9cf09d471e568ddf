// A point is a cell of no size. What may be 0 there, as far as rounding lets one know, is a surface
// that the point is on, if that makes a difference.
#include <cmath>

#include "core/compile/compile.hpp"
#include "core/math/float_environment.hpp"
#include "core/measure/entity_cells.hpp"
#include "core/tasks/parallel.hpp"
#include "crt/error.hpp"
#include "crt/measure.hpp"
#include "crt/prepared_scene.hpp"
#include "crt/query.hpp"
#include "crt/scene.hpp"

namespace crt {

namespace core {

namespace {

PointSide side_of_point(const EntityCells& cells, const Vec3& point) {
  PointSide side = PointSide::outside;
  for (const CellSolid& solid : cells.solids()) {
    const CellLook look = solid.look(solid.cell({point, point}));
    if (look.kind == CellLook::Kind::full) return PointSide::inside;
    if (look.kind != CellLook::Kind::empty) side = PointSide::on;
  }
  return side;
}

/// Asks rays what is not known of a box: they know all, but not that a point is on a surface.
void ask_rays(const Entity& entity, std::span<const Vec3> points, std::span<PointSide> sides) {
  Scene scene;
  scene.entities = {entity};
  RayQueries queries(prepare(scene));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (sides[i] != PointSide::on) continue;
    Location location;
    queries.locate(points.subspan(i, 1), std::span(&location, 1));
    sides[i] = location.entity_id == no_entity_id ? PointSide::outside : PointSide::inside;
  }
}

}  // namespace

}  // namespace core

void contains(const Entity& entity, std::span<const Vec3> points, std::span<PointSide> sides,
              int threads) {
  core::check_points(points, sides.size(), "sides");
  core::measured([&] {
    const core::EntityCells cells(entity);
    constexpr std::size_t points_of_task = 256;
    core::for_ranges(points.size(), points_of_task, threads,
                     [&](std::size_t begin, std::size_t end) {
                       for (std::size_t i = begin; i < end; ++i)
                         sides[i] = core::side_of_point(cells, points[i]);
                     });
    if (!cells.has_all_functions()) core::ask_rays(entity, points, sides);
  });
}

PointSide contains(const Entity& entity, const Vec3& point) {
  PointSide side = PointSide::outside;
  contains(entity, std::span(&point, 1), std::span(&side, 1), 1);
  return side;
}

}  // namespace crt
