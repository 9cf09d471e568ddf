#include "core/intersect/outline.hpp"

#include <glm/geometric.hpp>

#include "core/compile/compile.hpp"
#include "core/math/vector.hpp"
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
    if (!program.is_within(i, leaf) || proxy_as<SphereShape>(leaf.shape->proxy()) == nullptr) continue;
    const Surface surface = leaf.shape->surface(0);
    Outline outline;
    constexpr double room = 1 + 0x1p-20;
    outline.radius = surface.sizes[0] * room;
    if (!has_fair_size(outline.radius) || !place_exactly(surface, *leaf.placement, outline)) continue;
    // Farther from the origin the rounding of where rays start is not small beside that room.
    constexpr double most_sizes = 0x1p20;
    if (!(largest_component(outline.place) < most_sizes * outline.radius)) continue;
    if (smallest.kind != Outline::Kind::unknown && !(outline.radius < smallest.radius)) continue;
    outline.kind = Outline::Kind::sphere;
    outline.is_judged = true;
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

/// A leaf that is an object of its own.
struct LoneLeaf {
  const CompiledScene& scene;
  std::uint32_t index;
  const Leaf& leaf;
  Proxy proxy;
  Surface surface;  ///< of the first face
};

/// From then on the axis tells the leaf's crossings.
void tell(const LoneLeaf& lone, OutlineAxis& axis) {
  axis.leaf = lone.index;
  axis.moved = &lone.leaf;
  axis.proxy = lone.proxy;
}

void outline_rod(const LoneLeaf& lone, Outline& outline, OutlineAxis& axis) {
  outline.is_judged = place_rod(*lone.leaf.shape, *lone.leaf.placement, outline, axis);
  const bool is_told = proxy_as<FrustumShape>(lone.proxy) != nullptr && !lone.leaf.exact;
  if (!outline.is_judged && !is_told) return;
  outline.kind = Outline::Kind::rod;
  if (!is_told) return;
  tell(lone, axis);
  for (std::uint32_t face = 1; face < lone.leaf.face_count; ++face) {
    axis.caps[face - 1] = lone.scene.face_surfaces[lone.leaf.first_face + face].surface;
  }
}

void outline_sphere(const LoneLeaf& lone, Outline& outline, OutlineAxis& axis) {
  const Placement& placement = *lone.leaf.placement;
  outline.radius = lone.surface.sizes[0];
  if (!has_fair_size(outline.radius)) return;
  outline.is_judged = place_exactly(lone.surface, placement, outline);
  if (outline.is_judged) outline.kind = Outline::Kind::sphere;
  if (lone.leaf.exact) return;
  // Moved from the origin rays come to it by the very same numbers as if it had always been there.
  const bool is_as_if_there = outline.is_judged && lone.surface.position == Vec3(0);
  if (placement.is_identity() || is_as_if_there) {
    outline.detail = lone.index;
  } else {
    outline.kind = Outline::Kind::moved_sphere;
    tell(lone, axis);
  }
}

void outline_plane(const LoneLeaf& lone, Outline& outline, OutlineAxis& axis) {
  axis.normal = scaled_to_one(lone.surface.direction);
  outline.is_judged = place_exactly(lone.surface, *lone.leaf.placement, outline);
  if (!outline.is_judged) return;
  outline.kind = Outline::Kind::plane;
  if (!lone.leaf.exact && lone.leaf.placement->is_identity() && coordinate_axis(axis.normal) >= 0) {
    axis.leaf = lone.index;
  }
}

void outline_torus(const LoneLeaf& lone, Outline& outline, OutlineAxis& axis) {
  outline.is_judged = place_torus(lone.surface, *lone.leaf.placement, outline, axis) &&
                      has_fair_size(axis.thickness) && has_fair_size(outline.radius);
  if (!outline.is_judged) return;
  outline.kind = Outline::Kind::torus;
  if (!lone.leaf.exact) tell(lone, axis);
}

Outline outline_of(const CompiledScene& scene, const SceneObject& object, OutlineAxis& axis) {
  if (object.is_csg()) return outline_of_csg(scene, object);
  Outline outline;
  const Leaf& leaf = scene.leaves[object.first_leaf];
  if (!leaf.shape->is_solid()) return outline;
  const Proxy proxy = leaf.shape->proxy();
  if (proxy_as<BoxShape>(proxy) != nullptr && leaf.placement->is_identity()) {
    outline.kind = Outline::Kind::box;
    outline.is_judged = true;
    return outline;
  }
  outline.surface = scene.face_surfaces[leaf.first_face].surface;
  const LoneLeaf lone{scene, object.first_leaf, leaf, proxy, leaf.shape->surface(0)};
  outline_rod(lone, outline, axis);
  if (proxy_as<SphereShape>(proxy) != nullptr) outline_sphere(lone, outline, axis);
  if (proxy_as<PlaneShape>(proxy) != nullptr) outline_plane(lone, outline, axis);
  if (proxy_as<TorusShape>(proxy) != nullptr) outline_torus(lone, outline, axis);
  return outline;
}

}  // namespace

Outlines::Outlines(const CompiledScene& scene, std::span<const std::uint32_t> objects, const Workers& workers)
    : list(objects.size()) {
  std::vector<OutlineAxis> axis_of(objects.size());
  for_ranges(objects.size(), items_for_a_thread, workers, [&](std::size_t begin, std::size_t end) {
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
