// First crossings are found here of objects whose bounding proxy suffices. In the standard tier
// these are boxes, and planes across a coordinate axis, without a transform. Spheres, tori,
// cylinders and cones may have one. The results are those of their shapes, to the last bit.
#pragma once

#include <array>

#include "core/geometry/plane_face.hpp"
#include "core/geometry/sphere/sphere.hpp"
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
  Real face{};  ///< its number
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
          .face = first.face[lane]};
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
      distance > flattest_start * line.start_error && t - line.begin > errors_at_start * error;
  return AfterStart<Mask>{.surely = after && clear, .unknown = after && !clear};
}

/// Returns the chord in a sphere that is not moved.
template <class Real>
SphereChord<Real> chord_of_sphere(const BoundingProxy& sphere, const FilterLine<Real>& line) {
  const double unit = power_of_two_below(sphere.radius);
  return SphereChord<Real>::of(plain_ray(line), sphere.place, sphere.radius, unit);
}

template <class Real>
SphereChord<Real> chord_of_moved_sphere(const ProxyAxis& sphere, const FilterLine<Real>& line);

/// Finds where lines that do not start on a sphere, moved or not, enter and leave it.
template <class Real>
std::array<FirstCrossing<Real>, 2> crossings_of_sphere(const BoundingProxy& sphere,
                                                       const BoundingProxies& proxies,
                                                       const FilterLine<Real>& line) {
  const auto chord = sphere.kind == BoundingProxy::Kind::sphere
                         ? chord_of_sphere(sphere, line)
                         : chord_of_moved_sphere(proxies.axis(sphere), line);
  if (!any(chord.found)) return {};
  const auto of_end = [&](const Real& t, const MaskOf<Real>& entering) {
    const Real error = chord.error_of(t);
    const auto start = after_start(line, t, error);
    return FirstCrossing<Real>{.found = chord.found && start.surely,
                               .unknown = chord.found && start.unknown,
                               .entering = entering,
                               .t = t,
                               .error = error};
  };
  return {of_end(chord.enter, lanes_of_mask<Real>(~std::uint32_t{0})),
          of_end(chord.leave, MaskOf<Real>{})};
}

template <class Real>
FirstCrossing<Real> first_crossing_of_sphere(const BoundingProxy& sphere,
                                             const BoundingProxies& proxies,
                                             const FilterLine<Real>& line) {
  const auto [enter, leave] = crossings_of_sphere(sphere, proxies, line);
  return {.found = enter.found || leave.found,
          .unknown = enter.unknown || leave.unknown,
          .entering = enter.found,
          .t = select(enter.found, enter.t, leave.t),
          .error = select(enter.found, enter.error, leave.error)};
}

template <class Real>
FirstCrossing<Real> first_crossing_of_plane(const BoundingProxy& plane, const ProxyAxis& of_plane,
                                            const FilterLine<Real>& line) {
  // One component of the normal alone is not 0.
  const int axis = of_plane.normal.x != 0 ? 0 : of_plane.normal.y != 0 ? 1 : 2;
  const auto i = static_cast<std::size_t>(axis);
  const Real& speed = line.direction[i];
  const auto meeting =
      AxisMeeting<Real>::of(broadcast<Real>(plane.place[axis]), line.origin[i], speed);
  const auto start = after_start(line, meeting.t, meeting.error);
  return {.found = meeting.found && start.surely,
          .unknown = meeting.found && start.unknown,
          .entering = of_plane.normal[axis] > 0 ? speed < 0.0 : speed > 0.0,
          .t = meeting.t,
          .error = meeting.error};
}

