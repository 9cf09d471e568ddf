// Interval evaluation of a CSG object along a ray.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/csg/program.hpp"

namespace crt::core {

inline constexpr std::uint32_t nothing = 0xffffffffu;

/// A leaf's crossing among those of its whole object.
struct CsgCrossing {
  double t = 0;
  double error = 0;
  double t_low = 0;        ///< as in Crossing
  std::uint32_t leaf = 0;  ///< within the object
  std::uint32_t face = 0;
  std::uint32_t surface = 0;
  std::uint8_t root = 0;
  bool entering = false;  ///< the primitive, whether or not it is complemented
};

/// A crossing of the object's own boundary.
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

/// Where a ray starts, by identity: (leaf, face) is the piece of surface, `surface` the whole surface
/// it lies on (shared by all faces of the scene that coincide). In free space all are nothing.
struct StartPoint {
  std::uint32_t leaf = nothing;
  std::uint32_t face = no_face;
  std::uint32_t surface = nothing;
  Side side = Side::outside;  ///< of that surface, by its canonical orientation
  /// How far rounding may have put the start from *other* surfaces that are there too: see is_at_start().
  double t_error = 0;
};

/// What rounding makes of a point that was meant to be on several surfaces: it is this far from them at most,
/// as a multiple of its largest coordinate.
inline constexpr double start_rounding = 8 * std::numeric_limits<double>::epsilon();

/// A ray in the world: origin + t * direction, t_min < t < t_max.
struct WorldRay {
  Vec3 origin{0, 0, 0};
  Vec3 direction{0, 0, 1};
  double t_min = 0;
  double t_max = std::numeric_limits<double>::infinity();
  StartPoint start{};
  /// If what the ray ends at may be on a surface: how far from that surface rounding may have put it. Where
  /// asked what is on the way there, surfaces through the end are not.
  double end_error = 0;
};

/// Memory that one thread reuses from ray to ray.
class CsgWorkspace {
 public:
  /// Crossings handled since it was made.
  std::uint64_t events = 0;
  /// Questions of the exact tier that only exact arithmetic answered.
  std::uint64_t escalations = 0;

 private:
  friend class CsgEvaluation;

  struct NodeState {
    std::uint32_t count = 0;
    std::uint32_t stamp = 0;  ///< of the cluster in which it was last touched
    bool value_before = false;
  };

  CrossingList leaf_crossings_;
  std::vector<CsgCrossing> crossings_;
  std::vector<NodeState> nodes_;
  std::vector<std::uint8_t> leaf_values_;
};

/// A face of `leaf` (which has the number `index` in the scene) that lies on the surface a ray starts
/// on, as the leaf's own ray needs to know it; none if there is no such face.
RayStart start_on_leaf(const Leaf& leaf, std::uint32_t index, std::span<const FaceSurface> face_surfaces,
                       const StartPoint& start);

/// The crossings of a leaf with a ray in the world, which is `object_ray` in the leaf's space, by the leaf's
/// tier. Of the crossings with t above `first_above` those behind the first may be left out.
bool leaf_crossings(const Leaf& leaf, const WorldRay& ray, const ObjectRay& object_ray, CrossingList& out,
                    std::uint64_t& escalations, double first_above = std::numeric_limits<double>::infinity());

/// The flatter a ray meets a surface, the farther from its start it may do so if that is on the surface: up
/// to this many times the rounding of the start.
inline constexpr double flattest_start = 0x1p24;

/// Whether a crossing near the start is of a surface through it.
bool is_through_start(const Leaf& leaf, const WorldRay& ray, const ObjectRay& object_ray,
                      const Crossing& crossing);

/// Whether a crossing of another surface than the one that the ray starts on is at the start, or before it:
/// whether it is ahead is left to rounding. `object_ray` is the ray in the leaf's space.
inline bool is_at_start(const Leaf& leaf, const WorldRay& ray, const ObjectRay& object_ray,
                        const Crossing& crossing) {
  const double way = crossing.t - ray.t_min - crossing.error;
  if (way > flattest_start * ray.start.t_error) return false;
  return way <= ray.start.t_error || is_through_start(leaf, ray, object_ray, crossing);
}

/// The part of a line inside a box, rounded outwards; empty (enter > leave) if it misses the box.
struct LineSpan {
  double enter = 0;
  double leave = 0;
};
LineSpan span_in_box(const Bounds& bounds, const Vec3& origin, const Vec3& direction);

/// Walks along a ray through one CSG object, from one crossing of its boundary to the next.
///
///  1. Collect the crossings of every leaf with the whole line (leaves whose box the line misses
///     have none). Crossings of one surface by different leaves get one t.
///  2. Sort by t. Crossings that their error bounds cannot tell apart form a *cluster*.
///  3. A cluster's flips happen all at once: counters up the tree change only as far as values do.
///     Only the root's value before and after counts, so pieces without length vanish.
///  4. Clusters up to t_min (and what coincides with the surface the ray starts on) only set the
///     state; after that each change of the root is a hit. Its face is that of the lowest leaf
///     through whose changes, node by node, the root changed.
///
/// Costs O(leaves met + crossings * depth) after step 1, and a box test a leaf in step 1.
class CsgEvaluation {
 public:
  CsgEvaluation(const CsgProgram& program, std::span<const Leaf> leaves,
                std::span<const FaceSurface> face_surfaces, const WorldRay& ray, CsgWorkspace& workspace);

  /// Whether the start of the ray (just after t_min) is inside the object.
  bool starts_inside() const { return starts_inside_; }

  /// The next crossing of the boundary with t < t_max; false if there is none.
  bool next(CsgHit& hit);

 private:
  void collect(std::span<const FaceSurface> face_surfaces);
  void unify_coincident();
  std::size_t cluster_end(std::size_t begin) const;
  /// Flips everything in [begin, end) and returns whether the root changed.
  bool flip(std::size_t begin, std::size_t end);
  void flip_leaf(std::uint32_t leaf);
  bool value(std::uint32_t node) const;
  CsgHit blame(std::size_t begin, std::size_t end) const;
  bool caused_change(std::uint32_t leaf) const;

  const CsgProgram& program_;
  std::span<const Leaf> leaves_;
  WorldRay ray_;
  CsgWorkspace& work_;
  std::size_t position_ = 0;
  std::uint32_t stamp_ = 0;
  bool starts_inside_ = false;
};

}  // namespace crt::core
