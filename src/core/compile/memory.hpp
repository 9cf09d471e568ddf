// How many bytes the parts of a prepared scene take.
#pragma once

#include <cstdint>
#include <vector>

#include "core/compile/compile.hpp"

namespace crt::core {

template <class Item>
std::uint64_t bytes_of(const std::vector<Item>& items) {
  return items.capacity() * sizeof(Item);
}

/// Primitives in their places.
std::uint64_t primitive_bytes(const CompiledScene& scene);

/// Programs and their trees.
std::uint64_t csg_bytes(const CompiledScene& scene);

}  // namespace crt::core
