// The inside of a PreparedScene: what the renderer and the ray queries see of it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/csg/evaluate.hpp"
#include "core/csg/program.hpp"
#include "core/intersect/answers.hpp"
#include "core/intersect/ray_workspace.hpp"
#include "core/prepare/features.hpp"
#include "core/ray/object_ray.hpp"
#include "core/ray/ray_packet.hpp"
#include "core/shading/prepared_background.hpp"
#include "core/shading/prepared_material.hpp"
#include "core/tasks/workers.hpp"
#include "crt/scene.hpp"
#include "crt/stats.hpp"

namespace crt::core {

class Accelerator;
struct CompiledScene;

/// Everything about a hit that shading may ask for.
struct HitPoint {
  double t = 0;
  Vec3 position{0, 0, 0};
  Vec3 normal{0, 1, 0};           ///< world, unit length, out of the solid
  Vec3 object_position{0, 0, 0};  ///< in the primitive's own space: where patterns live
  Vec3 object_normal{0, 1, 0};    ///< in that space, unit length, out of the solid
  double u = 0;
  double v = 0;
  std::uint32_t material = 0;   ///< index into PreparedData::materials()
  std::uint32_t entity_id = 0;  ///< the user's
  std::uint32_t object = nothing;
  std::uint32_t leaf = nothing;
  std::uint32_t face = no_face;
  bool entering = false;
  bool solid = false;  ///< a boundary of a volume, not a mere surface
};

/// Immutable after prepare(); every member function is safe from any number of threads.
class PreparedData {
 public:
  /// Takes over of `earlier`, if there is one, what does not depend on what has changed since. Of
  /// the number of primitives see PrepareOptions.
  explicit PreparedData(const Scene& scene, const PreparedData* earlier = nullptr,
                        const Workers& workers = {}, std::uint64_t max_primitives = 0);
  ~PreparedData();
  PreparedData(const PreparedData&) = delete;
  PreparedData& operator=(const PreparedData&) = delete;

  /// The nearest crossing; of those at one place that of the object that comes first in the scene.
  RayHit intersect(const WorldRay& ray, RayWorkspace& work) const;

  /// Whether there is any crossing at all before the ray's end.
  bool occluded(const WorldRay& ray, RayWorkspace& work) const;

  /// The same for some of a batch, each with what it finds alone; but RayWorkspace::here and near
  /// are of no use after it. Hits of other rays stay as they are.
  void intersect_each(const RayBatch& rays, RayMask some, std::span<RayHit, packet_size> hits,
                      RayWorkspace& work, Packets packets = Packets::where_they_pay) const;
  /// How far the nearest crossings of some of a batch are, and of which leaves; if that can be told
  /// in less time. Else false.
  bool first_leaves(const RayBatch& rays, RayMask some, FirstLeaves& first) const;
  /// Lets memory fetch beforehand what it takes to tell of such hits; of some of them.
  void prefetch_points(std::span<const RayHit, packet_size> hits, RayMask some) const;
  RayMask occluded_each(const RayBatch& rays, RayMask some, RayWorkspace& work,
                        Packets packets = Packets::where_they_pay) const;

  /// The same for rays of which it is known what they start on.
  RayMask occluded_each(const RayBatch& rays, const PacketStarts& starts, RayMask some,
                        RayWorkspace& work) const;
  PacketStarts noted_starts(const RayBatch& rays, RayMask some) const;

  /// What light meets on its way along such rays. For each that is filtered the crossings, as
  /// crossings() has them, are in RayWorkspace::on_paths.
  LightPaths paths_to_light(const RayBatch& rays, const PacketStarts& starts, RayMask some,
                            RayWorkspace& work, Packets packets = Packets::where_they_pay) const;

  /// Every crossing in ascending t; those of one surface have one t, and there solids are left
  /// before others are entered.
  void crossings(const WorldRay& ray, std::vector<RayHit>& out, RayWorkspace& work) const;

  /// Of each solid that holds the start of the ray (just after it, for a ray that starts on a
  /// surface), the crossing at which the ray leaves it, the farthest first: outermost to innermost
  /// for nested solids. A solid that the ray never leaves has t = infinity.
  void surrounding(const WorldRay& ray, std::vector<RayHit>& out, RayWorkspace& work) const;

  /// Whether the ray starts inside a solid object (just after its start, as above), and where it
  /// leaves it.
  Stay stay(const WorldRay& ray, std::uint32_t object, RayWorkspace& work) const;

  /// What shading needs of a hit that `ray` found; u and v only if asked for. Filled in where it
  /// stays, as a copy of what has just been written waits until that has reached the cache.
  void hit_point(const WorldRay& ray, const RayHit& hit, bool with_uv, HitPoint& point) const;
  HitPoint hit_point(const WorldRay& ray, const RayHit& hit) const {
    HitPoint point;
    hit_point(ray, hit, true, point);
    return point;
  }

