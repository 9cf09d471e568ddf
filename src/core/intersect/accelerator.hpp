// The objects of a scene are made ready here for finding what rays meet, and where.
#pragma once

#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "core/accel/box_tree.hpp"
#include "core/accel/flat_box_list.hpp"
#include "core/compile/compile.hpp"
#include "core/compile/recompile.hpp"
#include "core/intersect/answers.hpp"
#include "core/intersect/bounding_proxy.hpp"
#include "core/intersect/crossing_order.hpp"
#include "core/intersect/ray_workspace.hpp"
#include "core/math/vector.hpp"
#include "core/ray/ray_packet.hpp"
#include "crt/stats.hpp"

namespace crt::core {

/// An Accelerator finds crossings in stages. A tree of boxes finds which objects a ray may meet,
/// and conservative tests which of these it surely misses. All else is computed exactly, in double.
/// Unbounded objects stay outside of the tree.
class Accelerator {
 public:
  explicit Accelerator(CompiledScene compiled, const Workers& workers = {})
      : Accelerator({std::move(compiled), {}}, nullptr, workers) {}
  /// Makes it of a scene with objects from an earlier one, which may be null.
  Accelerator(RecompiledScene recompiled, const Accelerator* earlier, const Workers& workers);
  ~Accelerator();
  Accelerator(const Accelerator&) = delete;
  Accelerator& operator=(const Accelerator&) = delete;

  // Rays of a kind that some objects let pass do not meet these.

  RayHit nearest(const WorldRay& ray, RayWorkspace& work, PassingRays kind = passing_none) const;
  bool any(const WorldRay& ray, RayWorkspace& work, PassingRays kind = passing_none) const;

  /// Finds the nearest hits of some of a batch's rays, as nearest() does of each; but what it
  /// leaves in RayWorkspace::here and near is of no use. Hits of other rays stay as they are.
  void nearest_each(const RayBatch& rays, RayMask some, std::span<RayHit, packet_size> hits,
                    Packets packets, RayWorkspace& work, PassingRays kind = passing_none) const;
  /// Returns for which of some rays there is any crossing; `starts` says what these start on.
  RayMask any_each(const RayBatch& rays, const PacketStarts& starts, RayMask some, Packets packets,
                   RayWorkspace& work, PassingRays kind = passing_none) const;
  /// Finds on what some rays start, and what they have left for good.
  PacketStarts noted_starts(const RayBatch& rays, RayMask some) const;

  /// Appends every crossing, unsorted.
  void all(const WorldRay& ray, std::vector<RayHit>& out, RayWorkspace& work) const;
  /// See PreparedData::paths_to_light(), which sorts the crossings.
  LightPaths paths_to_light(const RayBatch& rays, const PacketStarts& starts, RayMask some,
                            const Opacity& opacity, Packets packets, RayWorkspace& work,
                            PassingRays kind) const;
  /// Appends for each solid around the ray's start its next crossing, unsorted. A solid that the
  /// ray never leaves counts as left at infinity.
  void containing_solids(const WorldRay& ray, std::vector<RayHit>& out, RayWorkspace& work) const;
  /// Finds the innermost solid around a point.
  ContainingSolid innermost(const Vec3& point, RayWorkspace& work) const;
  /// Finds whether a ray starts inside of one solid object, and where it leaves that.
  SolidExit find_exit(const WorldRay& ray, std::uint32_t object, RayWorkspace& work) const;

  /// Returns whether all surfaces surely pass by a box. It looks at all objects.
  bool all_pass_by(const Bounds& box) const;

  /// Puts what all() has appended into order.
  void sort(const WorldRay& ray, std::vector<RayHit>& crossings, RayWorkspace& work) const {
    sort_crossings(compiled_, ray, objects_share_surfaces_, crossings, work);
  }

  /// Returns the bytes it takes, but for materials.
  MemoryUse memory() const;

