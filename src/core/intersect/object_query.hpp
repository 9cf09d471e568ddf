// One ray's query of a scene's objects, whatever finds them.
#pragma once

#include <cmath>
#include <limits>

#include "core/intersect/accelerator.hpp"
#include "core/ray/line_of_ray.hpp"

namespace crt::core {

/// Follows the crossings of one object after the other. What a kind of query keeps of them the
/// class derived from it says (a template, as it is called for every object that a ray comes near):
///
///     bool begin(std::uint32_t object, bool starts_inside);  // is told first; false skips the
///     object bool take(const RayHit& hit);  // crossings with t_min < t <= limit in order until it
///     returns false void end(std::uint32_t object, std::uint32_t leaf, bool inside);  // there are
///     no more static constexpr bool takes_one;  // whether take() never asks for more than the
///     first crossing
template <class Kind>
class ObjectQuery {
 public:
  ObjectQuery(const Accelerator& accelerator, const WorldRay& ray, RayWorkspace& work)
      : accelerator_(&accelerator), ray_(&ray), work_(&work), limit_(ray.t_max) {
    work.csg.steps.begin_ray();
  }

  /// Nothing at t > limit() matters any more; below t_min, the query is done.
  double limit() const { return limit_; }
  void set_limit(double limit) { limit_ = limit; }
  const WorldRay& ray() const { return *ray_; }
  RayWorkspace& work() const { return *work_; }
  /// Is to be told of every object that the ray is tested against.
  void step() { work_->csg.steps.step(); }

  void test(std::uint32_t object_index) {
    const SceneObject& object = accelerator_->object(object_index);
    if constexpr (Kind::takes_one) {
      if (test_filter(object_index, object)) {
        ++work_->intersection_tests;
        return;
      }
    }
    test_in_full(object_index);
  }
  /// Without a filter.
  void test_in_full(std::uint32_t object_index) {
    ++work_->intersection_tests;
    const SceneObject& object = accelerator_->object(object_index);
    if (object.is_csg()) {
      test_csg(object_index, object);
    } else {
      test_leaf(object_index, object);
    }
  }
  /// Of a CSG object the change that its filter has found, if there is a crossing where it should
  /// be.
  bool test_change(std::uint32_t object_index, const BoundaryChanges<double>& change);

 protected:
  ~ObjectQuery() = default;

  /// Whether a crossing is before the ray's end and not at it.
  bool is_before_end(const RayHit& hit) const {
    return hit.t < certain_end(*ray_) ||
           (hit.t < ray_->t_max && !accelerator_->is_at_end(*ray_, hit));
  }

  bool begin(std::uint32_t /*object*/, bool /*starts_inside*/) { return true; }
  void end(std::uint32_t /*object*/, std::uint32_t /*leaf*/, bool /*inside*/) {}

 private:
  Kind& kind() { return static_cast<Kind&>(*this); }
  void test_leaf(std::uint32_t object_index, const SceneObject& object);
  void test_csg(std::uint32_t object_index, const SceneObject& object);
  /// By a filter of the object; false if that leaves anything open.
  bool test_filter(std::uint32_t object_index, const SceneObject& object);

  /// A leaf that is an object of its own, whose crossings are in the workspace.
  struct LoneLeaf {
    std::uint32_t object;
    std::uint32_t index;
    const Leaf& leaf;
    const ObjectRay& object_ray;
    bool solid;
  };
  void follow(const LoneLeaf& lone, bool inside);

