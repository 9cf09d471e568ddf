// Triangles of a closed mesh face out of the solid or into it, as far as that can be proven.
//
// A triangle is *separate* if no other one meets it but in corners and edges that they share. It
// then has the solid on one side everywhere, or on both. A line that crosses it enters there or
// leaves, however often it crosses the mesh before or after.
//
// Two triangles are separate if some vector w leads from all of one to all of the other:
// w . q > w . p for all their corners but those that they share. Two that share an edge are so if
// they lie in different planes, or on different sides of the edge. Where this is not found in
// doubles, neither of them counts as separate, and nothing is said of them.
//
// The winding number of a point says how often an oriented mesh goes about it. It is one less in
// front of a triangle, where its normal points, than behind it. Two separate triangles that alone
// share an edge have the same numbers beside them. So one line that crosses a triangle shows them
// for all that are connected in this way.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "crt/svg_path.hpp"

namespace crt {
class MeshTriangles;
}

namespace crt::core {

class SelfMeetings;

/// Says where the solid is not: where the normal points, behind the triangle, or, for `neither`, on
/// no side.
enum class Facing : std::uint32_t { unknown, outwards, inwards, neither };

/// An EdgePair is two triangles that share an edge, which no other one has.
struct EdgePair {
  std::uint32_t one;
  std::uint32_t other;
};

/// Fronts are the winding numbers in front of triangles, as far as they are known.
using Fronts = std::vector<std::optional<int>>;

/// Finds them for the triangles of a closed and oriented mesh, by their numbers.
Fronts find_fronts(const MeshTriangles& mesh, const SelfMeetings& meetings,
                   std::span<const EdgePair> pairs);

/// Returns how a triangle faces by a rule.
Facing facing_by(std::optional<int> front, FillRule fill);

}  // namespace crt::core
