// An entity by itself is compiled as in a scene, and asked about its cells.
#pragma once

#include <new>
#include <span>
#include <vector>

#include "core/math/float_environment.hpp"
#include "core/measure/solid_cells.hpp"
#include "crt/entity.hpp"
#include "crt/error.hpp"

namespace crt::core {

class EntityCells {
 public:
  /// Throws Error (invalid_argument) for an entity that is no solid, and as compile() does.
  explicit EntityCells(const Entity& entity);

  /// See CellSolid::unite_near_faces().
  void unite_near_faces();

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

/// Answers a question about entities, with failures to allocate as the library's own errors.
template <class Ask>
auto measured(const Ask& ask) {
  const FloatEnvironment ieee;
  try {
    return ask();
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::out_of_memory, "there is not enough memory to measure the entity");
  }
}

/// Throws Error (invalid_argument) for points that are not finite, or fewer places for answers.
void check_points(std::span<const Vec3> points, std::size_t places, const char* name_of_places);

/// Returns a box around another whose parts have no sides in common with what people write.
Bounds first_box(const Bounds& bounds);

}  // namespace crt::core
