// A CSG object is evaluated along a ray by intervals.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/csg/exact_order.hpp"
#include "core/csg/instance.hpp"
#include "core/csg/one_place.hpp"
#include "core/csg/program.hpp"
#include "core/csg/ray_steps.hpp"
#include "core/ray/world_ray.hpp"

namespace crt::core {

/// A CsgCrossing is a leaf's crossing among those of its whole object.
struct CsgCrossing {
  double t = 0;
  double error = 0;
  double t_low = 0;        ///< as in Crossing
  double enter = 0;        ///< where the line enters the leaf's box
  std::uint32_t leaf = 0;  ///< within the object
  std::uint32_t face = 0;
  std::uint32_t surface = 0;
  std::uint8_t root = 0;
  bool entering = false;  ///< the primitive, whether or not it is complemented
  double reach = -1;      ///< of its place (one_place.hpp), once it has been asked for
  std::uint32_t shared =
      FaceSurface::not_shared;  ///< the number of its surface, if it is another leaf's too
  std::uint32_t place = 0;      ///< if not 0: exactly the crossings at one place have it in common
  bool moved = false;           ///< t is that of the start, and not where the surface is
};

/// A CsgHit is a crossing of the object's own boundary.
struct CsgHit {
  double t = 0;
  double error = 0;
  double t_low = 0;
  std::uint32_t leaf = 0;  ///< within the object: whose face it is, and so whose material
  std::uint32_t face = 0;
  std::uint32_t surface = 0;
  std::uint8_t root = 0;  ///< as in Crossing
  bool entering = false;  ///< the object
};

/// A CsgWorkspace is memory that one thread reuses from ray to ray.
class CsgWorkspace {
 public:
  /// This counts the crossings handled since the workspace was made.
  std::uint64_t events = 0;
  /// This counts the exact fallbacks: the questions of the exact tier that only exact arithmetic
  /// answered.
  std::uint64_t escalations = 0;
  /// These are the steps of the ray that is followed now.
  RaySteps steps;

  /// Returns CrossingList::undecided of all leaves.
  std::uint64_t undecided() const { return leaf_crossings_.undecided; }
  void forget_undecided() { leaf_crossings_.undecided = 0; }

 private:
  friend class CsgEvaluation;

  /// A NodeState is the state of a node. That of another ray, or of another object, counts as that
  /// outside of all leaves.
  struct NodeState {
    std::uint32_t count = 0;
    std::uint64_t stamp = 0;  ///< of the cluster in which it was last touched
    bool value_before = false;
  };
  struct LeafState {
    std::uint64_t stamp = 0;
    bool inside = false;
  };
  /// A SharedState is of a shared surface and a root number. It says how many crossings are to
  /// come, and which is the last cluster that has one.
  struct SharedState {
    std::uint64_t stamp = 0;
    std::uint32_t to_come = 0;
    std::uint64_t cluster = 0;
  };
  /// An Opening is a box that the line enters at `enter`.
  struct Opening {
    double enter = 0;
    Bvh::Child child;
  };
  /// A Piece is how far a leaf of many faces has been followed, whose crossings come piece by
  /// piece.
  struct Piece {
    std::uint32_t leaf = 0;
    double enter = 0;   ///< where the line enters its box
    double after = 0;   ///< the t of the last crossing so far
    double beyond = 0;  ///< where the next opening is that it waits for, or infinity
  };
  /// A ToCome is one of met_ that is still to come.
  struct ToCome {
    double t = 0;
    std::uint32_t index = 0;
  };

