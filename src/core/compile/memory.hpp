// The parts of a prepared scene are measured in bytes.
#pragma once

#include <cstdint>
#include <vector>

#include "core/compile/compile.hpp"

namespace crt::core {

template <class Item>
std::uint64_t bytes_of(const std::vector<Item>& items) {
  return items.capacity() * sizeof(Item);
}

/// Returns the bytes of primitives in their places.
std::uint64_t primitive_bytes(const CompiledScene& scene);

/// Returns the bytes of programs and their trees.
std::uint64_t csg_bytes(const CompiledScene& scene);

/// Returns the bytes of what encloses objects.
std::uint64_t solid_bytes(const CompiledScene& scene);

}  // namespace crt::core
