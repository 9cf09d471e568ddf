// Isolated solids are disjoint from all else: a ray inside of one can meet nothing but it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/compile/compile.hpp"
#include "core/intersect/bounding_proxy.hpp"
#include "core/tasks/workers.hpp"

namespace crt::core {

/// Returns whether the surfaces of all these objects surely pass by a box. The box may be in a
/// half-space.
bool all_pass_by(const CompiledScene& scene, const BoundingProxies& proxies, const Bounds& box);

/// Returns by object its place in `bounded` if it is isolated, else `nothing`; empty if there is
/// none. Light enters such an object, and its box, grown by `margin`, touches no other object's,
/// grown likewise. `bounded` must be in an order in which neighbours are near each other;
/// `unbounded` are the other objects. It takes O(n log n), and objects for which that does not
/// suffice do not count as isolated. Places of `bounded` may be empty: invalid_index.
std::vector<std::uint32_t> isolated_objects(const CompiledScene& scene,
                                            std::span<const std::uint32_t> bounded,
                                            const BoundingProxies& unbounded, double margin,
                                            const Workers& workers = {});

}  // namespace crt::core
