// The triangles that a line meets are found and put into order, for all that triangles enclose.
//
// Triangles are what a MeshTriangles has: is_closed(), is_oriented(), counts_windings(), bounds(),
// triangle(), and a tree of them that a line walks through (root(), visit(), leaf()). A leaf has
// triangles side by side. About each of them, and of faces that have crossings, is asked whether
// they lie in one plane, and on which side the solid is.
//
// Where windings count, each crossing changes the winding number of the line by 1, and those that
// do not take it to 0 or from there are dropped. What is left enters and leaves by turns, as what
// the parity rule leaves does.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/base/sort_by_insertion.hpp"
#include "core/geometry/exact_plane.hpp"
#include "core/geometry/mesh/facing.hpp"
#include "core/geometry/mesh/met_triangles.hpp"
#include "core/geometry/mesh/passing_line.hpp"
#include "core/geometry/open_nodes.hpp"
#include "core/geometry/order_of_places.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

/// MetTriangles makes one list of crossings.
template <class Triangles>
class MetTriangles {
 public:
  MetTriangles(const Triangles& mesh, PassingLine& line, const MeshTier& tier, CrossingList& list)
      : mesh_(mesh),
        line_(line),
        ray_(line.near()),
        tier_(tier),
        list_(list),
        max_overlap_(max_overlap()) {}

  bool append();
  /// Appends a crossing for each triangle, in order.
  void append_all() {
    begin_ = list_.size();
    find(false);
    sort();
  }

 private:
  using Place = CrossingList::iterator;
  using Child = typename Triangles::Child;
  using Leaf = typename Triangles::Leaf;
  using Item = typename Triangles::Item;

  /// A TreePart is still to be looked at.
  struct TreePart {
    double enter;  ///< where the line comes to it
    Child child;
  };

  Place first() const { return list_.begin() + static_cast<std::ptrdiff_t>(begin_); }
  /// Returns whether the ray starts in the plane of a triangle, or of a face.
  template <class TriangleOrFace>
  bool starts_on(const TriangleOrFace& triangle) const {
    return ray_.start.face != invalid_index && mesh_.are_in_one_plane(triangle, ray_.start.face);
  }
  void find(bool first_is_enough);
  Crossing meet(const Item& triangle, bool along) const;
  bool may_be_last(const Crossing& crossing, Facing facing) const;
  bool leave_out_rest();
  bool find_all();
  bool finish();
  void keep_in_triangle(const Triangle& triangle, const Triangle& in_plane,
                        Crossing& crossing) const;
  double start_slack() const;
  double max_overlap() const;
  double begin_of_line() const { return ray_.begin - start_slack(); }
  bool is_behind(const Crossing& crossing, const Leaf& leaf) const;
  /// Returns the size of all coordinates, which their roundings are relative to.
  double place_size() const { return largest_component(ray_.origin) + mesh_.bounds().farthest(); }
  int order(const Crossing& a, const Crossing& b) const;
  void sort();
  void drop_empty_parts();
  bool agree_with_start();
  bool is_through_origin(const Crossing& crossing) const;
  /// Returns whether a place with this winding number is inside. Its parity is that of crossings.
  bool is_inside(int winding) const {
    return mesh_.counts_windings() ? winding != 0 : winding % 2 != 0;
  }
  int winding_at_begin() const;
  bool is_inside_ahead() const;
  Place nearest_through_origin();
  void move_past_origin(Place met);
  void close_gaps();
  bool is_inside_at_begin() const { return ((list_.size() - begin_) % 2 != 0) != rest_is_odd_; }
  Place put_behind(Place met) const;
  void take_turns();

  const Triangles& mesh_;
  PassingLine& line_;
  const ObjectRay& ray_;
  const MeshTier& tier_;
  CrossingList& list_;
  double max_overlap_;
  std::size_t begin_ = 0;
  double found_up_to_ = infinity;       ///< there may be more crossings beyond, where the last ends
  std::uint32_t last_ = invalid_index;  ///< its triangle
  Facing last_facing_ = Facing::unknown;
  /// Says that crossings are left out at the end, and whether they are odd in number: whether the
  /// line is inside after the last that is not.
  bool has_rest_ = false;
  bool rest_is_odd_ = false;
  int rest_winding_ = 0;  ///< the winding number there, if windings count
};

template <class Triangles>
bool MetTriangles<Triangles>::append() {
  begin_ = list_.size();
  const bool first_is_enough = ray_.first_wanted_after < infinity;
  find(first_is_enough);
  if (!mesh_.is_closed()) {
    sort();
    return false;
  }
  if (found_up_to_ < infinity && !leave_out_rest()) return find_all();
  return finish();
}

