// Surfaces of two compiled scenes, of which a third one is made, are brought together.
#pragma once

#include <cstdint>
#include <span>

#include "core/compile/compile.hpp"

namespace crt::core {

/// A SurfaceSource has the faces of one of the two, with the numbers that they get or, where they
/// are left out, invalid_index. The order is kept.
struct SurfaceSource {
  const CompiledScene& scene;
  std::span<const std::uint32_t> new_faces;
};

/// Numbers the surfaces of the merged scene, whose leaves and faces are there. The faces still have
/// the surfaces of the scene that they are from. Returns false if a leaf of one may be equal to one
/// of the other, in the same place.
bool merge_surfaces(const SurfaceSource& kept, const SurfaceSource& added, CompiledScene& merged);

}  // namespace crt::core
