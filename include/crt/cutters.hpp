#pragma once

#include <crt/entity.hpp>
#include <cstddef>
#include <vector>

namespace crt {

/// Returns what is taken away in an entity, each at its place: all parts of its differences but the
/// first. So an editor can show the tools of a solid. What the tools themselves are cut by is not
/// listed. A part that occurs twice is listed twice. At most `most` are returned, and the search
/// ends after as many steps as 16 for each of them, so that solids which hold others a million
/// times are no trouble. Throws Error (invalid_argument) if a place of one is beyond what a
/// Transform may be.
std::vector<Entity> cutters(const Entity& entity, std::size_t most);

}  // namespace crt
