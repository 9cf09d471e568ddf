#include "core/intersect/bounding_proxy.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <iterator>

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
  const CsgProgram& program = scene.program_of(object);
  double smallest = infinity;
  for (std::uint32_t i = 0; i < program.leaf_count(); ++i) {
    const Leaf& leaf = scene.leaves[object.first_leaf + i];
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

/// Returns a proxy of an earlier scene for what its object is in this one.
BoundingProxy moved_proxy(const EarlierProxies& earlier, const CompiledScene& scene,
                          std::uint32_t index) {
  const std::uint32_t before = earlier.objects[index];
  BoundingProxy proxy = *earlier.proxies[before];
  if (earlier.keeps_numbers) {
    if (proxy.leaf != nullptr)
      proxy.leaf = scene.leaves.data() + (proxy.leaf - earlier.scene.leaves.data());
    if (proxy.faces != nullptr) {
      proxy.faces = scene.face_surfaces.data() + (proxy.faces - earlier.scene.face_surfaces.data());
    }
    return proxy;
  }
  proxy.object = index;
  if (scene.objects[index].is_instance()) return proxy;
  const std::uint32_t first_leaf = scene.objects[index].first_leaf;
  const std::uint32_t first_before = earlier.scene.objects[before].first_leaf;
  if (proxy.leaf != nullptr) proxy.leaf = &scene.leaves[first_leaf];
  if (proxy.leaf_index != invalid_index) proxy.leaf_index = first_leaf;
  if (proxy.faces != nullptr) {
    const auto face = proxy.faces - earlier.scene.face_surfaces.data() -
                      earlier.scene.leaves[first_before].first_face;
    proxy.faces = scene.face_surfaces.data() + scene.leaves[first_leaf].first_face + face;
  }
  return proxy;
}

Proxy proxy_of(const CompiledScene& scene, std::uint32_t index, const EarlierProxies* earlier) {
  Proxy result;
  if (index == invalid_index) return result;
  if (earlier != nullptr && earlier->objects[index] != invalid_index)
    return {moved_proxy(*earlier, scene, index), nullptr};
  const SceneObject& object = scene.objects[index];
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
                                 const Workers& workers, const EarlierProxies* earlier)
    : list(objects.size()), solids(objects.size()) {
  for_ranges(objects.size(), items_for_a_thread, workers, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Proxy proxy = proxy_of(scene, objects[i], earlier);
      list[i] = proxy.proxy;
      solids[i] = std::move(proxy.solid);
    }
  });
  std::erase(solids, nullptr);
  // shrink_to_fit() would pass over a lack of memory.
  std::vector<std::unique_ptr<const PlacedSolid>> kept;
  kept.reserve(solids.size());
  std::ranges::move(solids, std::back_inserter(kept));
  solids = std::move(kept);
}

}  // namespace crt::core
