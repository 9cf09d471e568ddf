#include "core/csg/evaluate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace crt::core {

namespace {

/// A line has at most this many crossings with one surface, as with a torus.
constexpr std::size_t max_roots = 4;

/// The tolerance of what coincides has a finite value up to here.
constexpr double finite_t = 0x1p900;

/// This orders a heap that has the nearest on top.
constexpr auto is_opened_later = [](const auto& a, const auto& b) {
  return a.enter != b.enter ? a.enter > b.enter : b.child < a.child;
};

}  // namespace

CsgEvaluation::CsgEvaluation(const CsgObject& object, const WorldRay& ray, CsgWorkspace& workspace,
                             bool first_is_enough, const InstanceFrame* frame)
    : program_(object.program),
      leaves_(object.leaves),
      first_leaf_(object.first_leaf),
      face_surfaces_(object.faces),
      ray_(ray),
      work_(workspace),
      frame_(frame),
      slabs_(frame != nullptr ? frame->slabs(ray)
                              : RaySlabs(ray.origin, ray.direction, ray.start.t_error)),
      part_{ray.t_min - ray.start.t_error,
            ray.t_max + coincidence_tolerance(ray, std::min(ray.t_max, finite_t), 0)},
      first_stamp_(++workspace.stamp_),
      exact_(leaves_[0].exact != nullptr),
      first_is_enough_(first_is_enough) {
  const CsgProgram& program = object.program;
  if (!program.paths.empty()) {
    paths_.emplace(program.paths, work_.paths_, first_stamp_);
  } else if (work_.nodes_.size() < program.nodes.size()) {
    work_.nodes_.resize(program.nodes.size());
  }
  if (work_.leaves_.size() < program.leaf_count()) work_.leaves_.resize(program.leaf_count());
  if (work_.shared_.size() < max_roots * program.shared_surfaces) {
    work_.shared_.resize(max_roots * program.shared_surfaces);
  }
  work_.openings_.clear();
  work_.to_open_.clear();  // holds something where the ray before was stopped
  work_.met_.clear();
  work_.pieces_.clear();
  work_.to_come_.clear();
  work_.places_ = 0;
  for (const std::uint32_t leaf : program.tree.unbounded()) {
    tick();
    const LineSpan span = slabs_.span(leaves_[leaf].bounds);
    if (!span.empty() && span.leave >= part_.enter && span.enter <= part_.leave) {
      put_off(Bvh::Child::leaf(leaf), span.enter);
    }
  }
  if (program.tree.has_root())
    put_off(Bvh::Child::node(0), -std::numeric_limits<double>::infinity());
  open_up_to(tolerated_start(ray_));
  const auto is_before_start = [&] {
    return !work_.to_come_.empty() && work_.to_come_.front().t <= ray_.t_min;
  };
  while (is_before_start()) {
    open_what_may_coincide();
    if (!is_before_start()) break;
    gather_cluster();
    flip_cluster();
  }
  starts_inside_ = root_value();
}

std::uint32_t CsgEvaluation::first_leaf_inside() const {
  auto first = static_cast<std::uint32_t>(leaves_.size() - 1);
  const auto look_at = [&](std::uint32_t leaf) {
    if (leaf < first && leaf_inside(leaf) && !leaves_[leaf].complemented) first = leaf;
  };
  // The others are left somewhere, and so are among those that were met.
  for (const std::uint32_t leaf : program_.tree.unbounded()) look_at(leaf);
  for (const CsgCrossing& crossing : work_.met_) look_at(crossing.leaf);
  return first;
}

void CsgEvaluation::put_off(Bvh::Child child, double enter) {
  work_.openings_.push_back({enter, child});
  std::push_heap(work_.openings_.begin(), work_.openings_.end(), is_opened_later);
}

void CsgEvaluation::open_up_to(double t) {
  auto& openings = work_.openings_;
  while (!openings.empty() && openings.front().enter <= t) {
    const auto opening = openings.front();
    std::pop_heap(openings.begin(), openings.end(), is_opened_later);
    openings.pop_back();
    if (opening.child.is_leaf()) {
      open_leaf(opening.child.index(), opening.enter);
    } else {
      open_node(opening.child.index(), t);
    }
  }
}

