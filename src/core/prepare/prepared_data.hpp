// A PreparedData is the inside of a PreparedScene: what the renderer and the ray queries see of it.
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

#include "core/compile/leaf_of_hit.hpp"
#include "core/csg/evaluate.hpp"
#include "core/csg/program.hpp"
#include "core/intersect/answers.hpp"
#include "core/intersect/ray_workspace.hpp"
#include "core/intersect/spare_workspace.hpp"
#include "core/prepare/chosen_lights.hpp"
#include "core/prepare/features.hpp"
#include "core/prepare/prepared_entities.hpp"
#include "core/ray/object_ray.hpp"
#include "core/ray/ray_packet.hpp"
#include "core/shading/environment.hpp"
#include "core/shading/prepared_material.hpp"
#include "core/tasks/workers.hpp"
#include "crt/prepared_scene.hpp"
#include "crt/scene.hpp"
#include "crt/stats.hpp"

namespace crt::core {

class Accelerator;

/// A HitPoint is everything about a hit that shading may ask for.
struct HitPoint {
  double t = 0;
  Vec3 position{0, 0, 0};
  Vec3 normal{0, 1, 0};           ///< world, unit length, out of the solid
  Vec3 object_position{0, 0, 0};  ///< in the primitive's own space, where patterns live
  Vec3 object_normal{0, 1, 0};    ///< in that space, unit length, out of the solid
  double u = 0;
  double v = 0;
  std::uint32_t material = 0;   ///< index into PreparedData::materials()
  std::uint32_t entity_id = 0;  ///< the user's
  std::uint32_t object = invalid_index;
  std::uint32_t leaf = invalid_index;
  std::uint32_t face = invalid_index;
  bool entering = false;
  bool solid = false;  ///< a boundary of a volume, not a mere surface
};

/// An InputTolerance says how far rounding may have put the starts and ends of input rays from
/// surfaces. It is nothing in the exact tier, which takes them for the points that they are.
struct InputTolerance {
  double rounding = 0;        ///< start_rounding, or 0
  double max_size_error = 0;  ///< WorldRay::max_size_error
  double farthest = 0;        ///< the largest coordinate of bounded objects, or infinity

  /// Returns the error of places at t along rays, or 0 for places that are far from everything. It
  /// does so for one ray, or for as many as a Real has lanes.
  template <class Real>
  Real error_at(const PlainRay<Real>& ray, const Real& t) const {
    constexpr double far = 0x1p20;
    constexpr double largest = 0x1p900;
    const Real from = largest_component(ray.origin);
    const Real coordinate = fma(abs(t), largest_component(ray.direction), from);
    const Real end = min(far * (farthest + from), broadcast<Real>(largest));
    return select(coordinate < end, rounding * coordinate, Real{});
  }
};

/// A PreparedData is immutable after prepare(). Every member function is safe from any number of
/// threads.
class PreparedData {
 public:
  /// Takes over from what was prepared earlier, if it was, what does not depend on what differs
  /// from it. It asks `workers` whether to go on, and not the options.
  explicit PreparedData(const Scene& scene, const PrepareOptions& options = {},
                        const Workers& workers = {});
  ~PreparedData();
  PreparedData(const PreparedData&) = delete;
  PreparedData& operator=(const PreparedData&) = delete;

  /// Returns the nearest crossing. Of crossings at one place it is that of the object that comes
  /// first in the scene.
  /// Rays of a kind do not meet the objects that let these pass.
  RayHit intersect(const WorldRay& ray, RayWorkspace& work, PassingRays kind = passing_none) const;

  /// Asks whether any surface blocks the ray before its end.
  bool occluded(const WorldRay& ray, RayWorkspace& work) const;

  /// Finds the nearest crossings of some rays of a batch, each as intersect() would find it alone.
  /// But RayWorkspace::here and near mean nothing after it. Hits of other rays stay as they are.
  void intersect_each(const RayBatch& rays, RayMask some, std::span<RayHit, packet_size> hits,
                      RayWorkspace& work, Packets packets = Packets::where_they_pay,
                      PassingRays kind = passing_none) const;
  /// Prefetches the memory that the points of some of these hits need.
  void prefetch_points(std::span<const RayHit, packet_size> hits, RayMask some) const;
  RayMask occluded_each(const RayBatch& rays, RayMask some, RayWorkspace& work,
                        Packets packets = Packets::where_they_pay) const;

  /// Asks whether light is blocked on its path along rays for which it is known what they start on.
  /// It passes what casts no shadow, unless the rays are of another kind.
  RayMask shadowed_each(const RayBatch& rays, const PacketStarts& starts, RayMask some,
                        RayWorkspace& work, PassingRays kind = passing_shadow) const;
  PacketStarts noted_starts(const RayBatch& rays, RayMask some) const;

