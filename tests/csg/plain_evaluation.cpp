#include "csg/plain_evaluation.hpp"

#include <algorithm>
#include <tuple>

namespace crt::test {
namespace {

using core::CsgCrossing;
using core::CsgProgram;
using core::Leaf;

/// Values are those of all nodes and leaves. The leaves' values are those that the solid sees: true
/// where complemented ones are not.
struct Values {
  std::vector<bool> nodes;
  std::vector<bool> leaves;
};

class Plain {
 public:
  Plain(const core::CompiledScene& scene, const core::CsgObject& object, const core::WorldRay& ray)
      : scene_(scene),
        program_(object.program),
        first_leaf_(object.first_leaf),
        ray_(ray),
        inside_(program_.leaf_count(), false) {
    for (std::uint32_t leaf = 0; leaf < program_.leaf_count(); ++leaf) collect(leaf);
    std::sort(crossings_.begin(), crossings_.end(), [](const CsgCrossing& a, const CsgCrossing& b) {
      return std::tie(a.t, a.t_low, a.leaf, a.entering) <
             std::tie(b.t, b.t_low, b.leaf, b.entering);
    });
  }

  PlainEvaluation evaluate() {
    PlainEvaluation result;
    while (!crossings_.empty() && crossings_.front().t <= ray_.t_min) take_cluster();
    result.starts_inside = values().nodes[0];
    while (!crossings_.empty() && crossings_.front().t < ray_.t_max) {
      const Values before = values();
      const std::vector<CsgCrossing> cluster = take_cluster();
      const Values after = values();
      if (before.nodes[0] != after.nodes[0]) result.hits.push_back(hit(cluster, before, after));
    }
    return result;
  }

 private:
  const Leaf& leaf(std::uint32_t index) const { return scene_.leaves[first_leaf_ + index]; }

  void collect(std::uint32_t index) {
    const Leaf& leaf = this->leaf(index);
    if (leaf.bounds.empty()) return;
    const core::LineSpan span =
        core::RaySlabs(ray_.origin, ray_.direction, ray_.start.t_error).span(leaf.bounds);
    const double farthest =
        ray_.t_max + core::coincidence_tolerance(ray_, std::min(ray_.t_max, 0x1p900), 0);
    if (span.empty() || span.leave < ray_.t_min - ray_.start.t_error || span.enter > farthest)
      return;
    core::ObjectRay object_ray = leaf.placement->to_object(ray_.origin, ray_.direction);
    object_ray.start =
        core::start_on_leaf(leaf, first_leaf_ + index, scene_.face_surfaces, ray_.start);
    core::CrossingList found;
    std::uint64_t escalations = 0;
    inside_[index] = core::leaf_crossings(leaf, ray_, object_ray, found, escalations);
    for (const core::Crossing& crossing : found) {
      if (crossing.t + crossing.error < span.enter) {
        inside_[index] = crossing.entering;
        continue;
      }
      const core::FaceSurface& surface = scene_.face_surfaces[leaf.first_face + crossing.face];
      CsgCrossing met{.t = crossing.t,
                      .error = crossing.error,
                      .t_low = crossing.t_low,
                      .enter = span.enter,
                      .leaf = index,
                      .face = crossing.face,
                      .surface = surface.surface,
                      .root = crossing.root,
                      .entering = crossing.entering};
      if (met.t < met.enter) {
        met.t = met.enter;
        met.t_low = 0;
      }
      if (met.surface != ray_.start.surface && met.t > ray_.t_min &&
          met.enter <= core::tolerated_start(ray_) &&
          core::is_at_start(leaf, ray_, ray_.start.t_error, object_ray, crossing)) {
        met.t = ray_.t_min;
        met.t_low = 0;
      }
      crossings_.push_back(met);
    }
  }

  double reach(const CsgCrossing& crossing) const {
    return core::reach_of_place(leaf(crossing.leaf), ray_,
                                {.t = crossing.t,
                                 .error = crossing.error,
                                 .face = crossing.face,
                                 .root = crossing.root,
                                 .entering = crossing.entering});
  }