  /// Of these the place, in the primitive's own space; the normal points out of the object.
  SurfacePoint object_point(const WorldRay& ray, const RayHit& hit, bool with_uv) const;

  /// The same of a group of rays, each at its t, of which some hit the same face as `first`. Of the
  /// others the point is of no use.
  void object_points(const RayHit& first, const RayLanes& lines, const Lanes& t, bool with_uv,
                     SurfacePointLanes& points) const {
    const Leaf& leaf = leaves_[first.leaf];
    const Vec3 anchor = leaf.shape->anchor(first.face);
    if (leaf.placement->is_identity()) {
      leaf.shape->points_on(lines.from_center(anchor, t), lines.direction, first.face, with_uv,
                            points);
    } else {
      const ObjectRayLanes moved = leaf.placement->to_object(lines);
      leaf.shape->points_on(moved.from_center(anchor, t), moved.direction, first.face, with_uv,
                            points);
    }
    if (leaf.complemented) points.normal = -points.normal;
  }

  /// Of some rays of a group those that hit spheres of one material from the same side, as `first`
  /// does; none if that hits anything else, or a sphere that is moved or a cutter.
  RayMask on_spheres_like(const RayHit& first, std::span<const RayHit, lane_count> hits,
                          RayMask some) const;
  /// As object_points() of such rays, whose spheres may be different ones.
  void sphere_points(std::span<const RayHit, lane_count> hits, RayMask some, const RayLanes& lines,
                     const Lanes& t, bool with_uv, SurfacePointLanes& points) const;

  /// Takes those of a hit like `hit` to the world.
  void take_to_world(const RayHit& hit, SurfacePointLanes& points) const {
    const Placement& placement = *leaves_[hit.leaf].placement;
    if (placement.is_identity()) return;
    points.position = placement.point_to_world(points.position);
    points.normal = placement.normal_to_world(points.normal);
  }

  /// The material of a hit, without the rest.
  std::uint32_t hit_material(const RayHit& hit) const { return leaves_[hit.leaf].material; }

  /// The user's number of what a hit is of.
  std::uint32_t entity_id(const RayHit& hit) const { return entity_ids_[hit.leaf]; }

  /// The same of its leaf; of none any, if there are entities. Without a branch.
  std::uint32_t entity_id_or_any(std::uint32_t leaf) const {
    return entity_ids_[leaf < entity_ids_.size() ? leaf : 0];
  }

  /// Whether a hit is on the boundary of a volume, not on a mere surface.
  bool is_solid(const RayHit& hit) const { return leaves_[hit.leaf].of_solid; }

  /// Where a ray starts that leaves a hit to the given side of the solid's surface. Its direction
  /// must have unit length.
  StartPoint start_point(const WorldRay& ray, const RayHit& hit, Side side) const;
  /// The same but for its error.
  StartPoint start_face(const RayHit& hit, Side side) const {
    const Leaf& leaf = leaves_[hit.leaf];
    const FaceSurface& face = face_surfaces_[leaf.first_face + hit.face];
    // `side` is of the object; a cutter and a flipped face each turn it round once.
    if (leaf.complemented != face.flipped) side = opposite(side);
    return {.leaf = hit.leaf, .face = hit.face, .surface = face.surface, .side = side};
  }

  /// The objects, and what they are made of.
  const CompiledScene& compiled() const;

  /// The primitive in its place that a hit is of: bumps ask for it.
  const Leaf& leaf(const RayHit& hit) const { return leaves_[hit.leaf]; }

  const std::vector<PreparedMaterial>& materials() const { return materials_; }
  const PreparedBackground& background() const { return *background_; }
  const Features& features() const { return features_; }
  /// Lights, camera, background and settings as given (and checked); entities are left out.
  const Scene& scene() const { return scene_; }
  double prepare_seconds() const { return prepare_seconds_; }
  MemoryUse memory() const;
  /// What the user should know of the scene, a line each.
  std::vector<std::string> warnings() const { return textures_.warnings(); }
  /// Whether what rays meet was made once for both.
  bool shares_geometry_with(const PreparedData& other) const {
    return geometry_ == other.geometry_;
  }

 private:
  struct Geometry;

  Scene scene_;
  std::shared_ptr<const Geometry> geometry_;
  TexturePool textures_;
  std::vector<PreparedMaterial> materials_;
  Opacity opacity_;
  std::unique_ptr<const PreparedBackground> background_;
  Features features_;
  // Of the geometry:
  const Accelerator* accelerator_ = nullptr;
  std::span<const Leaf> leaves_;
  std::span<const FaceSurface> face_surfaces_;
  std::span<const std::uint32_t> entity_ids_;  ///< of leaves, close together
  double prepare_seconds_ = 0;
};

}  // namespace crt::core