  /// Finds what light meets on its path along these rays. For each ray that is filtered, the
  /// crossings are in RayWorkspace::on_paths, as crossings() has them.
  LightPaths paths_to_light(const RayBatch& rays, const PacketStarts& starts, RayMask some,
                            RayWorkspace& work, Packets packets = Packets::where_they_pay,
                            PassingRays kind = passing_shadow) const;

  /// Finds every crossing in ascending t. Crossings of one surface have one t, and there solids are
  /// left before others are entered.
  void crossings(const WorldRay& ray, std::vector<RayHit>& out, RayWorkspace& work) const;

  /// Finds the solids that hold the start of the ray (just after it, for a ray that starts on a
  /// surface). For each it gives the crossing at which the ray leaves it, the farthest first. So
  /// nested solids come from outermost to innermost. A solid that the ray never leaves has t =
  /// infinity.
  void containing_solids(const WorldRay& ray, std::vector<RayHit>& out, RayWorkspace& work) const;

  /// Finds the innermost solid around a point, as the media of pictures are ordered along a ray.
  ContainingSolid innermost(const Vec3& point, RayWorkspace& work) const;

  /// Returns whether there is a surface at a point, or so near that rounding may decide. It looks
  /// along three axes across each other, as a line along a surface does not meet it.
  bool is_on_surface(const Vec3& point, RayWorkspace& work) const;

  /// Returns whether all surfaces surely pass by a box.
  bool all_pass_by(const Bounds& box) const;

  /// Returns whether the ray starts inside a solid object (just after its start, as above), and
  /// where it leaves it.
  SolidExit find_exit(const WorldRay& ray, std::uint32_t object, RayWorkspace& work) const;

  /// Computes what shading needs of a hit that `ray` found, with u and v only if asked for. It
  /// writes directly into `point`, as copying what was just written waits until that has reached
  /// the cache.
  void hit_point(const WorldRay& ray, const RayHit& hit, bool with_uv, HitPoint& point) const;
  HitPoint hit_point(const WorldRay& ray, const RayHit& hit) const {
    HitPoint point;
    hit_point(ray, hit, true, point);
    return point;
  }

  /// Returns the point of a hit in the primitive's own space. The normal points out of the object.
  SurfacePoint object_point(const WorldRay& ray, const RayHit& hit, bool with_uv) const;

  /// Computes the points of some rays of a group, each at its t, which hit the same face as
  /// `first`. For the others the point means nothing.
  void object_points(const RayHit& first, RayMask some, const RayLanes& lines, const Lanes& t,
                     bool with_uv, SurfacePointLanes& points) const {
    const LeafOfHit in_place = placed_leaf(first);
    const Leaf& leaf = in_place.leaf();
    const Vec3 anchor = leaf.shape->anchor(first.face);
    if (in_place.placement().is_identity()) {
      leaf.shape->points_on(lines.from_center(anchor, t), lines.direction, some, first.face,
                            with_uv, points);
    } else {
      const ObjectRayLanes moved = in_place.placement().to_object(lines);
      leaf.shape->points_on(moved.from_center(anchor, t), moved.direction, some, first.face,
                            with_uv, points);
    }
    if (leaf.complemented) points.normal = -points.normal;
  }

  /// Returns which of some rays of a group hit shapes of one family (Shape::family()) and of one
  /// material, from the same side, as `first` does. Returns none if `first` is on a shape that is
  /// moved or a cutter.
  RayMask on_shapes_like(const RayHit& first, std::span<const RayHit, lane_count> hits,
                         RayMask some) const;
  /// Computes points as object_points() does, for rays whose hits are on such shapes of their own.
  void points_on_shapes(std::span<const RayHit, lane_count> hits, RayMask some,
                        const RayLanes& lines, const Lanes& t, bool with_uv,
                        SurfacePointLanes& points) const;

  /// Transforms points of a hit like `hit` to the world.
  void take_to_world(const RayHit& hit, SurfacePointLanes& points) const {
    const LeafOfHit in_place = placed_leaf(hit);
    const Placement& placement = in_place.placement();
    if (placement.is_identity()) return;
    points.position = placement.point_to_world(points.position);
    points.normal = placement.normal_to_world(points.normal);
  }

  /// Returns the material of a hit, without the rest.
  std::uint32_t hit_material(const RayHit& hit) const {
    return entities_.materials->of(*compiled_, hit);
  }

