// The leaf that was hit, or that a ray starts on, with its place in the world and its ids.
#pragma once

#include <optional>

#include "core/compile/compile.hpp"

namespace crt::core {

/// A LeafOfHit finds the leaf that a hit is on. For one of an instance it computes the placement.
class LeafOfHit {
 public:
  LeafOfHit(const CompiledScene& scene, const RayHit& hit) : leaf_(&scene.leaf_of(hit)) {
    placement_ = leaf_->placement;
    if (scene.is_of_instance(hit)) place_instance(scene, scene.objects[hit.object]);
  }
  LeafOfHit(const LeafOfHit&) = delete;
  LeafOfHit& operator=(const LeafOfHit&) = delete;

  const Leaf& leaf() const { return *leaf_; }
  const Placement& placement() const { return *placement_; }
  /// Returns the point of the hit, which `ray` found, in the leaf's space; u and v only if asked
  /// for.
  SurfacePoint surface_point(const WorldRay& ray, const RayHit& hit, bool with_uv) const {
    const Crossing crossing{.t = hit.t,
                            .error = hit.error,
                            .face = hit.face,
                            .root = 0,
                            .entering = hit.entering != leaf_->complemented};
    return leaf_->shape->surface_point(placement_->to_object(ray.origin, ray.direction), crossing,
                                       with_uv);
  }

 private:
  void place_instance(const CompiledScene& scene, const SceneObject& object);

  const Leaf* leaf_;
  const Placement* placement_;
  std::optional<ComposedPlacement> composed_;
};

/// Returns where a ray starts, for an object that is an instance: by the prototype's numbers if the
/// start is on it, and else in free space.
inline StartPoint start_in_prototype(const CompiledScene& scene, const SceneObject& object,
                                     const StartPoint& start) {
  const CompiledScene& prototype = scene.prototype_of(object);
  StartPoint result{.t_error = start.t_error};
  const std::uint32_t leaf = start.leaf - object.first_leaf;
  if (start.leaf < object.first_leaf || leaf >= prototype.leaves.size()) return result;
  result.leaf = leaf;
  result.face = start.face;
  result.side = start.side;
  result.surface = prototype.leaves[leaf].surface_of(start.face, prototype.face_surfaces).surface;
  return result;
}

/// Ids are the user's numbers of what was hit.
struct Ids {
  std::uint32_t entity = 0;
  std::uint32_t part = 0;
  std::uint64_t user = 0;
};

inline Ids ids_of(const CompiledScene& scene, const RayHit& hit) {
  const Leaf& leaf = scene.leaf_of(hit);
  Ids ids{leaf.entity_id, leaf.part_id, leaf.user};
  if (!scene.is_of_instance(hit)) return ids;
  const Instance& instance = scene.instances[scene.objects[hit.object].instance];
  if (leaf.takes_entity_id || instance.id_is_of_all) ids.entity = instance.entity_id;
  if (leaf.takes_part_id) ids.part = instance.part_id;
  if (leaf.takes_user) ids.user = instance.user;
  return ids;
}

}  // namespace crt::core
