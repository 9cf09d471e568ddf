#include "core/intersect/accelerator.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "core/accel/space_order.hpp"
#include "core/compile/leaf_of_hit.hpp"
#include "core/compile/memory.hpp"
#include "core/intersect/isolated.hpp"
#include "core/math/vector.hpp"
#include "core/ray/line_of_ray.hpp"
#include "core/tasks/parallel.hpp"

namespace crt::core {

namespace {

bool any_surface_is_shared(const CompiledScene& scene) {
  const std::vector<FaceSurface>& faces = scene.face_surfaces;
  const auto is_alone = [&](const FaceSurface& face) {
    return face.surface == static_cast<std::size_t>(&face - faces.data());
  };
  if (std::all_of(faces.begin(), faces.end(), is_alone)) return false;
  std::vector<std::uint32_t> owners(scene.face_surfaces.size(), invalid_index);
  for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
    const SceneObject& solid = scene.objects[object];
    if (solid.is_instance()) continue;
    for (const Leaf& leaf : scene.leaves_of(solid)) {
      for (std::uint32_t face = 0; face < leaf.face_count; ++face) {
        std::uint32_t& owner = owners[scene.face_surfaces[leaf.first_face + face].surface];
        if (owner != invalid_index && owner != object) return true;
        owner = object;
      }
    }
  }
  return false;
}

/// Returns more than what boxes grow by for Embree, and more than the roundings of places.
double margin_of(const Bounds& total) {
  constexpr double of_extent = 0x1p-17;
  constexpr double of_place = 0x1p-40;
  const Vec3 extents = total.upper / 2.0 - total.lower / 2.0;
  return of_extent * largest_component(extents) + of_place * total.farthest();
}

}  // namespace

Accelerator::Accelerator(RecompiledScene recompiled, const Accelerator* earlier,
                         const Workers& workers)
    : compiled_(std::move(recompiled.scene)),
      objects_share_surfaces_(any_surface_is_shared(compiled_)) {
  Bounds total;
  std::vector<std::uint32_t> bounded;
  std::vector<std::uint32_t> unbounded;
  bounded.reserve(compiled_.objects.size());
  for (std::uint32_t i = 0; i < compiled_.objects.size(); ++i) {
    const Bounds& bounds = compiled_.objects[i].bounds;
    kinds_that_pass_ |= compiled_.objects[i].passed_by;
    if (bounds.finite()) {
      bounded.push_back(i);
      total.include(bounds);
      largest_radius_ = std::max(largest_radius_, radius_of(bounds));
    } else {
      unbounded.push_back(i);
    }
  }
  std::unique_ptr<const EarlierProxies> proxies;
  std::vector<std::uint32_t> order;
  if (earlier != nullptr) {
    proxies = std::make_unique<const EarlierProxies>(earlier->proxies_for(recompiled));
    order = order_of_earlier(*earlier, recompiled.earlier_objects, bounded, total, workers);
  }
  const bool is_tree_kept = !order.empty();
  if (is_tree_kept) {
    bounded = std::move(order);
  } else {
    sort_along_curve(compiled_, total, bounded, workers);
  }
  const EarlierProxies* const of_earlier = proxies.get();
  bounded_ = BoundingProxies(compiled_, bounded, workers, of_earlier);
  unbounded_ = BoundingProxies(compiled_, unbounded, workers, of_earlier);
  keep_solids();
  find_enclosed(earlier, recompiled.earlier_objects, workers);
  if (bounded.empty()) return;
  margin_ = margin_of(total);
  farthest_ = total.farthest();
  isolated_ = isolated_objects(compiled_, bounded, unbounded_, margin_, workers);
  build_tree(bounded, total, earlier, is_tree_kept, workers);
}

Accelerator::~Accelerator() = default;

bool Accelerator::all_pass_by(const Bounds& box) const {
  const Bounds around = box.grown(2 * margin_);
  return core::all_pass_by(compiled_, unbounded_, around) &&
         core::all_pass_by(compiled_, bounded_, around);
}

