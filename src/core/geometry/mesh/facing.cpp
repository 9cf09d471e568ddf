#include "core/geometry/mesh/facing.hpp"

#include <algorithm>

#include "core/geometry/mesh/connected.hpp"
#include "core/geometry/mesh/met_triangles.hpp"
#include "core/geometry/mesh/self_meetings.hpp"
#include "core/geometry/mesh/triangles.hpp"
#include "core/geometry/triangle/triangle.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

namespace {

/// Finds the winding number in front of a separate triangle, by a line through its middle.
std::optional<int> front_of(const MeshTriangles& mesh, std::uint32_t triangle,
                            CrossingList& crossings) {
  const auto [a, b, c, material] = mesh.triangle(triangle);
  const ObjectRay ray{.origin = a / 3.0 + b / 3.0 + c / 3.0,
                      .direction = -rounded(precise_normal_of(mesh.triangle(triangle)))};
  crossings.clear();
  all_met_triangles(mesh, ray, crossings);
  const auto found =
      std::find_if(crossings.begin(), crossings.end(),
                   [&](const Crossing& crossing) { return crossing.face == triangle; });
  if (found == crossings.end() || !is_alone(*found, crossings)) return std::nullopt;
  return -turns_of(std::span(found, crossings.end()));
}

}  // namespace

Fronts find_fronts(const MeshTriangles& mesh, const SelfMeetings& meetings,
                   std::span<const EdgePair> pairs) {
  Connected connected(mesh.size());
  for (const EdgePair& pair : pairs) {
    if (meetings.is_separate(pair.one) && meetings.is_separate(pair.other)) {
      connected.connect(pair.one, pair.other);
    }
  }
  Fronts fronts(mesh.size());
  std::vector<std::uint8_t> tries(mesh.size());
  CrossingList crossings;
  for (std::uint32_t i = 0; i < mesh.size(); ++i) {
    constexpr std::uint8_t max_tries = 8;  // as a line may meet another triangle right there
    const std::uint32_t lowest = connected.lowest(i);
    if (!meetings.is_separate(i) || fronts[lowest]) continue;
    if (tries[lowest]++ < max_tries) fronts[lowest] = front_of(mesh, i, crossings);
  }
  for (std::uint32_t i = 0; i < mesh.size(); ++i) fronts[i] = fronts[connected.lowest(i)];
  return fronts;
}

Facing facing_by(std::optional<int> front, FillRule fill) {
  if (!front) return Facing::unknown;
  const int outside = fill == FillRule::nonzero ? *front : *front % 2;
  if (outside == 0) return Facing::outwards;
  // By the even-odd rule 1 and -1 are the same.
  return outside == -1 || fill == FillRule::even_odd ? Facing::inwards : Facing::neither;
}

}  // namespace crt::core
