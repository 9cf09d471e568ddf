// The objects of a scene made ready for rays: which of them a ray meets, and where.
#pragma once

#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "core/accel/embree_tree.hpp"
#include "core/accel/flat_box_list.hpp"
#include "core/compile/compile.hpp"
#include "core/intersect/answers.hpp"
#include "core/intersect/bounding_proxy.hpp"
#include "core/intersect/crossing_order.hpp"
#include "core/intersect/ray_workspace.hpp"
#include "core/math/vector.hpp"
#include "core/ray/ray_packet.hpp"
#include "crt/stats.hpp"

namespace crt::core {

/// Finds crossings: a tree of boxes says which objects a ray may meet, cheap tests which of these
/// it surely misses, the rest happens exactly, in double. Objects without end stay outside of the
/// tree.
class Accelerator {
 public:
  /// `materials` are those of the scene, which need not hold them itself.
  Accelerator(CompiledScene compiled, std::span<const SharedMaterial> materials,
              const Workers& workers = {});
  ~Accelerator();
  Accelerator(const Accelerator&) = delete;
  Accelerator& operator=(const Accelerator&) = delete;

  RayHit nearest(const WorldRay& ray, RayWorkspace& work) const;
  bool any(const WorldRay& ray, RayWorkspace& work) const;

  /// The same for some of a batch, each with what it finds alone; but RayWorkspace::here and near
  /// are of no use after it. Hits of other rays stay as they are.
  void nearest_each(const RayBatch& rays, RayMask some, std::span<RayHit, packet_size> hits,
                    Packets packets, RayWorkspace& work) const;
  /// See PreparedData::first_leaves().
  bool first_leaves(const RayBatch& rays, RayMask some, FirstLeaves& first) const;
  /// Which of the rays; `starts` says what these start on.
  RayMask any_each(const RayBatch& rays, const PacketStarts& starts, RayMask some, Packets packets,
                   RayWorkspace& work) const;
  /// On what some rays start, and what they have left for good.
  PacketStarts noted_starts(const RayBatch& rays, RayMask some) const;

  /// Appends every crossing, unsorted; stops early and returns false at the first of an opaque
  /// thing, if it is told which these are.
  bool all(const WorldRay& ray, const Opacity* opacity, std::vector<RayHit>& out,
           RayWorkspace& work) const;
  /// See PreparedData::paths_to_light(); but for the crossings' order.
  LightPaths paths_to_light(const RayBatch& rays, const PacketStarts& starts, RayMask some,
                            const Opacity& opacity, Packets packets, RayWorkspace& work) const;
  /// Appends for each solid around the ray's start its next crossing, unsorted. A solid that the
  /// ray never leaves counts as left at infinity.
  void surrounding(const WorldRay& ray, std::vector<RayHit>& out, RayWorkspace& work) const;
  /// The same for one solid object.
  Stay stay(const WorldRay& ray, std::uint32_t object, RayWorkspace& work) const;

  /// Puts what all() has appended into order.
  void sort(const WorldRay& ray, std::vector<RayHit>& crossings, RayWorkspace& work) const {
    sort_crossings(compiled_, ray, objects_share_surfaces_, crossings, work);
  }

  /// What it takes of memory, but for materials.
  MemoryUse memory() const;

  const CompiledScene& compiled() const { return compiled_; }
  const Leaf& leaf(std::uint32_t index) const { return compiled_.leaves[index]; }
  const SceneObject& object(std::uint32_t index) const { return compiled_.objects[index]; }
  /// Of a CSG object, if it has one.
  const IntervalFilter* filter(std::uint32_t object) const {
    const SceneObject& solid = compiled_.objects[object];
    if (!solid.is_csg()) return nullptr;
    const IntervalFilter& filter = compiled_.programs[solid.program].filter;
    return filter.empty() ? nullptr : &filter;
  }
  const FaceSurface& face_surface(const Leaf& leaf, std::uint32_t face) const {
    return compiled_.face_surfaces[leaf.first_face + face];
  }
  /// The point of a hit that `ray` found, in the space of its leaf; u and v only if asked for.
  SurfacePoint surface_point(const WorldRay& ray, const RayHit& hit, bool with_uv) const;
  /// Lets memory fetch beforehand what surface_point() looks at.
  void prefetch_surface_points(std::span<const RayHit, packet_size> hits, RayMask some) const;
  /// A leaf's own ray for a ray in the world.
  ObjectRay object_ray(std::uint32_t index, const WorldRay& ray) const;
  /// Whether a crossing near the ray's end is of a surface through that end.
  bool is_at_end(const WorldRay& ray, const RayHit& hit) const;
  /// The object that a ray has left for good when it starts: it cannot meet the object again.
  std::uint32_t left_for_good(const StartPoint& start) const;
  /// The solid that a ray starts on the surface of, into it, if it keeps apart from all else; by
  /// its place among those that have an end.
  std::uint32_t entered_isolated(const StartPoint& start) const;