/// Makes the list of a solid what it is to be. Returns whether the line is inside at its begin.
template <class Triangles>
bool MetTriangles<Triangles>::finish() {
  sort();
  if (ray_.start.face != invalid_index && !agree_with_start()) return find_all();
  drop_empty_parts();
  if (mesh_.counts_windings()) close_gaps();
  take_turns();
  return is_inside_at_begin();
}

/// Begins again without an end.
template <class Triangles>
bool MetTriangles<Triangles>::find_all() {
  list_.resize(begin_);
  found_up_to_ = infinity;
  has_rest_ = rest_is_odd_ = false;
  rest_winding_ = 0;
  find(false);
  return finish();
}

/// Returns how far before its begin a ray that starts on a triangle may meet others that rounding
/// has put there.
template <class Triangles>
double MetTriangles<Triangles>::start_slack() const {
  if (ray_.start.face == invalid_index) return 0;
  constexpr double share = 0x1p-30;
  return share * place_size() / largest_component(ray_.direction);
}

/// Returns how far before or behind its triangle a crossing may reach: keep_in_triangle() finds
/// those exactly that rounding has put farther away.
template <class Triangles>
double MetTriangles<Triangles>::max_overlap() const {
  constexpr double share = 0x1p-32;
  return share * place_size() / largest_component(ray_.direction);
}

/// Finds the crossings, from near to far. If the first that is asked for is enough, it stops behind
/// one after which nothing matters, provided that this is alone.
template <class Triangles>
void MetTriangles<Triangles>::find(bool first_is_enough) {
  const typename Triangles::Slabs slabs(ray_.origin, ray_.direction, line_.origin_error());
  LineSpan part{slabs.to_s(begin_of_line()), infinity};
  const double margin = mesh_.is_closed() ? 2 * max_overlap_ : 0;
  constexpr std::size_t usual = 256;
  OpenNodes<TreePart, usual> open;
  open.push({-infinity, mesh_.root()});
  while (!open.empty()) {
    const auto [enter, child] = open.pop();
    if (enter > part.leave) continue;
    if (!child.is_leaf()) {
      const std::size_t before = open.count();
      mesh_.visit(child, slabs, part, [&](Child next, double place) { open.push({place, next}); });
      // The nearest comes last. This order saves time, and nothing else.
      sort_by_insertion(open.from(before),
                        [](const TreePart& a, const TreePart& b) { return a.enter > b.enter; });
      continue;
    }
    const Leaf& leaf = mesh_.leaf(child);
    const std::uint32_t all = (1u << leaf.count()) - 1;
    const PassingLine::Crossed crossed = line_.crosses(leaf.corners(), all);
    for (std::uint32_t left = crossed.along | crossed.against; left != 0; left &= left - 1) {
      const auto place = static_cast<std::uint32_t>(std::countr_zero(left));
      const Item& triangle = leaf.item(place);
      const Crossing crossing = meet(triangle, (crossed.along >> place & 1u) != 0);
      if (is_behind(crossing, leaf)) continue;
      list_.push_back(crossing);
      const Facing facing = mesh_.facing_of(triangle);
      if (!first_is_enough || !may_be_last(crossing, facing)) continue;
      if (!(highest(crossing) < found_up_to_)) continue;
      found_up_to_ = highest(crossing);
      part.leave = slabs.to_s(found_up_to_ + margin);
      last_ = triangle.number;
      last_facing_ = facing;
    }
  }
}

/// Returns whether a leaf of the tree is all before the begin, so that only rounding may have put a
/// crossing in it elsewhere.
template <class Triangles>
bool MetTriangles<Triangles>::is_behind(const Crossing& crossing, const Leaf& leaf) const {
  const double begin = begin_of_line();
  if (!(lowest(crossing) <= begin)) return false;
  Bounds box;
  for (std::uint32_t i = 0; i < leaf.count(); ++i) {
    const auto [a, b, c, material] = mesh_.corners_of(leaf.item(i));
    for (const Vec3& corner : {a, b, c}) box.include(corner);
  }
  return RaySlabs(ray_.origin, ray_.direction, line_.origin_error()).span(box).leave < begin;
}

/// Returns whether nothing matters after a crossing, if it is alone: it is known whether the line
/// is inside there.
template <class Triangles>
bool MetTriangles<Triangles>::may_be_last(const Crossing& crossing, Facing facing) const {
  if (!ray_.is_first_wanted(crossing) || !(highest(crossing) < infinity)) return false;
  if (!mesh_.is_closed()) return true;
  return (facing == Facing::outwards || facing == Facing::inwards) &&
         (ray_.start.face == invalid_index || lowest(crossing) > 0);
}

