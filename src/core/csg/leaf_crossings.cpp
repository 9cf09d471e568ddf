// What a CSG object asks of one leaf is here: where a ray starts on it, and what the ray crosses.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/csg/evaluate.hpp"

namespace crt::core {

FaceStart start_on_leaf(const Leaf& leaf, std::uint32_t index,
                        std::span<const FaceSurface> face_surfaces, const StartPoint& start) {
  if (start.surface == invalid_index) return {};
  const auto on_face = [&](std::uint32_t face) {
    const bool outside =
        (start.side == Side::outside) != leaf.surface_of(face, face_surfaces).flipped;
    return FaceStart{.face = face,
                     .side = outside ? Side::outside : Side::inside,
                     .on_face = start.leaf == index && start.face == face,
                     .t_error = start.t_error};
  };
  if (start.leaf == index) return on_face(start.face);
  // A surface has the number of the first face that lies on it.
  if (start.surface >= leaf.first_face) {
    const std::uint32_t place = start.surface - leaf.first_face;
    return place < leaf.face_count ? on_face(leaf.face_at(place)) : FaceStart{};
  }
  if (leaf.shared_faces != nullptr) {
    const auto& faces = leaf.shared_faces->faces;
    const auto found = std::lower_bound(
        faces.begin(), faces.end(), start.surface,
        [](const SharedFaces::Face& face, std::uint32_t wanted) { return face.surface < wanted; });
    const bool is_found = found != faces.end() && found->surface == start.surface;
    return is_found ? on_face(found->face) : FaceStart{};
  }
  if (leaf.face_count > Leaf::few_faces) return {};
  for (std::uint32_t place = 0; place < leaf.face_count; ++place) {
    if (face_surfaces[leaf.first_face + place].surface == start.surface) {
      return on_face(leaf.face_at(place));
    }
  }
  return {};
}

ObjectRay ray_to_leaf(const PlacedLeaf& leaf, std::uint32_t index,
                      std::span<const FaceSurface> face_surfaces, const WorldRay& ray) {
  ObjectRay result = leaf.placement.to_object(ray.origin, ray.direction);
  result.start = start_on_leaf(leaf.leaf, index, face_surfaces, ray.start);
  return result;
}

bool leaf_crossings(const PlacedLeaf& leaf, const WorldRay& ray, const ObjectRay& object_ray,
                    CrossingList& out, std::uint64_t& escalations) {
  if (!leaf.leaf.exact) return leaf.leaf.shape->crossings(object_ray, out);
  return leaf.leaf.exact->crossings(exact_ray(leaf.placement, ray, object_ray, escalations), out);
}

ExactRay exact_ray(const Placement& placement, const WorldRay& ray, const ObjectRay& object_ray,
                   std::uint64_t& escalations) {
  ExactRay exact = placement.to_object_exactly(ray.origin, ray.direction, object_ray);
  exact.start_error = ray.start.t_error;
  exact.escalations = &escalations;
  return exact;
}

bool is_through_start(const PlacedLeaf& leaf, const WorldRay& ray, double start_error,
                      const ObjectRay& object_ray, const Crossing& crossing) {
  const SurfacePoint point = leaf.leaf.shape->surface_point(object_ray, crossing, false);
  const Vec3 normal = leaf.placement.normal_to_world(point.normal);
  const double distance = crossing.t - ray.t_min - crossing.error;
  return distance * std::abs(glm::dot(normal, ray.direction)) <= start_error;
}

}  // namespace crt::core
