// Objects are sorted into an order in which neighbours in space are neighbours in memory, too.
#pragma once

#include <cstdint>
#include <span>

#include "core/compile/compile.hpp"
#include "core/tasks/workers.hpp"

namespace crt::core {

/// Sorts objects with finite bounds, all within `total`, along a curve that seldom jumps. Rays that
/// come by one of them then find what they need of the next in the same few pages.
void sort_along_curve(const CompiledScene& scene, const Bounds& total,
                      std::span<std::uint32_t> objects, const Workers& workers = {});

}  // namespace crt::core
