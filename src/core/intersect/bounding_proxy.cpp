#include "core/intersect/bounding_proxy.hpp"

#include <glm/geometric.hpp>

#include "core/geometry/frustum/enclose.hpp"
#include "core/geometry/sphere/enclose.hpp"
#include "core/math/vector.hpp"
#include "core/tasks/parallel.hpp"

namespace crt::core {

namespace {

/// Returns a cylinder around something long, thicker by more than all roundings. Returns null if
/// there is nothing long, or if that cannot be done.
std::unique_ptr<const PlacedSolid> cylinder_around(const Shape& shape, const Placement& placement) {
  const std::optional<CoreSegment> segment = shape.core_segment();
  if (!segment) return nullptr;
  const Vec3 from = placement.point_to_world(segment->from);
  const Vec3 to = placement.point_to_world(segment->to);
  const Vec3 axis = to - from;
  const Transform& world = placement.to_world();
  const double scale = placement.even_scale();
  const double max_scale =
      std::sqrt(glm::dot(world.row_x, world.row_x) + glm::dot(world.row_y, world.row_y) +
                glm::dot(world.row_z, world.row_z));
  const double reach = segment->max_reach() * (scale > 0 ? scale : max_scale);
  constexpr double roundings = 0x1p-40;
  const double radius =
      reach + roundings * (reach + largest_component(from) + largest_component(to));
  if (!has_fair_size(radius) || !has_fair_size(largest_component(axis))) return nullptr;
  // The boxes of what is short miss few rays.
  constexpr double shortest = 4;
  if (!(glm::length(axis) > shortest * radius)) return nullptr;
  return std::make_unique<const PlacedSolidOf<EndlessCylinder>>(
      EndlessCylinder{0.5 * from + 0.5 * to, unit_vector(axis), radius});
}

/// A Proxy is one with the solid that it refers to.
struct Proxy {
  BoundingProxy proxy;
  std::unique_ptr<const PlacedSolid> solid;
};

/// Takes the smallest sphere that has a CSG object within it, and a little more: crossings of other
/// solids next to its surface are known less well.
void bound_csg(const CompiledScene& scene, const SceneObject& object, Proxy& result) {
  const CsgProgram& program = scene.programs[object.program];
  double smallest = infinity;
  for (std::uint32_t i = 0; i < program.leaf_count(); ++i) {
    const Leaf& leaf = scene.leaves[program.first_leaf + i];
    if (!program.is_within(i, leaf)) continue;
    const std::optional<BoundingSphere> sphere = leaf.shape->bounding_sphere();
    if (!sphere) continue;
    constexpr double margin = 1 + 0x1p-20;
    const EnclosedSphere around{sphere->center, sphere->radius * margin};
    const std::optional<EnclosedSphere> placed = around.placed(*leaf.placement);
    if (!placed || placed->off > 0 || !(placed->radius < smallest)) continue;
    // Farther from the origin the rounding of where rays start is not small beside that margin.
    constexpr double max_sizes = 0x1p20;
    if (!(largest_component(placed->center) < max_sizes * placed->radius)) continue;
    smallest = placed->radius;
    result.solid = std::make_unique<const PlacedSolidOf<EnclosedSphere>>(*placed);
    result.proxy.is_within = true;
    result.proxy.faces = &scene.face_surfaces[leaf.first_face];
    result.proxy.face_count = leaf.face_count;
  }
}

void bound_leaf(const CompiledScene& scene, std::uint32_t index, Proxy& result) {
  const Leaf& leaf = scene.leaves[index];
  const Shape& shape = *leaf.shape;
  if (!shape.is_solid()) return;
  BoundingProxy& proxy = result.proxy;
  result.solid = shape.placed(*leaf.placement);
  if (shape.finds_spans(*leaf.placement) && !leaf.exact) {
    proxy.leaf = &leaf;
    proxy.has_quick_spans = leaf.placement->is_identity() && shape.has_quick_spans();
    if (result.solid == nullptr) result.solid = place_box(shape, *leaf.placement);
  }
  if (result.solid == nullptr) {
    result.solid = cylinder_around(shape, *leaf.placement);
    proxy.is_within = true;
    return;
  }
  proxy.leaf_index = index;
  proxy.faces = &scene.face_surfaces[leaf.first_face];
  proxy.face_count = leaf.face_count;
}

Proxy proxy_of(const CompiledScene& scene, std::uint32_t index) {
  const SceneObject& object = scene.objects[index];
  Proxy result;
  if (object.is_csg()) {
    bound_csg(scene, object, result);
  } else if (!object.is_instance()) {
    bound_leaf(scene, object.first_leaf, result);
  }
  result.proxy.object = index;
  result.proxy.passed_by = object.passed_by;
  result.proxy.solid = result.solid.get();
  return result;
}

}  // namespace

BoundingProxies::BoundingProxies(const CompiledScene& scene, std::span<const std::uint32_t> objects,
                                 const Workers& workers)
    : list(objects.size()), solids(objects.size()) {
  for_ranges(objects.size(), items_for_a_thread, workers, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Proxy proxy = proxy_of(scene, objects[i]);
      list[i] = proxy.proxy;
      solids[i] = std::move(proxy.solid);
    }
  });
}

std::size_t BoundingProxies::bytes() const {
  std::size_t bytes = list.capacity() * sizeof(BoundingProxy) +
                      solids.capacity() * sizeof(std::unique_ptr<const PlacedSolid>);
  for (const auto& solid : solids) bytes += solid == nullptr ? 0 : solid->bytes();
  return bytes;
}

}  // namespace crt::core
