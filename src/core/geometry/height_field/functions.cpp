#include "core/geometry/height_field/functions.hpp"

#include <algorithm>
#include <vector>

#include "core/geometry/height_field/height_field.hpp"

namespace crt::core {

void HeightFieldFunctions::look(const PointOf<Interval>& box, NearFaces& near) const {
  const Bounds& bounds = facets->bounds();
  if (!may_overlap(box, bounds)) return near.say(NearFaces::Kind::outside);
  PointOf<Interval> within = box;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<int>(i);
    // Above the bounds it is empty, which the functions of the surface say.
    const double upper = i == 1 ? infinity : bounds.upper[axis];
    within[i] = {std::max(box[i].lo, bounds.lower[axis]), std::min(box[i].hi, upper)};
  }
  look_at_surface(within, near);
  bool is_on_side = box[1].lo <= bounds.lower.y;
  for (std::uint32_t side = 0; side < HeightFacets::side_count; ++side) {
    const std::size_t i = side / 2 == 0 ? 0 : 2;
    const auto axis = static_cast<int>(i);
    const bool crosses =
        side % 2 == 0 ? box[i].lo <= bounds.lower[axis] : box[i].hi >= bounds.upper[axis];
    if (crosses) near.keep_within(side);
    is_on_side = is_on_side || crosses;
  }
  if (box[1].lo <= bounds.lower.y) near.keep_within(HeightFacets::bottom_face);
  // A line through a point of an edge may only touch the solid.
  if (is_on_side && near.kind == NearFaces::Kind::outside && is_one_point(box))
    near.say(NearFaces::Kind::unknown);
}

/// Says what is known of a box that is below or above the surface.
void HeightFieldFunctions::look_at_surface(const PointOf<Interval>& box, NearFaces& near) const {
  const Bounds& bounds = facets->bounds();
  const std::uint32_t face_count = facets->face_count();
  const double share = (box[0].width() / (bounds.upper.x - bounds.lower.x)) *
                       (box[2].width() / (bounds.upper.z - bounds.lower.z));
  constexpr double most_faces = 256;
  near.say(NearFaces::Kind::unknown);
  if (share * face_count > most_faces || !(box[1].width() < infinity)) return;
  NearFacets<HeightFacets> near_facets(*facets, face_count, box);
  const Bounds touched{{box[0].lo, box[1].lo, box[2].lo}, {box[0].hi, box[1].hi, box[2].hi}};
  std::vector<std::uint32_t> faces;
  facets->append_near({Vec3(0), 0}, touched, faces);
  for (const std::uint32_t face : faces) {
    const Triangle triangle = facets->triangle(face);
    const Facing facing = facets->facing_of({triangle, face});
    if (!near_facets.add(face, triangle, facing)) return;
  }
  near_facets.look([&](const ObjectRay& ray,
                       CrossingList& out) { return standard_crossings(*facets, ray, out); },
                   near);
}

}  // namespace crt::core