  std::uint64_t stamp_ = 0;
  std::uint32_t places_ = 0;  ///< resolved along this ray
  CrossingList leaf_crossings_;
  std::vector<Piece> pieces_;
  std::vector<Opening> openings_;       ///< a heap, the nearest first
  std::vector<std::uint32_t> to_open_;  ///< nodes of the tree that are next
  std::vector<CsgCrossing> met_;        ///< all crossings of this ray so far
  std::vector<ToCome> to_come_;         ///< a heap, the nearest first
  std::vector<const CsgCrossing*> cluster_;
  std::vector<ToCome> near_;  ///< what is to be resolved
  std::vector<NearCrossing> near_crossings_;
  std::vector<const CsgCrossing*> causes_;
  std::vector<NodeState> nodes_;
  PathWorkspace paths_;  ///< in the place of nodes_, of deep programs
  std::vector<LeafState> leaves_;
  std::vector<SharedState> shared_;
};

/// Returns a face of `leaf` that lies on the surface a ray starts on, as the leaf's own ray needs
/// to know it. Returns none if there is no such face. The leaf has the number `index` in the scene.
FaceStart start_on_leaf(const Leaf& leaf, std::uint32_t index,
                        std::span<const FaceSurface> face_surfaces, const StartPoint& start);

/// Returns a ray in the world as it is in the space of a leaf, with where it starts on that. The
/// leaf has the number `index` in its scene.
ObjectRay ray_to_leaf(const PlacedLeaf& leaf, std::uint32_t index,
                      std::span<const FaceSurface> face_surfaces, const WorldRay& ray);

/// Appends the crossings of a leaf with a ray in the world, which is `object_ray` in the leaf's
/// space, by the leaf's tier. Returns whether the line is inside at t = -inf.
bool leaf_crossings(const PlacedLeaf& leaf, const WorldRay& ray, const ObjectRay& object_ray,
                    CrossingList& out, std::uint64_t& escalations);

/// Returns the ray in the space of a leaf of the exact tier. There it is `object_ray`, which must
/// outlive it, as the placement must.
ExactRay exact_ray(const Placement& placement, const WorldRay& ray, const ObjectRay& object_ray,
                   std::uint64_t& escalations);

/// Returns whether a crossing near the start is of a surface through it, which rounding may have
/// put off the start by `start_error`.
bool is_through_start(const PlacedLeaf& leaf, const WorldRay& ray, double start_error,
                      const ObjectRay& object_ray, const Crossing& crossing);

/// Returns whether a crossing is at the start, or before it, so that rounding decides whether it is
/// ahead. It is of another surface than the one that the ray starts on. `object_ray` is the ray in
/// the leaf's space.
inline bool is_at_start(const PlacedLeaf& leaf, const WorldRay& ray, double start_error,
                        const ObjectRay& object_ray, const Crossing& crossing) {
  const double distance = crossing.t - ray.t_min - crossing.error;
  if (ray.is_input) {
    // Where an error is longer than that, it says nothing of the start.
    if (distance + crossing.error > start_tolerance(start_error)) return false;
    if (distance <= (errors_at_start - 1) * crossing.error) return true;
  }
  if (distance > start_tolerance(start_error)) return false;
  return distance <= start_error || is_through_start(leaf, ray, start_error, object_ray, crossing);
}

/// A CsgEvaluation walks along a ray through one CSG object, from one crossing of its boundary to
/// the next.
///
///  1. The boxes of the tree are opened in the order in which the line enters them, and no further
///     than the next crossing asks for. A leaf whose box is opened puts its crossings among those
///     to come. One of many faces, a mesh, may do so piece by piece.
///  2. The first of these and all that coincide with it form a *cluster*. Those are crossings at
///     one place (one_place.hpp), and those of one surface. In the exact tier the former are
///     separated nevertheless (exact_order.hpp).
///  3. A cluster's flips happen all at once. Counters up the tree change only as far as values do,
///     and in deep programs paths take their place (heavy_paths.hpp). Only the root's value before
///     and after counts, so pieces without length vanish.
///  4. What is up to t_min (and what coincides with the surface the ray starts on) only sets the
///     state. After that each change of the root is a hit. Its face is that of the lowest leaf
///     through whose changes, node by node, the root changed.
///
/// A leaf is outside of its primitive before the line enters its box, as far as it matters. So the
/// costs follow what the ray meets. They are O(log leaves) for each box that it comes near and
/// O(depth) for each crossing, or O(log^2 nodes) if the program is deep.
class CsgEvaluation {
 public:
  /// With `first_is_enough` it is rarely asked for more than one crossing. An instance has a frame.
  /// Leaf and surface that its ray starts on are then those of the prototype.
  CsgEvaluation(const CsgObject& object, const WorldRay& ray, CsgWorkspace& workspace,
                bool first_is_enough = false, const InstanceFrame* frame = nullptr);

  /// Returns whether the start of the ray (just after t_min) is inside the object.
  bool starts_inside() const { return starts_inside_; }

  /// Returns the first leaf, as written, that holds the start of a ray which starts inside. It is
  /// no cutter. To be asked for before next().
  std::uint32_t first_leaf_inside() const;

  /// Finds the next crossing of the boundary with t < t_max. Returns false if there is none.
  bool next(CsgHit& hit);

 private:
  using NodeState = CsgWorkspace::NodeState;
  using SharedState = CsgWorkspace::SharedState;

