// Entities of other materials need nothing but other materials.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "core/compile/compile.hpp"
#include "core/prepare/node_list.hpp"

namespace crt::core {

/// Returns the materials of a scene that differs from an earlier one in those entities that have
/// these places, if nothing that rays meet depends on that; else null. All of these entities must
/// be the same but for their materials, and no light may enter them before or after. `scene` is
/// what the earlier one was compiled to, and `nodes` are its entities.
std::shared_ptr<const MaterialTable> recoloured(const CompiledScene& scene,
                                                const MaterialTable& materials,
                                                const NodeList& nodes,
                                                std::span<const Entity> entities,
                                                std::span<const std::uint32_t> places,
                                                Precision precision, const Workers& workers);

}  // namespace crt::core