void CsgEvaluation::open_node(std::uint32_t node, double t) {
  auto& nodes = work_.to_open_;
  nodes.push_back(node);
  do {
    const std::uint32_t next = nodes.back();
    nodes.pop_back();
    program_.tree.visit(next, slabs_, part_, [&](Bvh::Child child, double enter) {
      if (enter > t) {
        put_off(child, enter);
      } else if (child.is_leaf()) {
        open_leaf(child.index(), enter);
      } else {
        nodes.push_back(child.index());
      }
    });
  } while (!nodes.empty());
}

bool CsgEvaluation::is_later(const CsgWorkspace::ToCome& a, const CsgWorkspace::ToCome& b) const {
  if (a.t != b.t) return a.t > b.t;
  const CsgCrossing& one = work_.met_[a.index];
  const CsgCrossing& other = work_.met_[b.index];
  return std::tie(one.t_low, one.leaf, one.entering) >
         std::tie(other.t_low, other.leaf, other.entering);
}

bool CsgEvaluation::find_crossing() {
  while (work_.to_come_.empty()) {
    if (work_.openings_.empty()) return false;
    open_up_to(work_.openings_.front().enter);
  }
  open_what_may_coincide();
  return true;
}

void CsgEvaluation::open_what_may_coincide() {
  if (exact_) order_near_crossings();
  // What is opened may bring a crossing that is nearer still.
  while (!work_.openings_.empty()) {
    const CsgCrossing& first = next_crossing();
    const double next_enter = work_.openings_.front().enter;
    if (next_enter <= first.t + tolerance(first)) {
      open_up_to(next_enter);
    } else if (work_.pieces_.empty() || !open_pieces_between()) {
      return;
    }
  }
}

void CsgEvaluation::open_leaf(std::uint32_t index, double enter) {
  work_.steps.step();
  const Leaf& leaf = leaves_[index];
  const PlacedLeaf in_place = placed(leaf);
  // Leaves that are placed alike often follow one another, so the ray is taken to their space once.
  if (leaf.placement != placement_) {
    placement_ = leaf.placement;
    object_ray_ = in_place.placement.to_object(ray_.origin, ray_.direction);
  }
  object_ray_.start = start_on_leaf(leaf, first_leaf_ + index, face_surfaces_, ray_.start);
  // In the exact tier crossings that are near to each other are all opened, to be put in order.
  bool inside = first_is_enough_ && leaf.has_many_faces() && !exact_
                    ? gather_piece(index, in_place, enter)
                    : gather_crossings(in_place);
  work_.events += work_.leaf_crossings_.size();
  for (const Crossing& crossing : work_.leaf_crossings_) {
    const FaceSurface surface = leaf.surface_of(crossing.face, face_surfaces_);
    const bool before_box = crossing.t < enter;
    // Before the box nothing of the leaf matters, but the crossing may be in the box for all that
    // is known. (In the exact tier its error is less than what boxes are larger by.)
    if (before_box && (exact_ || crossing.t + crossing.error < enter)) {
      inside = crossing.entering;
      continue;
    }
    const auto place = static_cast<std::uint32_t>(work_.met_.size());
    CsgCrossing& met = work_.met_.emplace_back();
    met.t = before_box ? enter : crossing.t;
    met.error = crossing.error;
    met.t_low = before_box ? 0 : crossing.t_low;
    met.enter = enter;
    met.leaf = index;
    met.face = crossing.face;
    met.surface = surface.surface;
    met.root = crossing.root;
    met.entering = crossing.entering;
    // Only fields have more roots. Leaves that share one cross it at the same t, to the bit.
    met.shared = crossing.root < max_roots ? surface.shared : FaceSurface::not_shared;
    if (met.surface != ray_.start.surface && met.t > ray_.t_min && enter <= tolerated_start(ray_) &&
        is_at_start(in_place, ray_, ray_.start.t_error, object_ray_, crossing)) {
      met.t = ray_.t_min;
      met.t_low = 0;
      met.moved = true;
    }
    if (met.shared != FaceSurface::not_shared) ++shared_state(met).to_come;
    work_.to_come_.push_back({met.t, place});
    std::push_heap(work_.to_come_.begin(), work_.to_come_.end(), later());
  }
  if (!inside) return;
  ++work_.stamp_;
  flip_leaf(index);
}

bool CsgEvaluation::gather_crossings(const PlacedLeaf& leaf) {
  work_.leaf_crossings_.clear();
  return leaf_crossings(leaf, ray_, object_ray_, work_.leaf_crossings_, work_.escalations);
}

