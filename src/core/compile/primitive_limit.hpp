// How many primitives a scene may have, so that preparing it does not take all memory of the
// machine.
#pragma once

#include <cstdint>
#include <span>

#include "crt/entity.hpp"
#include "crt/settings.hpp"

namespace crt::core {

/// What a primitive may take while it is prepared, in bytes: 1.3 kB and 2.6 kB were measured of a
/// million boxes and of solids in a tree; a sphere by itself takes 0.5 kB.
inline constexpr std::uint64_t bytes_to_prepare(Precision precision) {
  return precision == Precision::exact ? 2700 : 1350;
}

/// Throws Error (limit) if entities have more primitives than `most`; where that is 0, than there
/// is memory for (at bytes_to_prepare() each), or than are numbered.
void check_primitive_count(std::span<const Entity> entities, Precision precision,
                           std::uint64_t most);

}  // namespace crt::core
