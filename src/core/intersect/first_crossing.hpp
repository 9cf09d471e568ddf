// First crossings with an object that is a single leaf are found here, side by side, where
// Shape::span() finds them. The results are those of Shape::crossings(), to the last bit.
#pragma once

#include <type_traits>

#include "core/geometry/shape_span.hpp"
#include "core/intersect/bounding_proxy.hpp"
#include "core/ray/coincidence_tolerance.hpp"
#include "core/ray/plain_ray.hpp"
#include "core/ray/ray_hit.hpp"

namespace crt::core {

/// A FirstCrossing is that of one ray, or of as many side by side as a Real has lanes.
template <class Real>
struct FirstCrossing {
  using Mask = MaskOf<Real>;

  Mask found{};    ///< there is one after the start; else what follows means nothing
  Mask unknown{};  ///< only the exact test can find it: nothing else here means anything
  Mask entering{};
  Real t{};
  Real error{};
  Real face{};                  ///< its number
  std::uint8_t leave_root = 0;  ///< as ShapeSpan has it
};

inline const FirstCrossing<double>& lane_of(const FirstCrossing<double>& first,
                                            std::size_t /*lane*/) {
  return first;
}
inline FirstCrossing<double> lane_of(const FirstCrossing<Lanes>& first, std::size_t lane) {
  return {.found = first.found[lane],
          .unknown = first.unknown[lane],
          .entering = first.entering[lane],
          .t = first.t[lane],
          .error = first.error[lane],
          .face = first.face[lane],
          .leave_root = first.leave_root};
}

/// An AfterStart says whether a crossing is after the start of a ray that does not start on its
/// surface.
template <class Mask>
struct AfterStart {
  Mask surely;
  Mask unknown;  ///< as is_at_start() has it
};

template <class Real>
auto after_start(const FilterLine<Real>& line, const Real& t, const Real& error) {
  using Mask = decltype(t > line.begin);
  const Real distance = t - line.begin - error;
  const Mask after = t > line.begin;
  const Mask clear =
      distance > start_tolerance(line.start_error) && t - line.begin > errors_at_start * error;
  return AfterStart<Mask>{.surely = after && clear, .unknown = after && !clear};
}

/// Finds where lines enter and leave a leaf of the standard tier, as Shape::span() does.
template <class Real>
void find_span(const Leaf& leaf, const FilterLine<Real>& line,
               const std::type_identity_t<WantedEnds<Real>>& wanted,
               const std::type_identity_t<FaceStarts<Real>>* starts, ShapeSpan<Real>& span) {
  const Placement& placement = *leaf.placement;
  if (placement.is_identity()) {
    leaf.shape->span(line, wanted, starts, span);
  } else if (leaf.shape->finds_spans(placement)) {
    leaf.shape->span(placement.to_object(plain_ray(line)), wanted, span);
  }
}

/// Finds first crossings of asked lines with a leaf. `part` is where they are in it, or null for a
/// leaf with quick spans.
template <class Real>
FirstCrossing<Real> first_crossing(const Leaf& leaf, const FilterLine<Real>& line,
                                   const MaskOf<Real>& asked, const FaceStarts<Real>* starts,
                                   const Enclosure<Real>* part) {
  FirstCrossing<Real> first{.unknown = asked};
  ShapeSpan<Real> span;
  if (part != nullptr) {
    const WantedEnds<Real> wanted{
        .enter = asked && part->enter_from > line.certain_from,
        .leave = asked && part->enter_to <= line.begin && part->leave_from > line.certain_from};
    if (!any(wanted.enter || wanted.leave)) return first;
    find_span(leaf, line, wanted, starts, span);
    first.entering = wanted.enter && span.enter.known;
    first.found = first.entering || (wanted.leave && span.leave.known);
    first.unknown = asked && !first.found && !(wanted.enter && span.misses);
  } else {
    find_span(leaf, line, {.enter = asked, .leave = asked, .only_first = true}, starts, span);
    const auto& [known_enter, enter, enter_error, enter_face] = span.enter;
    const auto& [known_leave, leave, leave_error, leave_face] = span.leave;
    const auto has_entered = known_enter && enter + enter_error <= line.begin;
    const auto has_left = known_leave && leave + leave_error < line.begin;
    first.entering = asked && known_enter && enter - enter_error > line.certain_from;
    first.found = first.entering ||
                  (asked && has_entered && known_leave && leave - leave_error > line.certain_from);
    first.unknown = asked && !first.found && !span.misses && !has_left;
  }
  first.t = select(first.entering, span.enter.t, span.leave.t);
  first.error = select(first.entering, span.enter.error, span.leave.error);
  first.face = select(first.entering, span.enter.face, span.leave.face);
  first.leave_root = span.leave_root;
  return first;
}

/// Returns whether a line is within a box at t.
template <class Real>
auto is_within(const Bounds& box, const PlainRay<Real>& line, const Real& t) {
  const Vec3Of<Real> place = line.at(t);
  const auto is_between = [](double lower, const Real& x, double upper) {
    return x >= lower && x <= upper;
  };
  return is_between(box.lower.x, place.x, box.upper.x) &&
         is_between(box.lower.y, place.y, box.upper.y) &&
         is_between(box.lower.z, place.z, box.upper.z);
}

/// Finds where rays that start into an isolated leaf leave it, which no transform moves. Nothing
/// else is in `margin`. Where it finds nothing the exact test must.
template <class Real>
FirstCrossing<Real> isolated_exit(const Leaf& leaf, const Bounds& margin,
                                  const PlainRay<Real>& line, const Real& begin, const Real& end) {
  SpanEnd<Real> other;
  leaf.shape->exit_from_surface(line, other);
  if (!any(other.known)) return {};
  const Real reach = other.t + coincidence_tolerance(line, other.t, other.error);
  const auto ahead = other.known && other.t > begin && other.t < end;
  const auto stays = is_within(margin, line, begin) && is_within(margin, line, min(reach, end));
  return {.found = ahead && stays,
          .t = other.t,
          .error = other.error,
          .face = other.face,
          .leave_root = 1};
}

/// Writes a hit as the exact test has it.
inline void write_first(const BoundingProxy& proxy, const FirstCrossing<double>& first,
                        RayHit& hit) {
  const auto face = static_cast<std::uint32_t>(first.face);
  hit = {.t = first.t,
         .error = first.error,
         .object = proxy.object,
         .leaf = proxy.leaf_index,
         .face = face,
         .surface = proxy.faces[face].surface,
         .root = first.entering ? std::uint8_t{0} : first.leave_root,
         .entering = first.entering};
}

}  // namespace crt::core
