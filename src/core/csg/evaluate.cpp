#include "core/csg/evaluate.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

namespace crt::core {

RayStart start_on_leaf(const Leaf& leaf, std::uint32_t index, std::span<const FaceSurface> face_surfaces,
                       const StartPoint& start) {
  if (start.surface == nothing) return {};
  const auto on_face = [&](std::uint32_t face) {
    const bool outside = (start.side == Side::outside) != face_surfaces[leaf.first_face + face].flipped;
    return RayStart{.face = face,
                    .side = outside ? Side::outside : Side::inside,
                    .on_face = start.leaf == index && start.face == face};
  };
  if (start.leaf == index) return on_face(start.face);
  for (std::uint32_t face = 0; face < leaf.face_count; ++face) {
    if (face_surfaces[leaf.first_face + face].surface == start.surface) return on_face(face);
  }
  return {};
}

bool leaf_crossings(const Leaf& leaf, const WorldRay& ray, const ObjectRay& object_ray, CrossingList& out,
                    std::uint64_t& escalations, double first_above) {
  if (!leaf.exact) return leaf.shape->crossings(object_ray, out);
  ExactRay exact = leaf.placement->to_object_exactly(ray.origin, ray.direction, object_ray);
  exact.start_error = ray.start.t_error;
  exact.first_above = first_above;
  exact.escalations = &escalations;
  return leaf.exact->crossings(exact, out);
}

LineSpan span_in_box(const Bounds& bounds, const Vec3& origin, const Vec3& direction) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  // Two roundings go into each t: of the difference and of the quotient.
  constexpr double slack = 4 * std::numeric_limits<double>::epsilon();
  constexpr LineSpan miss{inf, -inf};
  LineSpan span{-inf, inf};
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = bounds.lower[axis];
    const double upper = bounds.upper[axis];
    if (direction[axis] == 0) {
      if (origin[axis] < lower || origin[axis] > upper) return miss;
      continue;
    }
    double first = (lower - origin[axis]) / direction[axis];
    double second = (upper - origin[axis]) / direction[axis];
    if (first > second) std::swap(first, second);
    span.enter = std::max(span.enter, first - slack * std::abs(first));
    span.leave = std::min(span.leave, second + slack * std::abs(second));
  }
  return span;
}

CsgEvaluation::CsgEvaluation(const CsgProgram& program, std::span<const Leaf> leaves,
                             std::span<const FaceSurface> face_surfaces, const WorldRay& ray,
                             CsgWorkspace& workspace)
    : program_(program),
      leaves_(leaves.subspan(program.first_leaf, program.leaf_count())),
      ray_(ray),
      work_(workspace) {
  work_.nodes_.resize(program.nodes.size());
  for (std::size_t i = 0; i < program.nodes.size(); ++i)
    work_.nodes_[i] = {program.nodes[i].count_outside, 0, false};
  work_.leaf_values_.assign(program.leaf_count(), 0);
  collect(face_surfaces);
  while (position_ < work_.crossings_.size() && work_.crossings_[position_].t <= ray_.t_min) {
    const std::size_t end = cluster_end(position_);
    flip(position_, end);
    position_ = end;
  }
  starts_inside_ = value(0);
}

void CsgEvaluation::collect(std::span<const FaceSurface> face_surfaces) {
  work_.crossings_.clear();
  ++stamp_;
  // Leaves that are placed alike follow one another: the ray is taken to their space once.
  const Placement* placement = nullptr;
  ObjectRay object_ray;
  for (std::uint32_t index = 0; index < program_.leaf_count(); ++index) {
    const Leaf& leaf = leaves_[index];
    // A leaf that the line misses, has passed or meets too late stays outside.
    const LineSpan span = span_in_box(leaf.bounds, ray_.origin, ray_.direction);
    if (span.enter > span.leave || span.leave < ray_.t_min - ray_.start.t_error || span.enter > ray_.t_max)
      continue;
    if (leaf.placement != placement) {
      placement = leaf.placement;
      object_ray = placement->to_object(ray_.origin, ray_.direction);
    }
    object_ray.start = start_on_leaf(leaf, program_.first_leaf + index, face_surfaces, ray_.start);
    work_.leaf_crossings_.clear();
    if (leaf_crossings(leaf, ray_, object_ray, work_.leaf_crossings_, work_.escalations)) flip_leaf(index);
    for (const Crossing& crossing : work_.leaf_crossings_) {
      const std::uint32_t surface = face_surfaces[leaf.first_face + crossing.face].surface;
      double t = crossing.t;
      double t_low = crossing.t_low;
      // What coincides with the start but is another surface: rounding alone says on which side.
      if (surface != ray_.start.surface && t > ray_.t_min &&
          t - crossing.error <= ray_.t_min + ray_.start.t_error) {
        t = ray_.t_min;
        t_low = 0;
      }
      work_.crossings_.push_back({.t = t,
                                  .error = crossing.error,
                                  .t_low = t_low,
                                  .leaf = index,
                                  .face = crossing.face,
                                  .surface = surface,
                                  .root = crossing.root,
                                  .entering = crossing.entering});
    }
  }
  work_.events += work_.crossings_.size();
  if (program_.coincident_faces) unify_coincident();
  std::sort(work_.crossings_.begin(), work_.crossings_.end(), [](const CsgCrossing& a, const CsgCrossing& b) {
    return std::tie(a.t, a.t_low, a.leaf, a.entering) < std::tie(b.t, b.t_low, b.leaf, b.entering);
  });
}