  const CompiledScene& compiled() const { return compiled_; }
  /// Returns the kinds of rays that pass some objects.
  PassingRays kinds_that_pass() const { return kinds_that_pass_; }
  const Leaf& leaf(std::uint32_t index) const { return compiled_.leaves[index]; }
  const Leaf& leaf_of(const RayHit& hit) const { return compiled_.leaf_of(hit); }
  const SceneObject& object(std::uint32_t index) const { return compiled_.objects[index]; }
  /// Returns the filter of a CSG object that has one, else null.
  const IntervalFilter* filter(std::uint32_t object) const {
    const SceneObject& solid = compiled_.objects[object];
    if (!solid.is_csg()) return nullptr;
    const IntervalFilter& filter = compiled_.program_of(solid).filter;
    return filter.empty() ? nullptr : &filter;
  }
  FaceSurface face_surface(const Leaf& leaf, std::uint32_t face) const {
    return leaf.surface_of(face, compiled_.face_surfaces);
  }
  /// Fetches beforehand what the points of hits need.
  void prefetch_surface_points(std::span<const RayHit, packet_size> hits, RayMask some) const;
  /// Returns by how much more than its start_error and end_error a ray may be off the surfaces of
  /// an object at its start and end. That is only of input rays, whose starts nobody knows.
  double size_error(const WorldRay& ray, std::uint32_t object) const {
    if (ray.max_size_error == 0) return 0;
    const Bounds& bounds = compiled_.objects[object].bounds;
    return bounds.finite() ? std::min(ray.max_size_error, start_rounding * radius_of(bounds))
                           : ray.max_size_error;
  }
  /// Returns the largest coordinate of bounded objects, or infinity without any.
  double farthest() const { return farthest_; }
  /// Returns the largest radius of bounded objects.
  double largest_radius() const { return largest_radius_; }
  /// Returns whether a crossing near the ray's end is of a surface through that end.
  bool is_at_end(const WorldRay& ray, const RayHit& hit, RayWorkspace& work) const;
  /// Returns the object that a ray has left for good when it starts: it cannot meet that again.
  std::uint32_t left_for_good(const StartPoint& start) const;
  /// Returns the isolated solid that a ray starts into from its surface, by its place among the
  /// bounded objects.
  std::uint32_t entered_isolated(const StartPoint& start) const;

 private:
  /// Returns the half of a box's longest side.
  static double radius_of(const Bounds& box) {
    return largest_component(box.upper / 2.0 - box.lower / 2.0);
  }

  // The driver is templates over a Real: double for a single ray, Lanes for a batch. `Rays` and
  // `Starts` are those of a RayPacketOf<Real>.
  template <class Real>
  using Rays = typename RayPacketOf<Real>::Rays;
  template <class Real>
  using Starts = typename RayPacketOf<Real>::Starts;

  /// Visits the boxes of bounded objects, as EmbreeTree::traverse() does.
  template <bool FromNear, class Visit>
  void visit_boxes(const SingleRay& ray, RayMask, const Visit& visit) const;
  template <bool FromNear, class Visit>
  void visit_boxes(const RayPacket& packet, RayMask rays, const Visit& visit) const;
  /// Tests the rays of a packet against all objects that they may meet.
  template <class Real, class Tests>
  void traverse(const RayPacketOf<Real>& packet, Tests& tests) const;
  /// Follows some rays until they have found what is asked. Returns the rays that would go on.
  template <class Real, class Asked>
  RayMask follow(const Rays<Real>& rays, const Starts<Real>& starts, RayMask some,
                 const Asked& asked, RayWorkspace& work) const;
  /// Calls test(object) for all objects that may hold the start of a ray, in any order.
  template <class Test>
  void test_around(const WorldRay& ray, RayWorkspace& work, const Test& test) const;
  /// Calls test(object) for all objects that a ray may meet, in any order.
  template <class Test>
  void test_all(const WorldRay& ray, RayWorkspace& work, const Test& test) const;
  /// Finds the nearest hits of rays whose hits are empty.
  template <class Real>
  void find_nearest(const Rays<Real>& rays, RayMask some, std::span<RayHit> hits,
                    RayWorkspace& work, PassingRays kind) const;
  PacketStartsOf<1> noted_starts(const WorldRay& ray, RayMask = 1) const;

