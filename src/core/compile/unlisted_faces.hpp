// A shape of very many faces, a large height field, has only those in the table of face surfaces
// that may coincide with faces of others.
#pragma once

#include <span>

#include "core/csg/program.hpp"
#include "core/tasks/workers.hpp"

namespace crt::core {

/// Finds which faces of leaves with unlisted faces lie in planes of other leaves whose boxes touch
/// them, and lists these. Leaves that have more than 2^16 faces each are not compared with one
/// another. It takes O(n) for n leaves, and for each plane the time to follow it through the cells.
void find_unlisted_faces(std::span<Leaf> leaves, const Workers& workers);

}  // namespace crt::core
