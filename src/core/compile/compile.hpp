// The tree of entities that a user built is compiled to flat lists of leaves and objects.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/compile/part.hpp"
#include "core/compile/primitive_limit.hpp"
#include "core/csg/instance.hpp"
#include "core/csg/program.hpp"
#include "core/ray/ray_hit.hpp"
#include "crt/entity.hpp"
#include "crt/settings.hpp"

#include "core/tasks/workers.hpp"

namespace crt::core {

/// PassingRays are kinds of rays that may pass objects as if these were not there.
using PassingRays = std::uint8_t;
inline constexpr PassingRays passing_none = 0;
inline constexpr PassingRays passing_camera = 1;  ///< see Entity::with_visible()
inline constexpr PassingRays passing_shadow = 2;  ///< see Entity::with_shadow()

/// A SceneObject is what the acceleration structure holds: a lone primitive, a CSG object with
/// several leaves, or an instance.
struct SceneObject {
  /// The leaves of instances have numbers of their own, after those of all others.
  std::uint32_t first_leaf = 0;
  std::uint32_t program = 0xffffffffu;   ///< index of its CSG program, if it has more than one leaf
  std::uint32_t instance = 0xffffffffu;  ///< index of the instance, if it is one
  Bounds bounds;                         ///< in the world
  bool solid = true;
  PassingRays passed_by = passing_none;  ///< these rays do not meet it

  bool is_csg() const { return program != 0xffffffffu; }
  bool is_instance() const { return instance != 0xffffffffu; }
};

struct CompiledScene {
  std::vector<Placement> placements;  ///< leaves point into it
  std::vector<Leaf> leaves;
  std::vector<FaceSurface> face_surfaces;
  std::vector<SceneObject> objects;
  std::vector<CsgProgram> programs;
  std::vector<SharedMaterial> materials;
  /// The placements of the exact tier refer to these.
  TransformPool transforms;
  std::vector<std::shared_ptr<const EntityNode>> entities;
  std::uint64_t shape_bytes = 0;  ///< of all leaves together
  std::vector<Instance> instances;
  /// What instances share has one object each, or none if it is empty. The material numbers of its
  /// leaves are those of the scene.
  std::vector<std::unique_ptr<const CompiledScene>> prototypes;
  std::vector<const TransformChain*> chains;  ///< of a prototype: see PrototypePlacements
  double farthest = 0;                        ///< of a prototype: likewise
  Precision precision = Precision::standard;  ///< of a prototype: likewise

  /// Returns the leaves of an object, and of an instance those of its prototype.
  std::span<const Leaf> leaves_of(const SceneObject& object) const {
    if (object.is_instance()) return prototype_of(object).leaves;
    const std::uint32_t count = object.is_csg() ? programs[object.program].leaf_count() : 1;
    return std::span(leaves).subspan(object.first_leaf, count);
  }
  const CompiledScene& prototype_of(const SceneObject& instance_object) const {
    return *prototypes[instances[instance_object.instance].prototype];
  }
  /// Returns whether a hit is on an instance, whose leaves have numbers after all others.
  bool is_of_instance(const RayHit& hit) const { return hit.leaf >= leaves.size(); }
  /// Returns the leaf that an object's hit is on.
  const Leaf& leaf_of(const RayHit& hit) const {
    if (!is_of_instance(hit)) return leaves[hit.leaf];
    const SceneObject& object = objects[hit.object];
    return prototype_of(object).leaves[hit.leaf - object.first_leaf];
  }
  /// Returns the scene that a hit's leaf is compiled in.
  const CompiledScene& scene_of(const RayHit& hit) const {
    return is_of_instance(hit) ? prototype_of(objects[hit.object]) : *this;
  }
  /// Returns the frame of an object that is an instance.
  InstanceFrame frame_of(const SceneObject& object, InstancePlacements& cache) const {
    const CompiledScene& prototype = prototype_of(object);
    return {instances[object.instance],
            object.instance,
            {prototype.placements, prototype.chains, prototype.farthest, prototype.precision},
            cache};
  }
};

/// Compiles entities. Unions at the top become objects of their own where their parts are disjoint.
/// Transforms are composed once, materials and ids are resolved, and faces that coincide get one
/// surface. It takes O(n log n) on as many threads as `workers` says, and the result is always the
/// same. Throws Error (limit) as the limit says, and if there are more faces than can be numbered.
CompiledScene compile(std::span<const Entity> entities, Precision precision = Precision::standard,
                      const Workers& workers = {}, const PrimitiveLimit& limit = {});

}  // namespace crt::core