/// Leaves out what is beyond the last crossing that matters. Returns false if that is not alone.
template <class Triangles>
bool MetTriangles<Triangles>::leave_out_rest() {
  const auto last = std::find_if(
      first(), list_.end(), [this](const Crossing& crossing) { return crossing.face == last_; });
  if (!is_alone(*last, std::span(first(), list_.end()))) return false;
  has_rest_ = last->has_rest = true;
  rest_is_odd_ = last->entering == (last_facing_ == Facing::outwards);
  if (rest_is_odd_) rest_winding_ = last_facing_ == Facing::outwards ? 1 : -1;
  list_.erase(
      std::remove_if(first(), list_.end(),
                     [this](const Crossing& other) { return lowest(other) > found_up_to_; }),
      list_.end());
  return true;
}

template <class Triangles>
Crossing MetTriangles<Triangles>::meet(const Item& triangle, bool along) const {
  Crossing crossing{.face = triangle.number, .entering = !along};
  if (starts_on(triangle)) return crossing;
  const Triangle corners = mesh_.corners_of(triangle);
  const Triangle in_plane = mesh_.corners_of_plane(triangle, corners);
  if (tier_.meet(in_plane, crossing)) {
    keep_in_triangle(corners, in_plane, crossing);
  } else {
    const double ahead = glm::dot(corners.a - ray_.origin, ray_.direction);
    crossing.t = std::copysign(infinity, ahead);
  }
  return crossing;
}

/// A line that all but grazes a triangle still meets it between its corners, and nowhere else.
/// Where rounding has put it elsewhere, or does not tell, it is found without rounding: by the
/// triangle that says for all of its plane where that is.
template <class Triangles>
void MetTriangles<Triangles>::keep_in_triangle(const Triangle& triangle, const Triangle& in_plane,
                                               Crossing& crossing) const {
  const double scale = inverse_of_power(power_of_two_below(largest_component(ray_.direction)));
  const Vec3 direction = scale * ray_.direction;
  const double squared_length = glm::dot(direction, direction);
  double low = infinity;
  double high = -infinity;
  double reach = 0;
  for (const Vec3* corner : {&triangle.a, &triangle.b, &triangle.c}) {
    const Vec3 offset = *corner - ray_.origin;
    const double t = glm::dot(offset, direction) / squared_length * scale;
    low = std::min(low, t);
    high = std::max(high, t);
    reach = std::max(reach, largest_component(offset));
  }
  constexpr double roundings = 16;
  reach += largest_component(ray_.origin);
  const double slack = roundings * unit_roundoff * reach * scale;
  const bool is_there = crossing.t >= low - slack && crossing.t <= high + slack;
  if (is_there && !(crossing.error > std::min(high - low + slack, max_overlap_))) return;
  const ExactPlane plane = ExactPlane::through(in_plane.a, in_plane.b, in_plane.c);
  const ExactPlane::Fraction t = plane.meet_exactly(line_.exact());
  if (t.side == 0) return;
  tier_.place((t.numerator.rounded() / t.denominator.rounded()).unscaled(), crossing);
}

template <class Triangles>
int MetTriangles<Triangles>::order(const Crossing& a, const Crossing& b) const {
  return order_of_places(
      a, b, [this](std::uint32_t face) { return starts_on(face); },
      [this](const Crossing& one, const Crossing& other) { return tier_.order(one, other); });
}

template <class Triangles>
void MetTriangles<Triangles>::sort() {
  std::sort(first(), list_.end(), [this](const Crossing& a, const Crossing& b) {
    const int by_place = order(a, b);
    return by_place != 0 ? by_place < 0 : a.face < b.face;
  });
}

/// Drops what the line is in or out of for no length, and where windings count what leads from one
/// inner part to another. Of several crossings in one place one is left if they are odd in number,
/// or lead in or out: it is against their normals, or along these, as most are.
template <class Triangles>
void MetTriangles<Triangles>::drop_empty_parts() {
  const bool counts = mesh_.counts_windings();
  int winding = counts ? winding_at_begin() : 0;
  auto kept = first();
  for (auto group = first(); group != list_.end();) {
    auto end = group;
    std::ptrdiff_t entering = 0;
    bool is_start = false;
    for (; end != list_.end() && order(*group, *end) == 0; ++end) {
      entering += end->entering ? 1 : -1;
      is_start = is_start || starts_on(end->face);
    }
    const bool was_inside = is_inside(winding);
    winding += static_cast<int>(entering);
    if (is_inside(winding) != was_inside || is_start) {
      const auto chosen = std::find_if(group, end, [&](const Crossing& crossing) {
        return is_start ? starts_on(crossing.face) : crossing.entering == (entering > 0);
      });
      *kept = *chosen;
      if (counts) kept->entering = is_inside(winding);
      ++kept;
    }
    group = end;
  }
  list_.erase(kept, list_.end());
}