bool CsgEvaluation::gather_piece(std::uint32_t index, const PlacedLeaf& leaf, double& enter) {
  auto& pieces = work_.pieces_;
  auto& crossings = work_.leaf_crossings_;
  auto piece = std::find_if(pieces.begin(), pieces.end(),
                            [&](const auto& other) { return other.leaf == index; });
  const bool is_first = piece == pieces.end();
  if (is_first) {
    object_ray_.first_wanted_after = std::max(surely_after(tolerated_start(ray_)), enter);
    pieces.push_back({.leaf = index, .enter = enter});
    piece = pieces.end() - 1;
  } else {
    const bool is_over = enter != piece->beyond;  // as it has been opened before its turn
    crossings.clear();
    if (is_over) return false;
    enter = piece->enter;
    object_ray_.start = {};
    object_ray_.begin = object_ray_.first_wanted_after = piece->after;
  }
  bool inside = gather_crossings(leaf);
  object_ray_.begin = -infinity;
  object_ray_.first_wanted_after = infinity;
  if (!is_first) {
    // Those that have come already are there again.
    std::erase_if(crossings, [&](const Crossing& crossing) { return crossing.t <= piece->after; });
    inside = false;
  }
  piece->beyond = infinity;
  if (crossings.empty() || !crossings.back().has_rest) return inside;
  const Crossing& last = crossings.back();
  piece->after = last.t;
  piece->beyond = last.t + (last.error + 2 * rounding_of(last.t));
  if (piece->beyond <= part_.leave) put_off(Bvh::Child::leaf(index), piece->beyond);
  return inside;
}

bool CsgEvaluation::open_pieces_between() {
  const CsgCrossing& first = next_crossing();
  double last = -infinity;
  for (const CsgWorkspace::ToCome& waiting : work_.to_come_) {
    const CsgCrossing& crossing = work_.met_[waiting.index];
    if (&crossing != &first && is_near(first, crossing)) last = std::max(last, crossing.t);
  }
  const auto piece = std::find_if(work_.pieces_.begin(), work_.pieces_.end(),
                                  [&](const auto& other) { return other.beyond <= last; });
  if (piece == work_.pieces_.end()) return false;
  open_leaf(piece->leaf, piece->beyond);
  return true;
}

void CsgEvaluation::gather_cluster() {
  auto& to_come = work_.to_come_;
  auto& cluster = work_.cluster_;
  cluster.clear();
  ++work_.stamp_;
  CsgCrossing& first = next_crossing();
  std::optional<CommonPlace> place;
  const auto has_next = [&] {
    if (to_come.empty() || !is_near(first, next_crossing())) return false;
    if (!place) place.emplace(reach(first));
    return coincides(first, next_crossing(), *place);
  };
  do {
    add_to_cluster(next_crossing());
    std::pop_heap(to_come.begin(), to_come.end(), later());
    to_come.pop_back();
  } while (has_next());
  const bool some_to_come =
      std::any_of(cluster.begin(), cluster.end(), [&](const CsgCrossing* crossing) {
        return crossing->shared != FaceSurface::not_shared && shared_state(*crossing).to_come > 0;
      });
  if (some_to_come) gather_shared();
}

void CsgEvaluation::add_to_cluster(const CsgCrossing& crossing) {
  work_.cluster_.push_back(&crossing);
  if (crossing.shared == FaceSurface::not_shared) return;
  SharedState& shared = shared_state(crossing);
  --shared.to_come;
  shared.cluster = work_.stamp_;
}

void CsgEvaluation::gather_shared() {
  auto& to_come = work_.to_come_;
  work_.steps.poll();
  const auto others = std::partition(to_come.begin(), to_come.end(), [&](const auto& waiting) {
    const CsgCrossing& crossing = work_.met_[waiting.index];
    return crossing.shared == FaceSurface::not_shared ||
           shared_state(crossing).cluster != work_.stamp_;
  });
  for (auto other = others; other != to_come.end(); ++other)
    add_to_cluster(work_.met_[other->index]);
  to_come.erase(others, to_come.end());
  std::make_heap(to_come.begin(), to_come.end(), later());
}

CsgEvaluation::SharedState& CsgEvaluation::shared_state(const CsgCrossing& crossing) {
  const std::size_t index = max_roots * crossing.shared + crossing.root;
  SharedState& state = work_.shared_[index];
  if (state.stamp < first_stamp_) state = {.stamp = first_stamp_};
  return state;
}

