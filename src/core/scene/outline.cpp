#include "core/scene/outline.hpp"

#include <glm/geometric.hpp>

#include "core/math/vector.hpp"
#include "core/scene/compile.hpp"
#include "core/tasks/parallel.hpp"

namespace crt::core {

namespace {

/// By how much a transform scales, if it does so alike in all directions (but for its own roundings); else 0.
double even_scale(const Transform& transform) {
  const std::array<Vec3, 3> rows = {transform.row_x, transform.row_y, transform.row_z};
  const double square = glm::dot(rows[0], rows[0]);
  constexpr double rounding = 0x1p-40;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k <= i; ++k) {
      const double wanted = i == k ? square : 0;
      if (!(std::abs(glm::dot(rows[i], rows[k]) - wanted) <= rounding * square)) return 0;
    }
  }
  return std::sqrt(square);
}

/// Outlines of spheres and planes are where the objects are to the last bit, or there are none.
bool place_exactly(const Surface& surface, const Placement& placement, Outline& outline) {
  const std::optional<Vec3> place = placement.exactly_to_world(surface.position);
  if (place) outline.place = *place;
  return place.has_value();
}

/// That of a torus is thicker by more than all roundings.
bool place_torus(const Surface& surface, const Placement& placement, Outline& outline,
                 OutlineAxis& of_torus) {
  const double scale = even_scale(placement.to_world());
  outline.place = placement.point_to_world(surface.position);
  const Vec3 tip = placement.point_to_world(surface.position + surface.direction);
  const Vec3 axis = tip - outline.place;
  const double size = scale * (surface.sizes[0] + surface.sizes[1]);
  // Where the place is far larger than the axis the difference has too few digits left.
  constexpr double most_sizes = 0x1p12;
  if (!(largest_component(outline.place) < most_sizes * size) || !(largest_component(axis) > 0)) return false;
  if (!(largest_component(outline.place) < most_sizes * largest_component(axis))) return false;
  of_torus.normal = unit_vector(axis);
  constexpr double roundings = 0x1p-30;
  outline.radius = scale * surface.sizes[0];
  of_torus.thickness = scale * surface.sizes[1] + roundings * size;
  return true;
}

/// That of something long is thicker by more than all roundings.
bool place_rod(const Shape& shape, const Placement& placement, Outline& outline, OutlineAxis& of_rod) {
  const std::optional<Spine> spine = shape.spine();
  if (!spine) return false;
  const Vec3 from = placement.point_to_world(spine->from);
  const Vec3 to = placement.point_to_world(spine->to);
  const Vec3 way = to - from;
  const Transform& world = placement.to_world();
  const double scale = even_scale(world);
  const double most_scale =
      std::sqrt(glm::dot(world.row_x, world.row_x) + glm::dot(world.row_y, world.row_y) +
                glm::dot(world.row_z, world.row_z));
  const double reach = spine->most_reach() * (scale > 0 ? scale : most_scale);
  constexpr double roundings = 0x1p-40;
  outline.radius = reach + roundings * (reach + largest_component(from) + largest_component(to));
  if (!has_fair_size(outline.radius) || !has_fair_size(largest_component(way))) return false;
  // The boxes of what is short miss few rays.
  constexpr double shortest = 4;
  if (!(glm::length(way) > shortest * outline.radius)) return false;
  outline.place = 0.5 * from + 0.5 * to;
  of_rod.normal = unit_vector(way);
  return true;
}

/// That of the smallest sphere that has the object within it, a little larger than that: crossings of other
/// solids on its rim are known less well.
Outline outline_of_csg(const CompiledScene& scene, const SceneObject& object) {
  Outline smallest;
  const CsgProgram& program = scene.programs[object.program];
  for (std::uint32_t i = 0; i < program.leaf_count(); ++i) {
    const Leaf& leaf = scene.leaves[program.first_leaf + i];
    if (!program.is_within(i, leaf) || leaf.face_count != 1) continue;
    const Surface surface = leaf.shape->surface(0);
    if (surface.kind != SurfaceKind::sphere) continue;
    Outline outline;
    constexpr double room = 1 + 0x1p-20;
    outline.radius = surface.sizes[0] * room;
    if (!has_fair_size(outline.radius) || !place_exactly(surface, *leaf.placement, outline)) continue;
    // Farther from the origin the rounding of where rays start is not small beside that room.
    constexpr double most_sizes = 0x1p20;
    if (!(largest_component(outline.place) < most_sizes * outline.radius)) continue;
    if (smallest.kind != Outline::Kind::unknown && !(outline.radius < smallest.radius)) continue;
    outline.kind = Outline::Kind::sphere;
    outline.encloses = true;
    outline.surface = scene.face_surfaces[leaf.first_face].surface;
    smallest = outline;
  }
  return smallest;
}

