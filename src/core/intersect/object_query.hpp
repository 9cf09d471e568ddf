// The solve stage finds the crossings of one ray with one object exactly.
#pragma once

#include <cmath>
#include <limits>

#include "core/compile/leaf_of_hit.hpp"
#include "core/geometry/ray_slabs.hpp"
#include "core/intersect/accelerator.hpp"
#include "core/ray/line_of_ray.hpp"

namespace crt::core {

/// An ObjectQuery follows the crossings of a ray with one object after the other. The derived class
/// says what to keep of them:
///
///     // is called first for each object; false skips the object
///     bool begin(bool starts_inside);
///     // takes crossings with t_min < t <= limit in order until it returns false
///     bool take(const RayHit& hit);
///     // says whether take() never asks for more than the first crossing
///     static constexpr bool takes_one;
///     // says whether set_leaf() is called with the first leaf that holds the start
///     static constexpr bool asks_for_leaf;
///
/// It is a template, as it is asked for every object that a ray comes near.
template <class Kind>
class ObjectQuery {
 public:
  ObjectQuery(const Accelerator& accelerator, const WorldRay& ray, RayWorkspace& work)
      : accelerator_(&accelerator), ray_(&ray), work_(&work), limit_(ray.t_max) {}

  /// Nothing at t > limit() matters. Below t_min the query is done.
  double limit() const { return limit_; }
  void set_limit(double limit) { limit_ = limit; }
  const WorldRay& ray() const { return *ray_; }
  RayWorkspace& work() const { return *work_; }

  void test(std::uint32_t object_index) {
    ++work_->intersection_tests;
    const CompiledScene& scene = accelerator_->compiled();
    const SceneObject& object = scene.objects[object_index];
    if (object.is_instance()) {
      test_instance(object_index, object);
    } else {
      test({scene, object, *ray_, start_error(object_index), object_index, 0, nullptr});
    }
  }
  /// Takes the crossing of a CSG object that its interval filter has found. Returns whether there
  /// is a crossing where it should be.
  bool test_transition(std::uint32_t object_index, const BoundaryTransitions<double>& change);

 protected:
  ~ObjectQuery() = default;

  /// Returns whether a crossing is before the ray's end and not at it.
  bool is_before_end(const RayHit& hit) const {
    return hit.t < certain_end(*ray_) ||
           (hit.t < ray_->t_max && !accelerator_->is_at_end(*ray_, hit, *work_));
  }

  bool begin(bool /*starts_inside*/) { return true; }
  static constexpr bool asks_for_leaf = false;

 private:
  /// An ObjectInScene is an object to be tested, which may be that of a prototype.
  struct ObjectInScene {
    const CompiledScene& scene;
    const SceneObject& object;
    const WorldRay& ray;         ///< with a start on leaves and surfaces of that scene
    double start_error;          ///< StartPoint::t_error with what the object's size adds
    std::uint32_t number;        ///< of the object that hits name
    std::uint32_t first_leaf;    ///< is added to the number of a leaf
    const InstanceFrame* frame;  ///< of an instance

    /// Returns the number that hits give to a surface.
    std::uint32_t surface(std::uint32_t in_scene) const {
      return frame == nullptr ? in_scene : invalid_index;
    }
  };

  Kind& kind() { return static_cast<Kind&>(*this); }
  void test(const ObjectInScene& tested) {
    if (tested.object.is_csg()) {
      test_csg(tested);
    } else {
      test_leaf(tested);
    }
  }
  void test_leaf(const ObjectInScene& tested);
  void test_csg(const ObjectInScene& tested);
  void test_instance(std::uint32_t object_index, const SceneObject& object);
  double start_error(std::uint32_t object_index) const {
    return ray_->start.t_error + accelerator_->size_error(*ray_, object_index);
  }