/// Returns whether the origin is in a triangle's plane but for what rounding may have moved it by.
template <class Triangles>
bool MetTriangles<Triangles>::is_through_origin(const Crossing& crossing) const {
  const Triangle corners = mesh_.triangle(crossing.face);
  const Vec3 normal = unit_vector(glm::cross(corners.b - corners.a, corners.c - corners.a));
  constexpr double roundings = 64;
  const double tolerance = roundings * unit_roundoff * place_size();
  return std::abs(glm::dot(normal, corners.a - ray_.origin)) <= tolerance;
}

/// Makes the list agree with the side to which the ray leaves. Next to an edge rounding may have
/// put its origin beyond another triangle of that edge, which it then meets too often or too
/// rarely. From an edge itself it may leave past all triangles, without being inside: then it does
/// not meet its own either. Returns false where that may take what was left out.
template <class Triangles>
bool MetTriangles<Triangles>::agree_with_start() {
  const FaceStart& start = ray_.start;
  const auto is_start = [&](const Crossing& crossing) { return starts_on(crossing.face); };
  auto found = std::find_if(first(), list_.end(), is_start);
  if (found == list_.end()) {
    if (!start.on_face) return true;
    found = std::find_if(first(), list_.end(), [](const Crossing& met) { return met.t >= 0; });
    found =
        list_.insert(found, {.t = 0, .face = start.face, .entering = start.side == Side::inside});
  }
  const bool is_turned = mesh_.are_opposite(found->face, start.face);
  const bool goes_inside = (start.side == Side::inside) != is_turned;
  // One crossing is enough, but for windings.
  for (std::size_t left = mesh_.counts_windings() ? 2 * list_.size() : 1;
       left > 0 && is_inside_ahead() != goes_inside; --left) {
    if (has_rest_) return false;
    const auto nearest = nearest_through_origin();
    if (nearest == list_.end()) {
      list_.erase(std::remove_if(first(), list_.end(), is_start), list_.end());
      return true;
    }
    move_past_origin(nearest);
  }
  return true;
}

/// Takes a crossing ahead away, and puts one behind the origin ahead of it.
template <class Triangles>
void MetTriangles<Triangles>::move_past_origin(Place met) {
  Crossing moved = *met;
  const bool was_ahead = moved.t > 0;
  list_.erase(met);
  if (was_ahead) return;
  const Vec3 size = mesh_.bounds().upper - mesh_.bounds().lower;
  moved.t = unit_roundoff * largest_component(size) / largest_component(ray_.direction);
  moved.t_low = 0;
  moved.error = moved.t;
  const auto after =
      std::find_if(first(), list_.end(), [&](const Crossing& other) { return other.t > moved.t; });
  list_.insert(after, moved);
}

/// Returns the crossing that rounding may have put behind another one, whose turn it is not. There
/// is none where triangles plainly come in this order, as they pass through one another, and where
/// normals say nothing.
template <class Triangles>
typename MetTriangles<Triangles>::Place MetTriangles<Triangles>::put_behind(Place met) const {
  if (!tier_.may_be_out_of_order()) return list_.end();
  if (!mesh_.is_oriented() || starts_on(met->face)) return list_.end();
  for (auto later = met + 1; later != list_.end(); ++later) {
    if (later->t - later->error > met->t + met->error) break;
    if (later->entering != met->entering) return starts_on(later->face) ? list_.end() : later;
  }
  return list_.end();
}

/// Makes the line enter and leave by turns. Where triangles nearly coincide, rounding may have put
/// the end of a part before its begin. Such a part is left out.
template <class Triangles>
void MetTriangles<Triangles>::take_turns() {
  bool inside = is_inside_at_begin();
  for (auto met = first(); met != list_.end();) {
    if (met->entering == inside) {
      const auto later = put_behind(met);
      if (later != list_.end()) {
        list_.erase(later);
        met = list_.erase(met);
        continue;
      }
      met->entering = !inside;
    }
    inside = !inside;
    ++met;
  }
}

/// Appends the crossings of a line with what triangles enclose, as Shape::crossings does.
template <class Triangles>
bool append_met_triangles(const Triangles& triangles, PassingLine& line, const MeshTier& tier,
                          CrossingList& out) {
  return MetTriangles<Triangles>(triangles, line, tier, out).append();
}

}  // namespace crt::core

#include "core/geometry/mesh/met_windings.hpp"