/// Finds where lines that pass through a box enter it, or else leave it, if that is plainly on one
/// face. Next to an edge the exact test says which face is met.
template <class Real>
FirstCrossing<Real> end_in_box(const EnclosedBox& box, const BoxMeetings<Real>& meetings,
                               const FilterLine<Real>& line, const MaskOf<Real>& enters) {
  // The greatest of three, of which the second must plainly be less.
  const std::array<Real, 3> t = {select(enters, meetings.enter[0], -meetings.leave[0]),
                                 select(enters, meetings.enter[1], -meetings.leave[1]),
                                 select(enters, meetings.enter[2], -meetings.leave[2])};
  const Real greatest = max(max(t[0], t[1]), t[2]);
  const Real second = max(min(t[0], t[1]), min(max(t[0], t[1]), t[2]));
  // (Minus infinity with its error is no number, and is not next to anything.)
  const auto beside = second + meetings.error_of(second) >= greatest - meetings.error_of(greatest);

  const auto across_x = t[0] == greatest;
  const auto across_y = t[1] == greatest;
  const auto chosen = [&](const Real& x, const Real& y, const Real& z) {
    return select(across_x, x, select(across_y, y, z));
  };
  const auto of_axis = [&](const Vec3& v) {
    return chosen(broadcast<Real>(v.x), broadcast<Real>(v.y), broadcast<Real>(v.z));
  };
  const Real speed = chosen(line.direction[0], line.direction[1], line.direction[2]);
  const auto downwards = speed < 0.0;
  const auto is_upper = (enters && downwards) || (!enters && !downwards);
  const Real position = select(is_upper, of_axis(box.upper), of_axis(box.lower));
  const auto meeting = AxisMeeting<Real>::of(
      position, chosen(line.origin[0], line.origin[1], line.origin[2]), speed);
  return {.found = meetings.known && meeting.found && !beside,
          .entering = enters,
          .t = meeting.t,
          .error = meeting.error,
          .face = of_axis({0, 2, 4}) + select(is_upper, broadcast<Real>(1), Real{})};
}

template <class Real>
FirstCrossing<Real> first_crossing_of_box(const ProxyBox& box, const BoxMeetings<Real>& meetings,
                                          const FilterLine<Real>& line) {
  using Mask = MaskOf<Real>;
  const Enclosure<Real> part = meetings.enclosure();
  const Mask passes = part.enter_to < part.leave_from;
  const Mask misses = part.enter_from > part.leave_to || part.leave_to < line.begin;
  const Mask enters = passes && part.enter_from > line.certain_from;
  const Mask is_inside = passes && part.enter_to <= line.begin;
  const Mask leaves = is_inside && part.leave_from > line.certain_from;
  const Mask found = enters || leaves;
  FirstCrossing<Real> first{.found = found, .unknown = !found && !misses, .entering = enters};
  if (!any(found)) return first;
  const FirstCrossing<Real> end = end_in_box(box, meetings, line, enters);
  first.unknown = !misses && !(found && end.found);
  first.t = end.t;
  first.error = end.error;
  first.face = end.face;
  return first;
}

/// Finds the first crossings of lines that start on none of a cylinder's or cone's faces.
template <class Real>
FirstCrossing<Real> first_crossing_of_frustum(const ProxyAxis& cylinder,
                                              const FilterLine<Real>& line);

/// Finds the first crossings of asked lines that do not start on the torus.
template <class Real>
FirstCrossing<Real> first_crossing_of_torus(const ProxyAxis& torus, const FilterLine<Real>& line,
                                            const typename FirstCrossing<Real>::Mask& asked);

/// Finds which of the asked lines, which start on the torus and outwards, do not meet it again.
template <class Real>
FirstCrossing<Real> first_crossing_from_torus(const ProxyAxis& torus, const FilterLine<Real>& line,
                                              const typename FirstCrossing<Real>::Mask& asked);

/// Finds the first crossings with a sphere, plane or cylinder that BoundingProxies::resolved_leaf()
/// has a leaf for. The lines do not start on its surfaces.
template <class Real>
FirstCrossing<Real> first_crossing(const BoundingProxy& proxy, const BoundingProxies& proxies,
                                   const FilterLine<Real>& line) {
  if (proxy.is_sphere()) return first_crossing_of_sphere(proxy, proxies, line);
  if (proxy.kind == BoundingProxy::Kind::cylinder)
    return first_crossing_of_frustum(proxies.axis(proxy), line);
  return first_crossing_of_plane(proxy, proxies.axis(proxy), line);
}

/// Returns whether crossing_of_change() may be asked of a leaf of a CSG object.
inline bool has_resolved_crossings(const Leaf& leaf) {
  return !leaf.exact && leaf.placement->is_identity();
}