  const Accelerator* accelerator_;
  const WorldRay* ray_;
  RayWorkspace* work_;
  double limit_;
};

template <class Kind>
void ObjectQuery<Kind>::test_leaf(const ObjectInScene& tested) {
  const WorldRay& ray = tested.ray;
  const std::uint32_t index = tested.object.first_leaf;
  const Leaf& own = tested.scene.leaves[index];
  const PlacedLeaf leaf =
      tested.frame == nullptr ? PlacedLeaf(own) : PlacedLeaf(own, tested.frame->placement_of(own));
  ObjectRay object_ray = ray_to_leaf(leaf, index, tested.scene.face_surfaces, ray);
  CrossingList& crossings = work_->crossings;
  crossings.clear();
  object_ray.begin = ray.t_min;
  if (Kind::takes_one)
    object_ray.first_wanted_after = surely_after(tolerated_start(ray.t_min, tested.start_error));
  bool inside = leaf_crossings(leaf, ray, object_ray, crossings, work_->leaf_escalations);
  // Another object's surface may coincide with the one that the ray starts on: then it is at the
  // start as well.
  const bool starts_here = object_ray.start.face != invalid_index;
  std::size_t place = 0;
  for (; place < crossings.size(); ++place) {
    const Crossing& crossing = crossings[place];
    if (crossing.t > ray.t_min &&
        (starts_here || !is_at_start(leaf, ray, tested.start_error, object_ray, crossing))) {
      break;
    }
    inside = crossing.entering;
  }
  if (!kind().begin(inside && tested.object.solid)) return;
  if constexpr (Kind::asks_for_leaf) kind().set_leaf(tested.first_leaf + index);
  for (; place < crossings.size() && crossings[place].t <= limit_; ++place) {
    const Crossing& crossing = crossings[place];
    const FaceSurface face = own.surface_of(crossing.face, tested.scene.face_surfaces);
    const RayHit hit{.t = crossing.t,
                     .error = crossing.error,
                     .t_low = crossing.t_low,
                     .object = tested.number,
                     .leaf = tested.first_leaf + index,
                     .face = crossing.face,
                     .surface = tested.surface(face.surface),
                     .root = crossing.root,
                     .entering = crossing.entering};
    if (!kind().take(hit)) return;
  }
}

template <class Kind>
void ObjectQuery<Kind>::test_csg(const ObjectInScene& tested) {
  const CsgObject object = tested.scene.csg_object(tested.object);
  WorldRay csg_ray = tested.ray;
  csg_ray.t_max = std::nextafter(limit_, std::numeric_limits<double>::infinity());
  csg_ray.start.t_error = tested.start_error;
  csg_ray.max_size_error = 0;
  CsgEvaluation evaluation(object, csg_ray, work_->csg, Kind::takes_one, tested.frame);
  if (!kind().begin(evaluation.starts_inside())) return;
  if constexpr (Kind::asks_for_leaf) {
    kind().set_leaf(tested.first_leaf + object.first_leaf + evaluation.first_leaf_inside());
  }
  CsgHit found;
  while (evaluation.next(found)) {
    const RayHit hit{.t = found.t,
                     .error = found.error,
                     .t_low = found.t_low,
                     .object = tested.number,
                     .leaf = tested.first_leaf + object.first_leaf + found.leaf,
                     .face = found.face,
                     .surface = tested.surface(found.surface),
                     .root = found.root,
                     .entering = found.entering};
    if (!kind().take(hit)) return;
  }
}

template <class Kind>
void ObjectQuery<Kind>::test_instance(std::uint32_t object_index, const SceneObject& object) {
  const CompiledScene& scene = accelerator_->compiled();
  const CompiledScene& prototype = scene.prototype_of(object);
  const InstanceFrame frame = scene.frame_of(object, work_->placements);
  WorldRay ray = *ray_;
  ray.start = start_in_prototype(scene, object, ray.start);
  test({prototype, prototype.objects[0], ray, start_error(object_index), object_index,
        object.first_leaf, &frame});
}

template <class Kind>
bool ObjectQuery<Kind>::test_transition(std::uint32_t object_index,
                                        const BoundaryTransitions<double>& change) {
  const CompiledScene& scene = accelerator_->compiled();
  const std::uint32_t index =
      accelerator_->object(object_index).first_leaf + static_cast<std::uint32_t>(change.leaf);
  const Leaf& leaf = scene.leaves[index];
  CrossingList& crossings = work_->crossings;
  crossings.clear();
  leaf_crossings(leaf, *ray_, ray_to_leaf(leaf, index, scene.face_surfaces, *ray_), crossings,
                 work_->csg.escalations);
  for (const Crossing& crossing : crossings) {
    if (crossing.entering != change.into_leaf) continue;
    // The leaf's box shows which crossings rounding has put next to it.
    const LineSpan span = RaySlabs::span(ray_->origin, ray_->direction, leaf.bounds);
    if (!(crossing.t >= span.enter && crossing.t <= span.leave)) return false;
    ++work_->csg.events;
    kind().take({.t = crossing.t,
                 .error = crossing.error,
                 .t_low = crossing.t_low,
                 .object = object_index,
                 .leaf = index,
                 .face = crossing.face,
                 .surface = accelerator_->face_surface(leaf, crossing.face).surface,
                 .root = crossing.root,
                 .entering = change.into_object});
    return true;
  }
  return false;
}

}  // namespace crt::core