/// Without a transform a box is what its bounds are.
OutlineBox outline_box(const CompiledScene& scene, std::uint32_t index) {
  const Leaf& leaf = scene.leaves[index];
  const Bounds bounds = leaf.shape->bounds();
  OutlineBox box{.lower = bounds.lower, .upper = bounds.upper, .leaf = index, .is_told = !leaf.exact};
  for (std::size_t face = 0; face < OutlineBox::face_count; ++face) {
    const FaceSurface& surface = scene.face_surfaces[leaf.first_face + face];
    box.surfaces[face] = surface.surface;
    box.flipped[face] = surface.flipped;
  }
  return box;
}

Outline outline_of(const CompiledScene& scene, const SceneObject& object, OutlineAxis& axis) {
  Outline outline;
  if (object.is_csg()) return outline_of_csg(scene, object);
  const Leaf& leaf = scene.leaves[object.first_leaf];
  if (!leaf.shape->is_solid()) return outline;
  // Of all shapes only the box has six faces.
  if (leaf.face_count == OutlineBox::face_count && leaf.placement->is_identity()) {
    outline.kind = Outline::Kind::box;
    return outline;
  }
  outline.surface = scene.face_surfaces[leaf.first_face].surface;
  const Surface surface = leaf.shape->surface(0);
  const bool is_frustum = surface.kind == SurfaceKind::cylinder || surface.kind == SurfaceKind::cone;
  if (place_rod(*leaf.shape, *leaf.placement, outline, axis)) {
    outline.kind = Outline::Kind::rod;
  } else {
    outline.radius = 0;
  }
  if (is_frustum && !leaf.exact) {
    outline.kind = Outline::Kind::rod;
    axis.leaf = object.first_leaf;
    axis.moved = &leaf;
    for (std::uint32_t face = 1; face < leaf.face_count; ++face) {
      axis.caps[face - 1] = scene.face_surfaces[leaf.first_face + face].surface;
    }
  }
  if (leaf.face_count != 1 || outline.kind == Outline::Kind::rod) return outline;
  switch (surface.kind) {
    case SurfaceKind::sphere:
      outline.radius = surface.sizes[0];
      if (!has_fair_size(outline.radius)) break;
      if (place_exactly(surface, *leaf.placement, outline)) {
        outline.kind = Outline::Kind::sphere;
      } else {
        outline.radius = 0;
      }
      if (leaf.exact) break;
      // Moved from the origin rays come to it by the very same numbers as if it had always been there.
      if (leaf.placement->is_identity() || (outline.radius > 0 && surface.position == Vec3(0))) {
        outline.detail = object.first_leaf;
      } else {
        outline.kind = Outline::Kind::moved_sphere;
        axis.leaf = object.first_leaf;
        axis.moved = &leaf;
      }
      break;
    case SurfaceKind::plane:
      axis.normal = scaled_to_one(surface.direction);
      if (!place_exactly(surface, *leaf.placement, outline)) break;
      outline.kind = Outline::Kind::plane;
      if (!leaf.exact && leaf.placement->is_identity() && coordinate_axis(axis.normal) >= 0)
        axis.leaf = object.first_leaf;
      break;
    case SurfaceKind::torus:
      if (place_torus(surface, *leaf.placement, outline, axis) && has_fair_size(axis.thickness) &&
          has_fair_size(outline.radius)) {
        outline.kind = Outline::Kind::torus;
        if (!leaf.exact) {
          axis.leaf = object.first_leaf;
          axis.moved = &leaf;
        }
      }
      break;
    default:
      break;
  }
  return outline;
}

}  // namespace

Outlines::Outlines(const CompiledScene& scene, std::span<const std::uint32_t> objects)
    : list(objects.size()) {
  std::vector<OutlineAxis> axis_of(objects.size());
  for_ranges(objects.size(), items_for_a_thread, 0, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      list[i] = outline_of(scene, scene.objects[objects[i]], axis_of[i]);
      list[i].object = objects[i];
    }
  });
  for (std::size_t i = 0; i < list.size(); ++i) {
    Outline& outline = list[i];
    if (outline.has_axis()) {
      outline.detail = static_cast<std::uint32_t>(axes.size());
      axes.push_back(axis_of[i]);
    } else if (outline.kind == Outline::Kind::box) {
      outline.detail = static_cast<std::uint32_t>(boxes.size());
      boxes.push_back(outline_box(scene, scene.objects[outline.object].first_leaf));
    }
  }
  axes.shrink_to_fit();
  boxes.shrink_to_fit();
}

}  // namespace crt::core