/// A ChangeCrossing is where lines come into such a leaf, or else out of it.
template <class Real>
struct ChangeCrossing {
  FirstCrossing<Real> crossing;  ///< not found where only the exact test can find it
  std::uint8_t root = 0;         ///< as in Crossing
};

// The overloads of change_of() are for the kinds of solids that enclose a leaf.

template <class Real>
ChangeCrossing<Real> change_of(const EnclosedSphere& sphere, const Leaf& /*leaf*/, bool into_leaf,
                               const FilterLine<Real>& line) {
  const double unit = power_of_two_below(sphere.radius);
  const auto chord = SphereChord<Real>::of(plain_ray(line), sphere.center, sphere.radius, unit);
  const Real& t = into_leaf ? chord.enter : chord.leave;
  return {.crossing = {.found = chord.found, .t = t, .error = chord.error_of(t)},
          .root = static_cast<std::uint8_t>(into_leaf ? 0 : 1)};
}
template <class Real>
ChangeCrossing<Real> change_of(const EnclosedBox& box, const Leaf& /*leaf*/, bool into_leaf,
                               const FilterLine<Real>& line) {
  const auto enters = lanes_of_mask<Real>(into_leaf ? ~std::uint32_t{0} : 0);
  return {.crossing = end_in_box(box, BoxMeetings<Real>::of(box, line), line, enters)};
}
template <class Real>
ChangeCrossing<Real> change_of(const EnclosedFrustum& frustum, const Leaf& leaf, bool into_leaf,
                               const FilterLine<Real>& line);
template <class Real>
ChangeCrossing<Real> change_of(const EnclosedPlane& /*plane*/, const Leaf& /*leaf*/,
                               bool /*into_leaf*/, const FilterLine<Real>& /*line*/) {
  return {};
}

/// Finds where lines that do not start on such a leaf come into it, or else out of it. The filter
/// has found that they do; `number` is the leaf's within the object.
template <class Real>
ChangeCrossing<Real> crossing_of_change(const IntervalFilter& filter, std::uint32_t number,
                                        const Leaf& leaf, bool into_leaf,
                                        const FilterLine<Real>& line) {
  return filter.visit(
      number, [&](const auto& solid) { return change_of<Real>(solid, leaf, into_leaf, line); });
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

/// Returns whether isolated_exit() may be asked where rays leave that start into the object.
inline bool resolves_exit(const BoundingProxy& proxy) {
  return proxy.kind == BoundingProxy::Kind::sphere && proxy.detail != nothing;
}

/// Finds where rays that start into an isolated sphere leave it. Nothing else is in `margin`. Where
/// it finds nothing the exact test must.
template <class Real>
FirstCrossing<Real> isolated_exit(const BoundingProxy& sphere, const Bounds& margin,
                                  const PlainRay<Real>& line, const Real& begin, const Real& end) {
  const double unit = power_of_two_below(sphere.radius);
  const auto other = SphereOtherEnd<Real>::of(line, sphere.place, sphere.radius, unit);
  const Real reach = other.t + coincidence_tolerance(line, other.t, other.error);
  const auto ahead = other.t > 0.0 && other.t > begin && other.t < end;
  const auto stays = is_within(margin, line, begin) && is_within(margin, line, min(reach, end));
  return {.found = ahead && stays, .t = other.t, .error = other.error};
}

/// Writes a hit as the exact test has it.
inline void write_first(const BoundingProxy& proxy, const BoundingProxies& proxies,
                        const FirstCrossing<double>& first, RayHit& hit) {
  const bool is_second = proxy.is_sphere() && !first.entering;
  const auto face = static_cast<std::uint32_t>(first.face);
  const bool is_box = proxy.kind == BoundingProxy::Kind::box;
  hit = {.t = first.t,
         .error = first.error,
         .object = proxy.object,
         .leaf = proxies.resolved_leaf(proxy),
         .face = face,
         .surface = is_box ? proxies.box(proxy).surfaces[face] : proxy.surface,
         .root = static_cast<std::uint8_t>(is_second),
         .entering = first.entering};
}

}  // namespace crt::core