  /// Returns whether a crossing is at the place of the first and of all between.
  bool coincides_with_all(std::size_t number) const {
    const CsgCrossing& first = crossings_.front();
    const CsgCrossing& other = crossings_[number];
    const double tolerance = core::coincidence_tolerance(ray_, first.t, first.error);
    const double gap = core::gap_between(first, other);
    if (gap > std::max(tolerance, first.error + other.error)) return false;
    if (other.enter > first.t + tolerance) return false;
    double from = gap - reach(other);
    double to = gap + reach(other);
    for (std::size_t i = 0; i < number; ++i) {
      const CsgCrossing& member = crossings_[i];
      from = std::max(from, core::gap_between(first, member) - reach(member));
      to = std::min(to, core::gap_between(first, member) + reach(member));
      const double own_reach = core::reach_in_leaf(member.t, member.error, reach(member)) +
                               core::reach_in_leaf(other.t, other.error, reach(other));
      if (member.leaf == other.leaf && core::gap_between(member, other) > own_reach) return false;
    }
    return gap == 0 || from <= to;
  }

  /// Takes the first crossing and what coincides with it, and lets the leaves pass.
  std::vector<CsgCrossing> take_cluster() {
    std::size_t end = 1;
    while (end < crossings_.size() && coincides_with_all(end)) ++end;
    std::vector<CsgCrossing> cluster(crossings_.begin(),
                                     crossings_.begin() + static_cast<std::ptrdiff_t>(end));
    std::vector<CsgCrossing> rest;
    for (std::size_t i = end; i < crossings_.size(); ++i) {
      const bool same = std::any_of(
          cluster.begin(), cluster.begin() + static_cast<std::ptrdiff_t>(end),
          [&](const CsgCrossing& member) {
            return member.surface == crossings_[i].surface && member.root == crossings_[i].root;
          });
      (same ? cluster : rest).push_back(crossings_[i]);
    }
    crossings_ = rest;
    for (const CsgCrossing& crossing : cluster) inside_[crossing.leaf] = !inside_[crossing.leaf];
    return cluster;
  }

  Values values() const {
    Values result;
    std::vector<std::uint32_t> counts(program_.nodes.size(), 0);
    for (std::uint32_t i = 0; i < program_.leaf_count(); ++i) {
      result.leaves.push_back(inside_[i] != leaf(i).complemented);
      if (result.leaves.back()) ++counts[program_.leaf_parents[i]];
    }
    result.nodes.resize(program_.nodes.size());
    for (std::size_t node = program_.nodes.size(); node-- > 0;) {
      result.nodes[node] = counts[node] >= program_.nodes[node].needed;
      if (node > 0 && result.nodes[node]) ++counts[program_.nodes[node].parent];
    }
    return result;
  }

  core::CsgHit hit(const std::vector<CsgCrossing>& cluster, const Values& before,
                   const Values& after) const {
    const bool now = after.nodes[0];
    const CsgCrossing* cause = nullptr;
    const CsgCrossing* place = nullptr;  // the one known best
    for (const CsgCrossing& crossing : cluster) {
      if (crossing.entering != inside_[crossing.leaf] || after.leaves[crossing.leaf] != now)
        continue;
      bool changed = true;
      for (std::uint32_t node = program_.leaf_parents[crossing.leaf];;
           node = program_.nodes[node].parent) {
        changed = changed && before.nodes[node] != now && after.nodes[node] == now;
        if (node == 0) break;
      }
      if (!changed) continue;
      if (cause == nullptr || crossing.leaf < cause->leaf) cause = &crossing;
      if (place == nullptr ||
          std::tie(crossing.error, crossing.leaf) < std::tie(place->error, place->leaf)) {
        place = &crossing;
      }
    }
    if (cause == nullptr) cause = &cluster.front();
    if (place == nullptr || !(place->t < ray_.t_max)) place = &cluster.front();
    return {.t = place->t,
            .error = cause->error,
            .t_low = place->t_low,
            .leaf = cause->leaf,
            .face = cause->face,
            .surface = cause->surface,
            .root = cause->root,
            .entering = now};
  }

  const core::CompiledScene& scene_;
  const CsgProgram& program_;
  std::uint32_t first_leaf_;
  const core::WorldRay& ray_;
  std::vector<bool> inside_;
  std::vector<CsgCrossing> crossings_;
};

}  // namespace

PlainEvaluation evaluate_plainly(const core::CompiledScene& scene, const core::CsgObject& object,
                                 const core::WorldRay& ray) {
  return Plain(scene, object, ray).evaluate();
}

}  // namespace crt::test
