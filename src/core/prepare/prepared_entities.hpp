// The entities of a scene are prepared here, with what an earlier scene had where that was edited.
#pragma once

#include <cstdint>
#include <memory>

#include "core/compile/compile.hpp"
#include "core/compile/primitive_limit.hpp"
#include "core/prepare/node_list.hpp"
#include "core/tasks/workers.hpp"
#include "crt/scene.hpp"

namespace crt::core {

struct Geometry;

/// The PreparedEntities are those of a scene with what rays meet of them.
struct PreparedEntities {
  NodeList nodes;
  std::shared_ptr<const Geometry> geometry;
  std::shared_ptr<const MaterialTable> materials;

  /// Prepares the entities of a scene. What an earlier scene has of them, if it is not null, is
  /// taken from there.
  static PreparedEntities of(const Scene& scene, const PreparedEntities* earlier,
                             std::uint64_t max_primitives, const Workers& workers);

 private:
  /// Takes what it can from the earlier ones, or returns false.
  bool take(const Scene& scene, const PreparedEntities& earlier, const PrimitiveLimit& limit,
            const Workers& workers);
};

}  // namespace crt::core
