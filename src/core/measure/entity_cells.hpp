// An entity by itself is compiled as in a scene, and asked about its cells.
#pragma once

#include <span>
#include <vector>

#include "core/measure/solid_cells.hpp"
#include "crt/entity.hpp"

namespace crt::core {

class EntityCells {
 public:
  /// Throws Error (invalid_argument) for an entity that is no solid, and as compile() does.
  explicit EntityCells(const Entity& entity);

  /// Returns its objects, none of which touches another.
  std::span<const CellSolid> solids() const { return solids_; }
  /// Returns a box around all of it, which may be infinite, or empty.
  const Bounds& bounds() const { return bounds_; }
  /// Throws Error (invalid_argument) if that is infinite.
  void check_bounded() const;
  bool has_all_functions() const;
  bool has_points() const { return !solids_.empty(); }

 private:
  CompiledScene scene_;
  std::vector<CellSolid> solids_;
  Bounds bounds_;
};

/// Returns a box around another whose parts have no sides in common with what people write.
Bounds first_box(const Bounds& bounds);

}  // namespace crt::core
