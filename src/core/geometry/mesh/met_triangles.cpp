#include "core/geometry/mesh/met_triangles.hpp"

#include <algorithm>

#include "core/geometry/mesh/find_met_triangles.hpp"
#include "core/geometry/mesh/triangles.hpp"

namespace crt::core {

StandardMeshTier::StandardMeshTier(const ObjectRay& ray) : ray_(ray) {
  ray_.start = {};
}

bool StandardMeshTier::meet(const Triangle& triangle, Crossing& crossing) const {
  const PlaneFace::Meeting meeting = TriangleShape(triangle).meet(ray_);
  crossing.t = meeting.t;
  crossing.error = meeting.error;
  return meeting.found;
}

void StandardMeshTier::place(const DoubleDouble& t, Crossing& crossing) const {
  constexpr double last_rounding = 1 + 0x1p-40;
  crossing.t = t.hi;
  crossing.error = rounding_of(t.hi) * last_rounding;
}

int StandardMeshTier::order(const Crossing& first, const Crossing& second) const {
  return first.t < second.t ? -1 : (first.t > second.t ? 1 : 0);
}

bool is_alone(const Crossing& crossing, std::span<const Crossing> all) {
  return std::none_of(all.begin(), all.end(), [&](const Crossing& other) {
    return other.face != crossing.face && lowest(other) <= highest(crossing) &&
           lowest(crossing) <= highest(other);
  });
}

int turns_of(std::span<const Crossing> crossings) {
  int turns = 0;
  for (const Crossing& crossing : crossings) turns += crossing.entering ? 1 : -1;
  return turns;
}

bool append_crossings(const MeshTriangles& mesh, PassingLine& line, const MeshTier& tier,
                      CrossingList& out) {
  return append_met_triangles(mesh, line, tier, out);
}

bool standard_crossings(const MeshTriangles& mesh, const ObjectRay& ray, CrossingList& out) {
  PassingLine line(ray);
  return append_crossings(mesh, line, StandardMeshTier(ray), out);
}

void all_met_triangles(const MeshTriangles& mesh, const ObjectRay& ray, CrossingList& out) {
  PassingLine line(ray);
  MetTriangles(mesh, line, StandardMeshTier(ray), out).append_all();
}

}  // namespace crt::core
