#include "core/compile/unlisted_faces.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "core/compile/surface_table.hpp"

namespace crt::core {

namespace {

/// Returns a box of object space around a box in the world.
Bounds bounds_to_object(const Placement& placement, const Bounds& world) {
  if (!world.finite()) return Bounds::everything();
  Bounds box;
  for (unsigned corner = 0; corner < 8; ++corner)
    box.include(placement.point_to_object(world.corner(corner)));
  constexpr double roundings = 0x1p-40;
  return box.grown(roundings * (box.farthest() + world.farthest()));
}

/// Adds the faces of a leaf that lie in a plane of another one.
void add_faces_in(const CanonicalSurface& plane, const Surface& surface, const Leaf& other,
                  const Leaf& leaf, std::vector<std::uint32_t>& faces) {
  const Placement& placement = *leaf.placement;
  const Vec3 normal =
      other.placement->normal_to_world(surface.direction / glm::length(surface.direction));
  const Vec3 place = placement.point_to_object(other.placement->point_to_world(surface.position));
  const Transform& map = placement.to_world();
  const Vec3 in_object = normal.x * map.row_x + normal.y * map.row_y + normal.z * map.row_z;
  const std::size_t begin = faces.size();
  leaf.shape->faces_near(in_object, glm::dot(in_object, place),
                         bounds_to_object(placement, other.bounds), faces);
  const auto is_elsewhere = [&](std::uint32_t face) {
    return canonical_surface(leaf.shape->surface(face), placement).key != plane.key;
  };
  faces.erase(
      std::remove_if(faces.begin() + static_cast<std::ptrdiff_t>(begin), faces.end(), is_elsewhere),
      faces.end());
}

}  // namespace

void find_unlisted_faces(std::span<Leaf> leaves, const Workers& workers) {
  for (Leaf& leaf : leaves) {
    if (leaf.face_count == leaf.shape->face_count()) continue;
    std::vector<std::uint32_t> faces;
    for (const Leaf& other : leaves) {
      if (&other == &leaf || other.face_count > Shape::max_compared_faces ||
          !other.bounds.touches(leaf.bounds)) {
        continue;
      }
      for (std::uint32_t face = 0; face < other.shape->listed_face_count(); ++face) {
        workers.poll_at(face);
        const Surface surface = other.shape->surface(face);
        if (surface.kind != SurfaceKind::plane) continue;
        add_faces_in(canonical_surface(surface, *other.placement), surface, other, leaf, faces);
      }
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    leaf.unlisted = std::make_shared<UnlistedFaces>();
    leaf.unlisted->begin = leaf.shape->listed_face_count();
    leaf.unlisted->some = std::move(faces);
    leaf.face_count = leaf.unlisted->begin + static_cast<std::uint32_t>(leaf.unlisted->some.size());
  }
}

}  // namespace crt::core
