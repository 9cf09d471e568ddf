// A scene that was edited is compiled from what the one before was compiled to.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/compile/compile.hpp"

namespace crt::core {

/// A RecompiledScene is what compile() would give, with parts of an earlier scene.
struct RecompiledScene {
  CompiledScene scene;
  std::vector<std::uint32_t> earlier_objects;  ///< by object its number there, or invalid_index
  bool keeps_numbers = true;  ///< what is kept has the numbers of leaves, faces and objects there
};

/// Compiles the entities of a scene of which many were in an earlier one. `kept` has for each its
/// place there, or invalid_index; places ascend. `earlier_materials` are those of the earlier
/// scene, which may be others than it was compiled with, and `removed` are its other entities. All
/// else is compiled as compile() would do it, and put where it belongs. So lists, numbers and
/// surfaces are those that compile() gives, and only stores differ.
///
/// Returns nothing where that does not pay, or where what is there depends on what is not: an
/// object is there twice, copies begin or cease to be worth sharing, or a height field has so many
/// faces that only some are listed. Throws Error as compile() does.
std::optional<RecompiledScene> recompile(const CompiledScene& earlier,
                                         const MaterialTable& earlier_materials,
                                         std::span<const Entity> entities,
                                         std::span<const std::uint32_t> kept,
                                         std::span<const EntityNode* const> removed,
                                         Precision precision, const Workers& workers,
                                         const PrimitiveLimit& limit);

}  // namespace crt::core