MemoryUse Accelerator::memory() const {
  MemoryUse use{.primitives = primitive_bytes(compiled_), .csg = csg_bytes(compiled_)};
  use.tree = bytes_of(bounded_.list) + bytes_of(unbounded_.list) + solid_bytes(compiled_) +
             bytes_of(enclosed_) + bytes_of(isolated_) + flat_box_list_.bytes() + tree_.bytes();
  return use;
}

void Accelerator::prefetch_surface_points(std::span<const RayHit, packet_size> hits,
                                          RayMask some) const {
  constexpr std::size_t in_cache = 64;
  if (compiled_.leaves.size() <= in_cache) return;
  const auto is_own = [&](const RayHit& hit) {
    return hit.found() && !compiled_.is_of_instance(hit);
  };
  for_each_ray(some, [&](std::size_t i) {
    if (is_own(hits[i])) __builtin_prefetch(&compiled_.leaves[hits[i].leaf].complemented);
  });
  for_each_ray(some, [&](std::size_t i) {
    if (is_own(hits[i])) __builtin_prefetch(compiled_.leaves[hits[i].leaf].shape);
  });
}

std::uint32_t Accelerator::left_for_good(const StartPoint& start) const {
  if (start.leaf >= enclosed_.size() || enclosed_[start.leaf] == invalid_index)
    return invalid_index;
  const Leaf& start_leaf = leaf(start.leaf);
  const bool outwards =
      (start.side == Side::outside) != face_surface(start_leaf, start.face).flipped;
  return outwards || !start_leaf.shape->is_solid() ? enclosed_[start.leaf] : invalid_index;
}

std::uint32_t Accelerator::entered_isolated(const StartPoint& start) const {
  if (isolated_.empty() || start.leaf >= enclosed_.size()) return invalid_index;
  const std::uint32_t object = enclosed_[start.leaf];
  const bool enters = object != invalid_index && isolated_[object] != invalid_index &&
                      left_for_good(start) == invalid_index;
  return enters ? isolated_[object] : invalid_index;
}

bool Accelerator::is_at_end(const WorldRay& ray, const RayHit& hit, RayWorkspace& work) const {
  if (!(ray.end_error > 0)) return false;
  const bool is_known = ray.end_point.is_surface_of(hit);
  if (!is_known && hit.t < certain_end(ray.t_max, ray.end_error, ray.max_size_error)) return false;
  const LeafOfHit in_place(compiled_, hit);
  const Vec3 normal =
      in_place.placement().normal_to_world(in_place.surface_point(ray, hit, false).normal);
  const double slope = std::abs(glm::dot(normal, ray.direction));
  const double error = ray.end_error + size_error(ray, hit.object);
  const double distance = ray.t_max - hit.t;
  const double across = (distance - hit.error) * slope;
  if (across <= error || (ray.is_input && distance <= errors_at_start * hit.error)) return true;
  // Whoever says on which surface a ray ends may have rounded its end to floats.
  constexpr double errors_of_known_end = 0x1p28;
  return is_known && across <= errors_of_known_end * error &&
         is_nearest_to_end(PlacedLeaf(in_place.leaf(), in_place.placement()), ray, hit, work);
}

bool Accelerator::is_nearest_to_end(const PlacedLeaf& leaf, const WorldRay& ray, const RayHit& hit,
                                    RayWorkspace& work) {
  CrossingList& crossings = work.end_crossings;
  crossings.clear();
  const ObjectRay object_ray = leaf.placement.to_object(ray.origin, ray.direction);
  leaf_crossings(leaf, ray, object_ray, crossings, work.leaf_escalations);
  const double distance = std::abs(ray.t_max - hit.t);
  return std::none_of(crossings.begin(), crossings.end(), [&](const Crossing& other) {
    return other.face == hit.face && std::abs(ray.t_max - other.t) < distance;
  });
}

}  // namespace crt::core