CsgEvaluation::NodeState& CsgEvaluation::state(std::uint32_t node) {
  NodeState& state = work_.nodes_[node];
  if (state.stamp < first_stamp_) state = {program_.nodes[node].count_outside, first_stamp_, false};
  return state;
}

bool CsgEvaluation::value(std::uint32_t node) {
  return state(node).count >= program_.nodes[node].needed;
}

bool CsgEvaluation::leaf_inside(std::uint32_t leaf) const {
  return work_.leaves_[leaf].stamp >= first_stamp_ && work_.leaves_[leaf].inside;
}

bool CsgEvaluation::flip_cluster() {
  const bool before = root_value();
  if (paths_) paths_->begin_cluster();
  for (const CsgCrossing* crossing : work_.cluster_) {
    tick();
    flip_leaf(crossing->leaf);
  }
  return root_value() != before;
}

void CsgEvaluation::flip_leaf(std::uint32_t leaf) {
  const bool inside = !leaf_inside(leaf);
  work_.leaves_[leaf] = {work_.stamp_, inside};
  bool now = inside != leaves_[leaf].complemented;
  std::uint32_t node = program_.leaf_parents[leaf];
  if (paths_) {
    paths_->set_leaf(node, now);
    return;
  }
  while (true) {
    NodeState& touched = state(node);
    const bool before = touched.count >= program_.nodes[node].needed;
    if (touched.stamp != work_.stamp_) {
      touched.stamp = work_.stamp_;
      touched.value_before = before;
    }
    touched.count += now ? 1u : ~0u;
    const bool after = touched.count >= program_.nodes[node].needed;
    if (after == before || node == 0) return;
    now = after;
    node = program_.nodes[node].parent;
  }
}

bool CsgEvaluation::is_changed_up_to_root(std::uint32_t leaf, bool now) {
  std::uint32_t node = program_.leaf_parents[leaf];
  while (true) {
    const NodeState& touched = state(node);
    if (touched.stamp != work_.stamp_ || touched.value_before == now || value(node) != now)
      return false;
    if (node == 0) return true;
    node = program_.nodes[node].parent;
  }
}

void CsgEvaluation::find_causes() {
  const bool now = root_value();
  auto& causes = work_.causes_;
  causes.clear();
  std::uint64_t looked_at = 0;
  for (const CsgCrossing* crossing : work_.cluster_) {
    if (++looked_at % steps_per_look == 0) work_.steps.poll();
    // The crossing must be the one that gave the leaf its value, not one undone in the same
    // cluster.
    const std::uint32_t leaf = crossing->leaf;
    const bool inside = leaf_inside(leaf);
    if (crossing->entering != inside || (inside != leaves_[leaf].complemented) != now) continue;
    const bool has_changed = paths_ ? paths_->is_all(program_.leaf_parents[leaf], now)
                                    : is_changed_up_to_root(leaf, now);
    if (has_changed) causes.push_back(crossing);
  }
  if (!paths_) return;
  paths_->toggle_cluster();
  std::erase_if(causes, [&](const CsgCrossing* crossing) {
    return !paths_->is_all(program_.leaf_parents[crossing->leaf], !now);
  });
  paths_->toggle_cluster();
}

CsgHit CsgEvaluation::blame() {
  const CsgCrossing* first = work_.cluster_.front();
  const CsgCrossing* cause = nullptr;
  // The place is that of the crossing that changed the root and is known best. Others may be known
  // far worse, where the ray grazes them.
  const CsgCrossing* place = nullptr;
  find_causes();
  for (const CsgCrossing* crossing : work_.causes_) {
    if (cause == nullptr || crossing->leaf < cause->leaf) cause = crossing;
    if (place == nullptr ||
        std::tie(crossing->error, crossing->leaf) < std::tie(place->error, place->leaf)) {
      place = crossing;
    }
  }
  if (cause == nullptr) cause = first;
  if (place == nullptr || !(place->t < ray_.t_max)) place = first;
  return {.t = place->t,
          .error = cause->error,
          .t_low = place->t_low,
          .leaf = cause->leaf,
          .face = cause->face,
          .surface = cause->surface,
          .root = cause->root,
          .entering = root_value()};
}

bool CsgEvaluation::next(CsgHit& hit) {
  while (find_crossing() && work_.to_come_.front().t < ray_.t_max) {
    gather_cluster();
    if (!flip_cluster()) continue;
    hit = blame();
    return true;
  }
  return false;
}

}  // namespace crt::core
