// Which solids keep apart from everything else: a ray inside of one can meet nothing but it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/compile/compile.hpp"
#include "core/intersect/bounding_proxy.hpp"
#include "core/tasks/workers.hpp"

namespace crt::core {

/// By object: its place in `bounded` if light enters it and its box, grown by `margin`, touches no
/// other object's, grown likewise; else nothing. `bounded` are the objects that have an end, in an
/// order in which neighbours are near each other; `unbounded` the others. O(n log n); where that
/// does not suffice to find out, an object does not count as one that keeps apart. Empty if there
/// are none.
std::vector<std::uint32_t> isolated_objects(const CompiledScene& scene,
                                            std::span<const SharedMaterial> materials,
                                            std::span<const std::uint32_t> bounded,
                                            const BoundingProxies& unbounded, double margin,
                                            const Workers& workers = {});

}  // namespace crt::core