  const Accelerator* accelerator_;
  const WorldRay* ray_;
  RayWorkspace* work_;
  double limit_;
};

template <class Kind>
void ObjectQuery<Kind>::test_leaf(std::uint32_t object_index, const SceneObject& object) {
  const Leaf& leaf = accelerator_->leaf(object.first_leaf);
  ObjectRay object_ray = accelerator_->object_ray(object.first_leaf, *ray_);
  CrossingList& crossings = work_->crossings;
  crossings.clear();
  object_ray.begin = ray_->t_min;
  if (Kind::takes_one) object_ray.first_above = asked_above(farthest_start(*ray_));
  const bool inside = leaf_crossings(leaf, *ray_, object_ray, crossings, work_->leaf_escalations);
  follow({object_index, object.first_leaf, leaf, object_ray, object.solid}, inside);
}

template <class Kind>
void ObjectQuery<Kind>::follow(const LoneLeaf& lone, bool inside) {
  const CrossingList& crossings = work_->crossings;
  // Another object's surface that coincides with the one the ray starts on is at the start as well.
  const bool starts_here = lone.object_ray.start.face != no_face;
  std::size_t index = 0;
  for (; index < crossings.size(); ++index) {
    const Crossing& crossing = crossings[index];
    if (crossing.t > ray_->t_min &&
        (starts_here || !is_at_start(lone.leaf, *ray_, lone.object_ray, crossing))) {
      break;
    }
    inside = crossing.entering;
  }
  if (!kind().begin(lone.object, inside && lone.solid)) return;
  for (; index < crossings.size() && crossings[index].t <= limit_; ++index) {
    const Crossing& crossing = crossings[index];
    inside = crossing.entering;
    const RayHit hit{.t = crossing.t,
                     .error = crossing.error,
                     .t_low = crossing.t_low,
                     .object = lone.object,
                     .leaf = lone.index,
                     .face = crossing.face,
                     .surface = accelerator_->face_surface(lone.leaf, crossing.face).surface,
                     .root = crossing.root,
                     .entering = crossing.entering};
    if (!kind().take(hit)) return;
  }
  kind().end(lone.object, lone.index, inside && lone.solid);
}

template <class Kind>
void ObjectQuery<Kind>::test_csg(std::uint32_t object_index, const SceneObject& object) {
  const CompiledScene& scene = accelerator_->compiled();
  const CsgProgram& program = scene.programs[object.program];
  WorldRay csg_ray = *ray_;
  csg_ray.t_max = std::nextafter(limit_, std::numeric_limits<double>::infinity());
  CsgEvaluation evaluation(program, scene.leaves, scene.face_surfaces, csg_ray, work_->csg);
  bool inside = evaluation.starts_inside();
  std::uint32_t leaf = program.first_leaf;
  if (!kind().begin(object_index, inside)) return;
  CsgHit found;
  while (evaluation.next(found)) {
    inside = found.entering;
    leaf = program.first_leaf + found.leaf;
    const RayHit hit{.t = found.t,
                     .error = found.error,
                     .t_low = found.t_low,
                     .object = object_index,
                     .leaf = leaf,
                     .face = found.face,
                     .surface = found.surface,
                     .root = found.root,
                     .entering = found.entering};
    if (!kind().take(hit)) return;
  }
  kind().end(object_index, leaf, inside);
}

template <class Kind>
bool ObjectQuery<Kind>::test_filter(std::uint32_t object_index, const SceneObject& object) {
  const CompiledScene& scene = accelerator_->compiled();
  const IntervalFilter* filter = accelerator_->filter(object_index);
  if (filter == nullptr) return false;
  const FilterLine<double> line = line_of(*ray_);
  const bool on_surface = ray_->start.surface != nothing;
  const auto change =
      filter->first_changes<double>({.lines = line,
                                     .limits = limit_,
                                     .asked = 1,
                                     .on_surface = on_surface,
                                     .starts = {&ray_->start, 1}},
                                    scene.programs[object.program], scene.leaves_of(object),
                                    scene.face_surfaces, work_->near_leaves, work_->csg.steps);
  if (!change.one) return change.none;
  if constexpr (Kind::any_will_do) {
    if (change.to < line.certain_to) {
      kind().settle();
      return true;
    }
  }
  return test_change(object_index, change);
}

template <class Kind>
bool ObjectQuery<Kind>::test_change(std::uint32_t object_index,
                                    const BoundaryChanges<double>& change) {
  const CompiledScene& scene = accelerator_->compiled();
  const std::uint32_t index =
      accelerator_->object(object_index).first_leaf + static_cast<std::uint32_t>(change.leaf);
  const Leaf& leaf = scene.leaves[index];
  CrossingList& crossings = work_->crossings;
  crossings.clear();
  leaf_crossings(leaf, *ray_, accelerator_->object_ray(index, *ray_), crossings,
                 work_->csg.escalations);
  for (const Crossing& crossing : crossings) {
    if (crossing.entering != change.into_leaf) continue;
    // What rounding puts next to the leaf's box is told by the box.
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