void CsgEvaluation::unify_coincident() {
  auto& crossings = work_.crossings_;
  std::sort(crossings.begin(), crossings.end(), [](const CsgCrossing& a, const CsgCrossing& b) {
    return std::tie(a.surface, a.root, a.leaf) < std::tie(b.surface, b.root, b.leaf);
  });
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    const CsgCrossing& first = crossings[i - 1];
    if (crossings[i].surface != first.surface || crossings[i].root != first.root) continue;
    crossings[i].t = first.t;
    crossings[i].error = first.error;
    crossings[i].t_low = first.t_low;
  }
}

std::size_t CsgEvaluation::cluster_end(std::size_t begin) const {
  const auto& crossings = work_.crossings_;
  const CsgCrossing& first = crossings[begin];
  std::size_t end = begin + 1;
  const auto way_from_first = [&](const CsgCrossing& crossing) {
    return (crossing.t - first.t) + (crossing.t_low - first.t_low);
  };
  while (end < crossings.size() && way_from_first(crossings[end]) <= first.error + crossings[end].error)
    ++end;
  return end;
}

bool CsgEvaluation::value(std::uint32_t node) const {
  return work_.nodes_[node].count >= program_.nodes[node].needed;
}

bool CsgEvaluation::flip(std::size_t begin, std::size_t end) {
  const bool before = value(0);
  ++stamp_;
  for (std::size_t i = begin; i < end; ++i) flip_leaf(work_.crossings_[i].leaf);
  return value(0) != before;
}

void CsgEvaluation::flip_leaf(std::uint32_t leaf) {
  work_.leaf_values_[leaf] ^= 1;
  bool now = (work_.leaf_values_[leaf] != 0) != leaves_[leaf].complemented;
  std::uint32_t node = program_.leaf_parents[leaf];
  while (true) {
    auto& state = work_.nodes_[node];
    const bool before = value(node);
    if (state.stamp != stamp_) {
      state.stamp = stamp_;
      state.value_before = before;
    }
    state.count += now ? 1u : ~0u;
    const bool after = value(node);
    if (after == before || node == 0) return;
    now = after;
    node = program_.nodes[node].parent;
  }
}

bool CsgEvaluation::caused_change(std::uint32_t leaf) const {
  const bool now = value(0);
  if (((work_.leaf_values_[leaf] != 0) != leaves_[leaf].complemented) != now) return false;
  std::uint32_t node = program_.leaf_parents[leaf];
  while (true) {
    const auto& state = work_.nodes_[node];
    if (state.stamp != stamp_ || state.value_before == now || value(node) != now) return false;
    if (node == 0) return true;
    node = program_.nodes[node].parent;
  }
}

CsgHit CsgEvaluation::blame(std::size_t begin, std::size_t end) const {
  const CsgCrossing* cause = nullptr;
  // What changed the root and is known best tells the place: others may be known far worse, where the ray
  // grazes them.
  const CsgCrossing* place = nullptr;
  for (std::size_t i = begin; i < end; ++i) {
    const CsgCrossing& crossing = work_.crossings_[i];
    // The crossing must be the one that gave the leaf its value, not one undone in the same cluster.
    if (crossing.entering != (work_.leaf_values_[crossing.leaf] != 0)) continue;
    if (!caused_change(crossing.leaf)) continue;
    if (cause == nullptr || crossing.leaf < cause->leaf) cause = &crossing;
    if (place == nullptr || crossing.error < place->error) place = &crossing;
  }
  if (cause == nullptr) cause = &work_.crossings_[begin];
  if (place == nullptr || !(place->t < ray_.t_max)) place = &work_.crossings_[begin];
  return {.t = place->t,
          .error = cause->error,
          .t_low = place->t_low,
          .leaf = cause->leaf,
          .face = cause->face,
          .entering = value(0)};
}

bool CsgEvaluation::next(CsgHit& hit) {
  while (position_ < work_.crossings_.size() && work_.crossings_[position_].t < ray_.t_max) {
    const std::size_t begin = position_;
    const std::size_t end = cluster_end(begin);
    position_ = end;
    if (!flip(begin, end)) continue;
    hit = blame(begin, end);
    return true;
  }
  return false;
}

}  // namespace crt::core
