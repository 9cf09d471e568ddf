// What rays meet is prepared here, from what an earlier scene had where that was edited.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/compile/compile.hpp"
#include "core/compile/recompile.hpp"
#include "core/intersect/accelerator.hpp"
#include "core/tasks/workers.hpp"
#include "crt/settings.hpp"

namespace crt {
class MeshTriangles;
}

namespace crt::core {

/// A Geometry depends on the entities, and on nothing else in the scene but the precision.
struct Geometry {
  Precision precision;
  bool has_csg;
  Accelerator accelerator;
  std::vector<std::shared_ptr<const MeshTriangles>> meshes;  ///< those with warnings, each once

  Geometry(CompiledScene compiled, Precision of_scene, const Workers& workers);
  /// Takes from an earlier one what was made for objects that are the same.
  Geometry(RecompiledScene recompiled, const Geometry& earlier, const Workers& workers);

 private:
  void list_meshes();
};

}  // namespace crt::core
