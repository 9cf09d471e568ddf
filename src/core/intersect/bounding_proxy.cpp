#include "core/intersect/bounding_proxy.hpp"

#include <glm/geometric.hpp>

#include "core/compile/compile.hpp"
#include "core/math/vector.hpp"
#include "core/tasks/parallel.hpp"

namespace crt::core {

namespace {

/// Places a proxy where its sphere or plane is, to the last bit. Returns false if no doubles do.
bool place_exactly(const Surface& surface, const Placement& placement, BoundingProxy& proxy) {
  const std::optional<Vec3> place = placement.exactly_to_world(surface.position);
  if (place) proxy.place = *place;
  return place.has_value();
}

/// Places a torus, thicker by more than all roundings. Returns false if that cannot be done.
bool place_torus(const Surface& surface, const Placement& placement, BoundingProxy& proxy,
                 ProxyAxis& of_torus) {
  const double scale = placement.even_scale();
  proxy.place = placement.point_to_world(surface.position);
  const Vec3 tip = placement.point_to_world(surface.position + surface.direction);
  const Vec3 axis = tip - proxy.place;
  const double size = scale * (surface.sizes[0] + surface.sizes[1]);
  // Where the place is far larger than the axis the difference has too few digits left.
  constexpr double most_sizes = 0x1p12;
  if (!(largest_component(proxy.place) < most_sizes * size) || !(largest_component(axis) > 0))
    return false;
  if (!(largest_component(proxy.place) < most_sizes * largest_component(axis))) return false;
  of_torus.normal = unit_vector(axis);
  constexpr double roundings = 0x1p-30;
  proxy.radius = scale * surface.sizes[0];
  of_torus.thickness = scale * surface.sizes[1] + roundings * size;
  return true;
}

/// Places a cylinder around something long, thicker by more than all roundings. Returns false if
/// there is nothing long, or if that cannot be done.
bool place_cylinder(const Shape& shape, const Placement& placement, BoundingProxy& proxy,
                    ProxyAxis& of_cylinder) {
  const std::optional<CoreSegment> segment = shape.core_segment();
  if (!segment) return false;
  const Vec3 from = placement.point_to_world(segment->from);
  const Vec3 to = placement.point_to_world(segment->to);
  const Vec3 axis = to - from;
  const Transform& world = placement.to_world();
  const double scale = placement.even_scale();
  const double most_scale =
      std::sqrt(glm::dot(world.row_x, world.row_x) + glm::dot(world.row_y, world.row_y) +
                glm::dot(world.row_z, world.row_z));
  const double reach = segment->most_reach() * (scale > 0 ? scale : most_scale);
  constexpr double roundings = 0x1p-40;
  proxy.radius = reach + roundings * (reach + largest_component(from) + largest_component(to));
  if (!has_fair_size(proxy.radius) || !has_fair_size(largest_component(axis))) return false;
  // The boxes of what is short miss few rays.
  constexpr double shortest = 4;
  if (!(glm::length(axis) > shortest * proxy.radius)) return false;
  proxy.place = 0.5 * from + 0.5 * to;
  of_cylinder.normal = unit_vector(axis);
  return true;
}

/// Returns the smallest sphere that has a CSG object within it, and a little more: crossings of
/// other solids next to its surface are known less well.
BoundingProxy proxy_of_csg(const CompiledScene& scene, const SceneObject& object) {
  BoundingProxy smallest;
  const CsgProgram& program = scene.programs[object.program];
  for (std::uint32_t i = 0; i < program.leaf_count(); ++i) {
    const Leaf& leaf = scene.leaves[program.first_leaf + i];
    if (!program.is_within(i, leaf) || shape_as<SphereShape>(leaf.shape->typed()) == nullptr)
      continue;
    const Surface surface = leaf.shape->surface(0);
    BoundingProxy proxy;
    constexpr double margin = 1 + 0x1p-20;
    proxy.radius = surface.sizes[0] * margin;
    if (!has_fair_size(proxy.radius) || !place_exactly(surface, *leaf.placement, proxy)) continue;
    // Farther from the origin the rounding of where rays start is not small beside that margin.
    constexpr double most_sizes = 0x1p20;
    if (!(largest_component(proxy.place) < most_sizes * proxy.radius)) continue;
    if (smallest.kind != BoundingProxy::Kind::unknown && !(proxy.radius < smallest.radius))
      continue;
    proxy.kind = BoundingProxy::Kind::sphere;
    proxy.has_test = true;
    proxy.encloses = true;
    proxy.surface = scene.face_surfaces[leaf.first_face].surface;
    smallest = proxy;
  }
  return smallest;
}

/// Returns the box of a leaf without a transform, which is what its bounds are.
ProxyBox proxy_box(const CompiledScene& scene, std::uint32_t index) {
  const Leaf& leaf = scene.leaves[index];
  const Bounds bounds = leaf.shape->bounds();
  ProxyBox box{{bounds.lower, bounds.upper}, index, !leaf.exact};
  for (std::size_t face = 0; face < ProxyBox::face_count; ++face) {
    const FaceSurface& surface = scene.face_surfaces[leaf.first_face + face];
    box.surfaces[face] = surface.surface;
    box.flipped[face] = surface.flipped;
  }
  return box;
}

/// A LoneLeaf is a leaf that is an object of its own.
struct LoneLeaf {
  const CompiledScene& scene;
  std::uint32_t index;
  const Leaf& leaf;
  TypedShape typed;
  Surface surface;  ///< of the first face
};

/// Makes the axis give the leaf's crossings.
void resolve(const LoneLeaf& lone, ProxyAxis& axis) {
  axis.leaf = lone.index;
  axis.moved = &lone.leaf;
  axis.typed = lone.typed;
}

void bound_cylinder(const LoneLeaf& lone, BoundingProxy& proxy, ProxyAxis& axis) {
  proxy.has_test = place_cylinder(*lone.leaf.shape, *lone.leaf.placement, proxy, axis);
  const bool is_resolved = shape_as<FrustumShape>(lone.typed) != nullptr && !lone.leaf.exact;
  if (!proxy.has_test && !is_resolved) return;
  proxy.kind = BoundingProxy::Kind::cylinder;
  if (!is_resolved) return;
  resolve(lone, axis);
  for (std::uint32_t face = 1; face < lone.leaf.face_count; ++face) {
    axis.caps[face - 1] = lone.scene.face_surfaces[lone.leaf.first_face + face].surface;
  }
}

void bound_sphere(const LoneLeaf& lone, BoundingProxy& proxy, ProxyAxis& axis) {
  const Placement& placement = *lone.leaf.placement;
  proxy.radius = lone.surface.sizes[0];
  if (!has_fair_size(proxy.radius)) return;
  proxy.has_test = place_exactly(lone.surface, placement, proxy);
  if (proxy.has_test) proxy.kind = BoundingProxy::Kind::sphere;
  if (lone.leaf.exact) return;
  // Moved from the origin rays come to it by the very same numbers as if it had always been there.
  const bool is_as_if_there = proxy.has_test && lone.surface.position == Vec3(0);
  if (placement.is_identity() || is_as_if_there) {
    proxy.detail = lone.index;
  } else {
    proxy.kind = BoundingProxy::Kind::moved_sphere;
    resolve(lone, axis);
  }
}

void bound_plane(const LoneLeaf& lone, BoundingProxy& proxy, ProxyAxis& axis) {
  axis.normal = scaled_to_one(lone.surface.direction);
  proxy.has_test = place_exactly(lone.surface, *lone.leaf.placement, proxy);
  if (!proxy.has_test) return;
  proxy.kind = BoundingProxy::Kind::plane;
  if (!lone.leaf.exact && lone.leaf.placement->is_identity() && coordinate_axis(axis.normal) >= 0) {
    axis.leaf = lone.index;
  }
}

void bound_torus(const LoneLeaf& lone, BoundingProxy& proxy, ProxyAxis& axis) {
  proxy.has_test = place_torus(lone.surface, *lone.leaf.placement, proxy, axis) &&
                   has_fair_size(axis.thickness) && has_fair_size(proxy.radius);
  if (!proxy.has_test) return;
  proxy.kind = BoundingProxy::Kind::torus;
  if (!lone.leaf.exact) resolve(lone, axis);
}

BoundingProxy proxy_of(const CompiledScene& scene, const SceneObject& object, ProxyAxis& axis) {
  if (object.is_csg()) return proxy_of_csg(scene, object);
  BoundingProxy proxy;
  if (object.is_instance()) return proxy;
  const Leaf& leaf = scene.leaves[object.first_leaf];
  if (!leaf.shape->is_solid()) return proxy;
  const TypedShape typed = leaf.shape->typed();
  if (shape_as<BoxShape>(typed) != nullptr && leaf.placement->is_identity()) {
    proxy.kind = BoundingProxy::Kind::box;
    proxy.has_test = true;
    return proxy;
  }
  proxy.surface = scene.face_surfaces[leaf.first_face].surface;
  const LoneLeaf lone{scene, object.first_leaf, leaf, typed, leaf.shape->surface(0)};
  bound_cylinder(lone, proxy, axis);
  if (shape_as<SphereShape>(typed) != nullptr) bound_sphere(lone, proxy, axis);
  if (shape_as<PlaneShape>(typed) != nullptr) bound_plane(lone, proxy, axis);
  if (shape_as<TorusShape>(typed) != nullptr) bound_torus(lone, proxy, axis);
  return proxy;
}

}  // namespace

BoundingProxies::BoundingProxies(const CompiledScene& scene, std::span<const std::uint32_t> objects,
                                 const Workers& workers)
    : list(objects.size()) {
  std::vector<ProxyAxis> axis_of(objects.size());
  for_ranges(objects.size(), items_for_a_thread, workers, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      list[i] = proxy_of(scene, scene.objects[objects[i]], axis_of[i]);
      list[i].object = objects[i];
    }
  });
  for (std::size_t i = 0; i < list.size(); ++i) {
    BoundingProxy& proxy = list[i];
    if (proxy.has_axis()) {
      proxy.detail = static_cast<std::uint32_t>(axes.size());
      axes.push_back(axis_of[i]);
    } else if (proxy.kind == BoundingProxy::Kind::box) {
      proxy.detail = static_cast<std::uint32_t>(boxes.size());
      boxes.push_back(proxy_box(scene, scene.objects[proxy.object].first_leaf));
    }
  }
  axes.shrink_to_fit();
  boxes.shrink_to_fit();
}

}  // namespace crt::core
