// The tree of entities that a user built is compiled to flat lists of leaves and objects.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/compile/instancing.hpp"
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
  bool shares_surfaces = false;          ///< with an object before it; said of CSG objects alone
  PassingRays passed_by = passing_none;  ///< these rays do not meet it

  bool is_csg() const { return program != 0xffffffffu; }
  bool is_instance() const { return instance != 0xffffffffu; }
};

struct CompiledScene;

/// A CompiledStore owns what leaves, objects and instances point to. Scenes that were prepared from
/// one another share it.
struct CompiledStore {
  std::vector<Placement> placements;
  std::vector<std::unique_ptr<const Shape>> shapes;
  std::vector<std::unique_ptr<const ExactShape>> exact_shapes;
  std::vector<CsgProgram> programs;
  /// The placements of the exact tier refer to these, and so do instances.
  TransformPool transforms;
  std::vector<std::shared_ptr<const EntityNode>> entities;
  std::vector<std::unique_ptr<const PlacedSolid>> solids;  ///< of bounding proxies
  std::uint64_t shape_bytes = 0;                           ///< of all shapes together
};

/// A MaterialTable says of what material leaves are.
struct MaterialTable {
  std::vector<SharedMaterial> list;
  std::uint32_t default_material = invalid_index;  ///< of leaves without one, if there are any
  std::vector<std::uint32_t> of_leaves;            ///< numbers in the list; those of facets follow
  std::vector<std::uint32_t> of_prototypes;        ///< where the list of each prototype begins

  /// Returns the number of the material of a hit.
  std::uint32_t of(const CompiledScene& scene, const RayHit& hit) const;
};

/// EntityEnds says up to where an entity and those before it reach in the lists of a scene.
struct EntityEnds {
  std::uint32_t leaf = 0;
  std::uint32_t object = 0;
  std::uint32_t program = 0;
  std::uint32_t instance = 0;
  std::uint32_t store = 0;  ///< the number of the store that it is in
};

/// A HashedSurface is the surface of a face. Faces on one surface have one hash.
struct HashedSurface {
  std::uint32_t hash;
  std::uint32_t face;
};

/// A Prototype is what instances share.
struct Prototype {
  const EntityNode* node = nullptr;
  const Material* material = nullptr;  ///< of parts without one
  /// It has one object, or none if it is empty.
  std::shared_ptr<const CompiledScene> scene;
};

struct CompiledScene {
  std::vector<std::shared_ptr<CompiledStore>> stores;  ///< the last may still be added to
  std::vector<Leaf> leaves;
  std::vector<FaceSurface> face_surfaces;
  std::vector<SceneObject> objects;
  std::vector<const CsgProgram*> programs;
  std::vector<std::uint32_t> entity_ids;  ///< of leaves; ray queries need nothing else of them
  std::vector<std::uint32_t> meshes;      ///< the numbers of leaves that are meshes
  std::shared_ptr<const MaterialTable> materials;
  std::vector<Instance> instances;
  std::vector<Prototype> prototypes;
  std::vector<const TransformChain*> chains;  ///< of a prototype: see PrototypePlacements
  double farthest = 0;                        ///< of a prototype: likewise
  Precision precision = Precision::standard;  ///< of a prototype: likewise
  // These serve to keep parts of it for a scene that was edited (recompile.hpp).
  Instancing::Count count;                      ///< of what is compiled
  std::uint64_t expanded_primitives = 0;        ///< of these, in copies that touch others
  std::vector<EntityEnds> entity_ends;          ///< empty if none can be kept
  std::vector<HashedSurface> surfaces;          ///< of all faces, sorted by their hashes
  std::vector<const EntityNode*> shared_nodes;  ///< what is instanced, sorted

  /// Returns the leaves of an object, and of an instance those of its prototype.
  std::span<const Leaf> leaves_of(const SceneObject& object) const {
    if (object.is_instance()) return prototype_of(object).leaves;
    const std::uint32_t count = object.is_csg() ? program_of(object).leaf_count() : 1;
    return std::span(leaves).subspan(object.first_leaf, count);
  }
  const CsgProgram& program_of(const SceneObject& csg_object) const {
    return *programs[csg_object.program];
  }
  CsgObject csg_object(const SceneObject& object) const {
    const CsgProgram& program = program_of(object);
    return {program, std::span(leaves).subspan(object.first_leaf, program.leaf_count()),
            object.first_leaf, face_surfaces, object.shares_surfaces};
  }
  const CompiledScene& prototype_of(const SceneObject& instance_object) const {
    return *prototypes[instances[instance_object.instance].prototype].scene;
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
            {prototype.stores[0]->placements, prototype.chains, prototype.farthest,
             prototype.precision},
            cache};
  }
};

inline std::uint32_t MaterialTable::of(const CompiledScene& scene, const RayHit& hit) const {
  if (!scene.is_of_instance(hit))
    return of_leaves[hit.leaf] + scene.leaves[hit.leaf].material_place(hit.face);
  const SceneObject& object = scene.objects[hit.object];
  const CompiledScene& prototype = scene.prototype_of(object);
  const std::uint32_t leaf = hit.leaf - object.first_leaf;
  return of_prototypes[scene.instances[object.instance].prototype] +
         prototype.materials->of_leaves[leaf] + prototype.leaves[leaf].material_place(hit.face);
}

/// Compiles entities. Unions at the top become objects of their own where their parts are disjoint.
/// Transforms are composed once, materials and ids are resolved, and faces that coincide get one
/// surface. It takes O(n log n) on as many threads as `workers` says, and the result is always the
/// same. Throws Error (limit) as the limit says, and if there are more faces than can be numbered.
CompiledScene compile(std::span<const Entity> entities, Precision precision = Precision::standard,
                      const Workers& workers = {}, const PrimitiveLimit& limit = {});

/// Compiles those of a scene's entities that have these places, in ascending order, as if there
/// were no others. `instancing` and `count` are those of all. Prototypes that `earlier` has are
/// taken from there.
CompiledScene compile_some(std::span<const Entity> entities, std::span<const std::uint32_t> places,
                           Instancing instancing, const Instancing::Count& count,
                           std::span<const Prototype> earlier, Precision precision,
                           const Workers& workers, const PrimitiveLimit& limit);

/// Lists the faces of a leaf that lie on surfaces of leaves before it, if it has many faces.
void list_shared_faces(Leaf& leaf, std::span<const FaceSurface> faces);

/// Gives numbers to the leaves of instances, and notes which CSG objects share surfaces with
/// objects before them. Throws Error (limit) if there are too many leaves.
void finish_numbers(CompiledScene& scene);

}  // namespace crt::core
