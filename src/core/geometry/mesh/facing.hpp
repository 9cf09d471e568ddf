// Triangles of a closed mesh face out of the solid or into it, as far as that can be proven.
//
// A triangle is *separate* if no other one meets it but in corners and edges that they share. It
// then has the solid on one side everywhere. A line that crosses it enters there or leaves, however
// often it crosses the mesh before or after.
//
// Two triangles are separate if some vector w leads from all of one to all of the other:
// w . q > w . p for all their corners but those that they share. Two that share an edge are so if
// they lie in different planes, or on different sides of the edge. Where this is not found in
// doubles, neither of them counts as separate, and nothing is said of them.
//
// Two separate triangles that alone share an edge have the solid on the same side, if the mesh is
// oriented. So one line that crosses a triangle shows it for all that are connected in this way.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace crt {
class MeshTriangles;
}

namespace crt::core {

enum class Facing : std::uint32_t { unknown, outwards, inwards };

/// An EdgePair is two triangles that share an edge, which no other one has.
struct EdgePair {
  std::uint32_t one;
  std::uint32_t other;
};

/// Finds how the triangles of a closed and oriented mesh face, by their numbers.
std::vector<Facing> find_facing(const MeshTriangles& mesh, std::span<const EdgePair> pairs);

}  // namespace crt::core
