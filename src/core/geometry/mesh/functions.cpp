#include "core/geometry/mesh/functions.hpp"

#include "core/geometry/mesh/met_triangles.hpp"
#include "core/geometry/open_nodes.hpp"

namespace crt::core {

void MeshFunctions::look(const PointOf<Interval>& box, NearFaces& near) const {
  const MeshTriangles& mesh = *triangles;
  if (!may_overlap(box, mesh.bounds())) return near.say(NearFaces::Kind::outside);
  Bounds bounds;
  bounds.include({box[0].lo, box[1].lo, box[2].lo});
  bounds.include({box[0].hi, box[1].hi, box[2].hi});
  if (!bounds.finite()) return near.say(NearFaces::Kind::unknown);
  NearFacets<MeshTriangles> near_facets(mesh, mesh.size(), box);
  bool is_plain = true;
  OpenNodes<std::uint32_t, 128> open;
  open.push(0);
  while (!open.empty() && is_plain) {
    mesh.tree().for_each_touching(open.pop(), bounds, [&](BvhChild child) {
      if (!child.is_leaf()) return open.push(child.index());
      for (const MeshTriangles::Placed& placed :
           mesh.placed().subspan(child.index(), child.count()))
        is_plain = is_plain &&
                   near_facets.add(placed.number, mesh.corners_of(placed), placed.plane.faces());
    });
  }
  if (!is_plain) return near.say(NearFaces::Kind::unknown);
  near_facets.look(
      [&](const ObjectRay& ray, CrossingList& out) { return standard_crossings(mesh, ray, out); },
      near);
}

}  // namespace crt::core
