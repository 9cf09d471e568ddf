#include "core/queries/ray_start.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "core/csg/evaluate.hpp"
#include "crt/error.hpp"

namespace crt::core {

namespace {

// The two numbers of a start hold these, from the lowest bit on:
//   leaf 32, face 32
//   object 32, root 8, entering 1, is_somewhere 1
constexpr int half = 32;
constexpr std::uint64_t lower_half = 0xffffffffu;
constexpr int entering_bit = 40;
constexpr int somewhere_bit = 41;
constexpr int end_bit = 42;

std::uint32_t lower(std::uint64_t bits) {
  return static_cast<std::uint32_t>(bits & lower_half);
}
std::uint32_t upper(std::uint64_t bits) {
  return static_cast<std::uint32_t>(bits >> half);
}

bool is_nowhere(const RayStart& start) {
  return (start.bits[0] | start.bits[1]) == 0;
}

/// Returns the hit of a start, which need not be in any scene.
RayHit hit_of(const RayStart& start) {
  const auto& [place, object] = start.bits;
  return {.object = lower(object),
          .leaf = lower(place),
          .face = upper(place),
          .root = static_cast<std::uint8_t>(upper(object)),
          .entering = (object >> entering_bit & 1u) != 0};
}

/// Returns whether a scene has such an object with such a leaf and face.
bool is_in(const CompiledScene& scene, const RayHit& hit) {
  if (hit.object >= scene.objects.size()) return false;
  const SceneObject& object = scene.objects[hit.object];
  const std::span<const Leaf> leaves = scene.leaves_of(object);
  if (hit.leaf < object.first_leaf || hit.leaf - object.first_leaf >= leaves.size()) return false;
  return hit.face < leaves[hit.leaf - object.first_leaf].shape->face_count();
}

/// Returns the side of the surface to which a ray from its origin goes. Where that is too near to
/// along the surface it is the side to which the ray of the hit went on.
Side side_of(const PreparedData& data, const RayHit& surface, const WorldRay& ray) {
  constexpr double roundings = 32 * unit_roundoff;
  const LeafOfHit in_place = data.placed_leaf(surface);
  const ObjectRay local = in_place.placement().to_object(ray.origin, ray.direction);
  const SurfacePoint point =
      in_place.leaf().shape->surface_point(local, Crossing{.t = 0, .face = surface.face}, false);
  const Vec3 normal = in_place.placement().normal_to_world(point.normal);
  const double along = glm::dot(normal, ray.direction);
  if (!(std::abs(along) > roundings * largest_component(ray.direction)))
    return surface.entering ? Side::inside : Side::outside;
  return (along > 0) != in_place.leaf().complemented ? Side::outside : Side::inside;
}

/// Returns whether a ray that starts in free space meets a surface at its t_min.
bool is_met_at_t_min(const PreparedData& data, const RayHit& surface, const WorldRay& ray,
                     RayWorkspace& work) {
  const LeafOfHit in_place = data.placed_leaf(surface);
  const ObjectRay local = in_place.placement().to_object(ray.origin, ray.direction);
  CrossingList& crossings = work.crossings;
  crossings.clear();
  leaf_crossings(PlacedLeaf(in_place.leaf(), in_place.placement()), ray, local, crossings,
                 work.leaf_escalations);
  return std::any_of(crossings.begin(), crossings.end(), [&](const Crossing& crossing) {
    const double width = 2 * crossing.error + 4 * rounding_of(ray.t_min);
    return crossing.face == surface.face && std::abs(crossing.t - ray.t_min) <= width;
  });
}

double rounding_at(const WorldRay& ray, double t) {
  const double from = largest_component(ray.origin);
  return start_rounding * std::fma(std::abs(t), largest_component(ray.direction), from);
}

}  // namespace

RayStart start_of(const RayHit& hit) {
  return {{std::uint64_t{hit.face} << half | hit.leaf,
           std::uint64_t{1} << somewhere_bit |
               static_cast<std::uint64_t>(hit.entering) << entering_bit |
               std::uint64_t{hit.root} << half | hit.object}};
}

bool is_of_scene(const PreparedData& data, const RayStart& start) {
  const std::uint64_t object = start.bits[1];
  if (is_nowhere(start)) return true;
  return object >> end_bit == 0 && (object >> somewhere_bit & 1u) != 0 &&
         is_in(data.compiled(), hit_of(start));
}

std::optional<RayHit> read_start(const PreparedData& data, const RayStart& start,
                                 const char* argument) {
  if (is_nowhere(start)) return std::nullopt;
  if (!is_of_scene(data, start)) {
    throw Error(ErrorCode::invalid_argument,
                std::string(argument) + " must be of a hit in the same prepared scene", argument);
  }
  RayHit hit = hit_of(start);
  hit.surface = data.start_face(hit, Side::outside).surface;
  return hit;
}

void begin_on(const PreparedData& data, const RayHit& surface, WorldRay& ray, RayWorkspace& work) {
  // What is before t_min on the same line is behind the ray anyway.
  if (ray.t_min != 0 && is_met_at_t_min(data, surface, ray, work)) return;
  const double error = std::max(ray.start.t_error, rounding_at(ray, 0));
  ray.start = data.start_face(surface, side_of(data, surface, ray));
  ray.start.t_error = error;
}

void end_on(const PreparedData& data, const RayHit& surface, WorldRay& ray) {
  const StartPoint face = data.start_face(surface, Side::outside);
  ray.end_point = {.leaf = face.leaf, .face = face.face, .surface = face.surface};
  ray.end_error = std::max(ray.end_error, rounding_at(ray, ray.t_max));
}

}  // namespace crt::core
