// The number of primitives in a scene is limited, so that preparing it does not take all memory of
// the machine.
#pragma once

#include <cstdint>
#include <span>

#include "crt/entity.hpp"
#include "crt/settings.hpp"

namespace crt::core {

/// Returns the bytes that a primitive may take while it is prepared. For a million boxes 1.3 kB
/// were measured, and for solids in a tree 2.6 kB. A sphere by itself takes 0.5 kB.
inline constexpr std::uint64_t bytes_to_prepare(Precision precision) {
  return precision == Precision::exact ? 2700 : 1350;
}

/// Throws Error (limit) if entities have more primitives than `most`, or more than can be numbered.
/// If `most` is 0, the limit is what there is memory for, at bytes_to_prepare() each.
void check_primitive_count(std::span<const Entity> entities, Precision precision,
                           std::uint64_t most);

}  // namespace crt::core