  /// Puts off a child that is entered at `enter`, to be opened when it is asked for.
  void put_off(Bvh::Child child, double enter);
  /// Opens all boxes that are entered up to t.
  void open_up_to(double t);
  /// Opens all boxes below a node that are entered up to t.
  void open_node(std::uint32_t node, double t);
  /// Opens boxes until there is a crossing, and all that can coincide with it. Returns false if
  /// there is none.
  bool find_crossing();
  void open_what_may_coincide();
  /// Orders what is near the next crossing, in the exact tier, so that what of it coincides is
  /// known for good.
  void order_near_crossings();
  bool is_near_next(double t) const;
  void gather_near();
  void open_leaf(std::uint32_t index, double enter);
  /// Returns the leaf with the placement that is known until another leaf is asked for.
  PlacedLeaf placed(const Leaf& leaf) const {
    return frame_ == nullptr ? PlacedLeaf(leaf) : PlacedLeaf(leaf, frame_->placement_of(leaf));
  }
  /// Gathers the crossings of a leaf in leaf_crossings_, as leaf_crossings() does.
  bool gather_crossings(const PlacedLeaf& leaf);
  /// Gathers the next crossings of a leaf of many faces, up to the first that may matter. Whatever
  /// is beyond waits for another opening. Sets `enter` to where the line enters its box.
  bool gather_piece(std::uint32_t index, const PlacedLeaf& leaf, double& enter);
  /// Opens what of pieces is before a crossing that coincides with the next one, so that all is
  /// there in order. Returns whether there was any.
  bool open_pieces_between();
  /// Counts the handling of one crossing. Whoever may stop the ray is asked now and then.
  void tick() {
    if (++ticks_ % steps_per_look == 0) [[unlikely]]
      work_.steps.poll();
  }
  CsgCrossing& next_crossing() const { return work_.met_[work_.to_come_.front().index]; }
  /// Returns how far behind a crossing others may be at its place.
  double tolerance(const CsgCrossing& crossing) const {
    return coincidence_tolerance(ray_, crossing.t, crossing.error);
  }
  /// Returns whether another crossing is so near to the first one to come that it may be at its
  /// place. What is not opened before the end of that place is not.
  bool is_near(const CsgCrossing& first, const CsgCrossing& other) const;
  double reach(CsgCrossing& crossing) const;
  /// Takes the next crossing into the cluster's place, if it is there.
  bool coincides(const CsgCrossing& first, CsgCrossing& next, CommonPlace& place) const;
  bool is_later(const CsgWorkspace::ToCome& a, const CsgWorkspace::ToCome& b) const;
  /// Returns the order of the heap of what is to come.
  auto later() const {
    return [this](const auto& a, const auto& b) { return is_later(a, b); };
  }
  /// Takes the next crossing, and what coincides with it, from those to come.
  void gather_cluster();
  void add_to_cluster(const CsgCrossing& crossing);
  void gather_shared();
  /// Flips the leaves of the cluster and returns whether the root changed.
  bool flip_cluster();
  void flip_leaf(std::uint32_t leaf);
  NodeState& state(std::uint32_t node);
  /// Returns the state of a crossing whose surface is shared.
  SharedState& shared_state(const CsgCrossing& crossing);
  bool value(std::uint32_t node);
  bool root_value() { return paths_ ? paths_->root() : value(0); }
  bool leaf_inside(std::uint32_t leaf) const;
  CsgHit blame();
  /// Finds the crossings of the cluster through whose changes, node by node, the root changed.
  void find_causes();
  bool is_changed_up_to_root(std::uint32_t leaf, bool now);

  const CsgProgram& program_;
  std::span<const Leaf> leaves_;  ///< of the object
  std::uint32_t first_leaf_;      ///< the number of the first of them in the scene
  std::span<const FaceSurface> face_surfaces_;
  WorldRay ray_;
  CsgWorkspace& work_;
  const InstanceFrame* frame_;
  RaySlabs slabs_;
  LineSpan part_;  ///< of the line: what is within it may matter
  std::uint64_t first_stamp_;
  std::optional<PathValues> paths_;       ///< of a deep program
  const Placement* placement_ = nullptr;  ///< the own one of the leaves that object_ray_ is for
  ObjectRay object_ray_;
  bool starts_inside_ = false;
  std::uint64_t ticks_ = 0;
  bool exact_ = false;  ///< the tier
  bool first_is_enough_;
};

}  // namespace crt::core
