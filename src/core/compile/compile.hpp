// The tree of entities that a user built is compiled to flat lists of leaves and objects.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/compile/part.hpp"
#include "core/csg/program.hpp"
#include "crt/entity.hpp"
#include "crt/settings.hpp"

#include "core/tasks/workers.hpp"

namespace crt::core {

/// A SceneObject is what the acceleration structure holds: a lone primitive, or a CSG object with
/// several leaves.
struct SceneObject {
  std::uint32_t first_leaf = 0;
  std::uint32_t program = 0xffffffffu;  ///< index of its CSG program, if it has more than one leaf
  Bounds bounds;                        ///< in the world
  bool solid = true;

  bool is_csg() const { return program != 0xffffffffu; }
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

  std::span<const Leaf> leaves_of(const SceneObject& object) const {
    const std::uint32_t count = object.is_csg() ? programs[object.program].leaf_count() : 1;
    return std::span(leaves).subspan(object.first_leaf, count);
  }
};

/// Compiles entities. Unions at the top become objects of their own where their parts are disjoint.
/// Transforms are composed once, materials and ids are resolved, and faces that coincide get one
/// surface. It takes O(n log n) on as many threads as `workers` says, and the result is always the
/// same. Throws Error (limit) if there are more than 2^25 primitives.
CompiledScene compile(std::span<const Entity> entities, Precision precision = Precision::standard,
                      const Workers& workers = {});

}  // namespace crt::core