  /// Returns whether there are so few boxes that all of them are looked at.
  bool has_flat_box_list() const { return bounded_.list.size() <= FlatBoxList::max_boxes; }
  /// Returns whether some rays are to be followed as a packet.
  bool pay_together(const RayBatch& rays, RayMask some, Packets packets) const;
  /// Returns the box around an isolated object in which there is nothing else.
  Bounds box_around(std::uint32_t object) const {
    return compiled_.objects[object].bounds.grown(margin_);
  }
  /// Takes rays that start into isolated solids to where they leave these: before that they cannot
  /// meet anything else. Returns which rays do; the hits of the others are left empty.
  RayMask leave_isolated(const RayBatch& rays, RayMask some, std::span<RayHit, packet_size> hits,
                         RayWorkspace& work) const;
  RayMask leave_isolated(const WorldRay& ray, RayHit& hit, RayWorkspace& work) const;
  /// Does so for those lanes of a group that start into one such solid.
  template <class Real>
  RayMask leave_isolated(const BoundingProxy& solid, const Rays<Real>& rays, std::size_t group,
                         RayMask lanes, std::span<RayHit> hits, RayWorkspace& work) const;
  /// Returns whether no other crossing with the same face of a leaf is nearer to the ray's end.
  static bool is_nearest_to_end(const PlacedLeaf& leaf, const WorldRay& ray, const RayHit& hit,
                                RayWorkspace& work);
  /// Does so for some rays by the tests of that solid alone.
  template <class Real>
  RayMask leave_by_tests(const BoundingProxy& solid, const Rays<Real>& rays, RayMask some,
                         std::span<RayHit> hits, RayWorkspace& work) const;
  /// Gathers the crossings around the place of a hit with coincident ones into `work`. Returns the
  /// first of those at it.
  RayHit gather_coincident(const WorldRay& ray, const RayHit& nearest, PassingRays kind,
                           RayWorkspace& work) const;

  /// Returns the numbers of bounded objects in the order of boxes of the earlier tree, and then
  /// those that are to be added, or none if that tree is not worth keeping.
  std::vector<std::uint32_t> order_of_earlier(const Accelerator& earlier,
                                              std::span<const std::uint32_t> earlier_objects,
                                              std::span<const std::uint32_t> bounded,
                                              const Bounds& total, const Workers& workers) const;
  /// Returns the proxies for a scene of which objects are from this one.
  EarlierProxies proxies_for(const RecompiledScene& scene) const;
  /// Fills in what is enclosed, from an earlier scene where that has it.
  void find_enclosed(const Accelerator* earlier, std::span<const std::uint32_t> earlier_objects,
                     const Workers& workers);
  /// Gives what encloses objects to the store that these are in.
  void keep_solids();
  /// Builds the tree over the boxes of objects, of which an earlier one may have the first.
  void build_tree(std::span<const std::uint32_t> bounded, const Bounds& total,
                  const Accelerator* earlier, bool is_tree_kept, const Workers& workers);

  CompiledScene compiled_;
  BoundingProxies unbounded_;
  BoundingProxies bounded_;  ///< in the order of the tree's boxes
  /// Holds by leaf the object that is all within it; nothing if there is none, or if a line may
  /// leave the leaf and meet it again.
  std::vector<std::uint32_t> enclosed_;
  /// Rounding moves places in the scene by less than that. Of two objects that are farther apart
  /// neither matters where the other is.
  double margin_ = 0;
  double farthest_ = std::numeric_limits<double>::infinity();
  double largest_radius_ = 0;
  std::vector<std::uint32_t> isolated_;  ///< by object: see isolated_objects()
  BoxTree tree_;                         ///< empty if nothing is bounded
  FlatBoxList flat_box_list_;            ///< takes its place if there are few boxes
  bool objects_share_surfaces_ =
      false;  ///< whether some surface has faces of several objects on it
  PassingRays kinds_that_pass_ = passing_none;
};

}  // namespace crt::core