  /// Returns the user's number of the entity that was hit.
  std::uint32_t entity_id(const RayHit& hit) const {
    return compiled_->is_of_instance(hit) ? ids(hit).entity : entity_ids_[hit.leaf];
  }
  /// Returns the user's numbers of what was hit.
  Ids ids(const RayHit& hit) const { return ids_of(*compiled_, hit); }

  /// Returns the user's number of a leaf's entity, without a branch. For no leaf it is any number.
  /// The scene has leaves, and none of instances.
  std::uint32_t entity_id_or_any(std::uint32_t leaf) const {
    return entity_ids_[leaf < entity_ids_.size() ? leaf : 0];
  }
  bool has_instances() const { return !compiled_->instances.empty(); }

  /// Returns whether rays of a kind pass an object.
  bool is_passed(std::uint32_t object, PassingRays kind) const {
    return (compiled_->objects[object].passed_by & kind) != 0;
  }

  /// Returns whether a hit is on the boundary of a volume, not on a mere surface.
  bool is_solid(const RayHit& hit) const { return leaf(hit).of_solid; }

  /// Returns where a ray starts that leaves a hit to the given side of the solid's surface. The
  /// direction of `ray` must have unit length.
  StartPoint start_point(const WorldRay& ray, const RayHit& hit, Side side) const;
  /// Returns the start_point() but for its error.
  StartPoint start_face(const RayHit& hit, Side side) const {
    const Leaf& leaf = this->leaf(hit);
    const FaceSurface face = leaf.surface_of(hit.face, compiled_->scene_of(hit).face_surfaces);
    // `side` is that of the object. A cutter and a flipped face each turn it round once.
    if (leaf.complemented != face.flipped) side = opposite(side);
    return {.leaf = hit.leaf,
            .face = hit.face,
            .surface = compiled_->is_of_instance(hit) ? invalid_index : face.surface,
            .side = side};
  }

  /// Returns how far input rays may be off what they start and end at.
  const InputTolerance& input_tolerance() const { return input_tolerance_; }

  /// Returns the objects, and what they are made of.
  const CompiledScene& compiled() const { return *compiled_; }

  /// Returns the primitive that was hit.
  const Leaf& leaf(const RayHit& hit) const { return compiled_->leaf_of(hit); }
  /// Returns the primitive that was hit in its place.
  LeafOfHit placed_leaf(const RayHit& hit) const { return {*compiled_, hit}; }

  const std::vector<PreparedMaterial>& materials() const { return materials_; }
  /// Returns of which of the materials leaves are.
  const MaterialTable& material_table() const { return *entities_.materials; }
  const PreparedBackground& background() const { return *background_; }
  /// Returns the background as a light, or null if it is none.
  const Environment* environment() const { return environment_.get(); }
  /// Returns the lights of which a point asks one, or null if there are none.
  const ChosenLights* chosen_lights() const { return chosen_lights_.get(); }
  const Features& features() const { return features_; }
  /// Returns lights, camera, background and settings as given (and checked), without entities.
  const Scene& scene() const { return scene_; }
  double prepare_seconds() const { return prepare_seconds_; }
  MemoryUse memory() const;
  /// Returns what the user should know of the scene, a line each.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Returns a place for the workspace of whoever asks queries now and then.
  SpareWorkspace& spare_workspace() const { return spare_workspace_; }
  /// Returns whether both share the geometry that rays meet.
  bool shares_geometry_with(const PreparedData& other) const {
    return entities_.geometry == other.entities_.geometry;
  }

 private:
  template <class Pool>
  static const Pool* of_earlier(Pool PreparedData::*pool, const PrepareOptions& options);
  static SurfacePoint object_point(const LeafOfHit& in_place, const WorldRay& ray,
                                   const RayHit& hit, bool with_uv);

  void warn_of_no_light();
  void warn_of_camera();
  void warn_of_meshes();

  Scene scene_;
  PreparedEntities entities_;
  TexturePool textures_;
  TexturePool normals_;
  LayerTablePool layer_tables_;
  std::vector<PreparedMaterial> materials_;
  Opacity opacity_;
  std::unique_ptr<const PreparedBackground> background_;
  std::unique_ptr<const Environment> environment_;
  std::unique_ptr<const ChosenLights> chosen_lights_;
  Features features_;
  // These point into the geometry.
  const Accelerator* accelerator_ = nullptr;
  const CompiledScene* compiled_ = nullptr;
  std::span<const std::uint32_t> entity_ids_;  ///< of leaves, close together
  InputTolerance input_tolerance_;
  std::vector<std::string> warnings_;
  double prepare_seconds_ = 0;
  mutable SpareWorkspace spare_workspace_;
};

}  // namespace crt::core