 private:
  template <class Kind>
  void traverse(Kind& query) const;
  /// The boxes of those that have an end, as EmbreeTree::traverse() has it.
  template <bool FromNear, class Visit>
  void visit_boxes(const WorldRay& ray, double limit, const Visit& visit) const;
  template <bool FromNear, class Visit>
  void visit_boxes(const RayPacket& packet, RayMask rays, const Visit& visit) const;
  /// Whether there are so few boxes that all of them are looked at.
  bool has_flat_box_list() const { return bounded_.list.size() <= FlatBoxList::most_boxes; }
  /// Whether floats can tell what rays cross first.
  bool filters_spheres() const { return tree_ && !has_flat_box_list() && tree_->filters_spheres(); }
  /// Whether that is all there is.
  bool has_only_spheres() const { return unbounded_.list.empty() && filters_spheres(); }
  /// Whether some rays are to be followed as a packet.
  bool pay_together(const RayBatch& rays, RayMask some, Packets packets) const;
  template <class Kind>
  void traverse_filtered(Kind& query) const;
  /// Returns the rays that still go, of those which do.
  template <class Answers>
  RayMask traverse_filtered(RayPacket& packet, RayMask going, Answers& answers) const;
  /// Where nothing but an object is that keeps apart.
  Bounds box_around(std::uint32_t object) const {
    return compiled_.objects[object].bounds.grown(margin_);
  }
  /// nearest_each() for rays whose hits are empty, as a packet.
  void nearest_together(const RayBatch& rays, RayMask some, std::span<RayHit, packet_size> hits,
                        RayWorkspace& work) const;
  /// The same by floats first, where has_only_spheres(), for rays that start in free space; also
  /// for hits that hold something. Returns of which rays it is known; the hits of the others stay
  /// as they are.
  RayMask find_all_nearest_spheres(const RayBatch& rays, RayMask some,
                                   std::span<RayHit, packet_size> hits, RayWorkspace& work) const;
  RayHit nearest_elsewhere(const WorldRay& ray, RayWorkspace& work) const;
  /// Takes those of a batch's rays that start into solids which keep apart to where they leave
  /// these: what there is elsewhere they cannot meet before. Returns which; the hits of the others
  /// are left empty.
  RayMask leave_isolated(const RayBatch& rays, RayMask some, std::span<RayHit, packet_size> hits,
                         RayWorkspace& work) const;
  /// The same of those rays of a group that start into one such solid.
  RayMask leave_isolated(const BoundingProxy& solid, const RayBatch& rays, std::size_t group,
                         RayMask some, std::span<RayHit, lane_count> hits,
                         RayWorkspace& work) const;
  /// The same of one ray.
  bool leaves_isolated(const WorldRay& ray, RayWorkspace& work, RayHit& hit) const;
  /// The same of one ray and the solid that it starts into, by the exact test.
  bool leaves_isolated(const BoundingProxy& solid, const WorldRay& ray, RayWorkspace& work,
                       RayHit& hit) const;
  /// The crossings around the place of a hit that has company, into `work`; returns the first of
  /// those at it.
  RayHit gather_coincident(const WorldRay& ray, const RayHit& nearest, RayWorkspace& work) const;

  CompiledScene compiled_;
  BoundingProxies unbounded_;
  BoundingProxies bounded_;  ///< in the order in which Embree numbers them
  /// By leaf: the object that is all within it; nothing if there is none, or if a line may leave
  /// the leaf and meet it again.
  std::vector<std::uint32_t> enclosed_;
  /// More than what rounding does to places in the scene: of two objects that are farther apart
  /// neither matters where the other is.
  double margin_ = 0;
  std::vector<std::uint32_t> isolated_;     ///< by object: see isolated_objects()
  std::unique_ptr<const EmbreeTree> tree_;  ///< none if nothing is bounded
  FlatBoxList flat_box_list_;               ///< takes its place if there are few boxes
  bool objects_share_surfaces_ =
      false;  ///< whether some surface has faces of several objects on it
};

template <bool FromNear, class Visit>
void Accelerator::visit_boxes(const WorldRay& ray, double limit, const Visit& visit) const {
  if (!tree_) return;
  if (has_flat_box_list() && FlatBoxList::takes(ray)) {
    flat_box_list_.traverse(ray, limit, visit);
  } else {
    tree_->traverse(ray.origin, ray.direction, ray.t_min, limit, FromNear, visit);
  }
}

template <bool FromNear, class Visit>
void Accelerator::visit_boxes(const RayPacket& packet, RayMask rays, const Visit& visit) const {
  if (!tree_) return;
  const RayMask in_row = has_flat_box_list() ? FlatBoxList::takes(packet, rays) : 0;
  if (in_row != 0) flat_box_list_.traverse<FromNear>(packet, in_row, visit);
  if (rays != in_row) tree_->traverse(packet, rays & ~in_row, visit);
}

}  // namespace crt::core
