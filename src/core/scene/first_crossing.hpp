// Where rays first cross the objects whose outline alone tells it: spheres, and planes across a coordinate
// axis, in the standard tier and without a transform. The same as their shapes say, to the last bit.
#pragma once

#include <array>
#include <span>

#include "core/geometry/plain_ray.hpp"
#include "core/geometry/plane_face.hpp"
#include "core/geometry/sphere.hpp"
#include "core/scene/company_width.hpp"
#include "core/scene/outline.hpp"
#include "core/scene/prepared_data.hpp"

namespace crt::core {

/// Of one ray, or of as many side by side as a Real has lanes.
template <class Real>
struct FirstCrossing {
  using Mask = decltype(Real{} < Real{});

  Mask found{};    ///< there is one after the start; else what follows means nothing
  Mask unknown{};  ///< it takes a closer look to tell: nothing here means anything
  Mask entering{};
  Real t{};
  Real error{};
};

/// Whether a crossing is after the start of a ray that does not start on its surface.
template <class Mask>
struct AfterStart {
  Mask surely;
  Mask unknown;  ///< as is_at_start() has it
};

template <class Real>
auto after_start(const OutlineLine<Real>& line, const Real& t, const Real& error) {
  using Mask = decltype(t > line.begin);
  const Real way = t - line.begin - error;
  const Mask after = t > line.begin;
  const Mask clear = way > flattest_start * line.start_error;
  return AfterStart<Mask>{.surely = both(after, clear),
                          .unknown = both(after, neither(clear, way <= line.start_error))};
}

template <class Real>
PlainRay<Real> plain_ray(const OutlineLine<Real>& line) {
  const auto& o = line.origin;
  const auto& d = line.direction;
  return {.origin = {o[0], o[1], o[2]}, .direction = {d[0], d[1], d[2]}};
}

template <class Real>
FirstCrossing<Real> first_crossing_of_sphere(const Outline& sphere, const OutlineLine<Real>& line) {
  const double unit = power_of_two_below(sphere.radius);
  const auto chord = SphereChord<Real>::of(plain_ray(line), sphere.place, sphere.radius, unit);
  if (!any(chord.found)) return {};
  const auto enter = after_start(line, chord.enter.t, chord.enter.error);
  const auto leave = after_start(line, chord.leave.t, chord.leave.error);
  return {.found = both(chord.found, either(enter.surely, leave.surely)),
          .unknown = both(chord.found, either(enter.unknown, leave.unknown)),
          .entering = enter.surely,
          .t = enter.surely ? chord.enter.t : chord.leave.t,
          .error = enter.surely ? chord.enter.error : chord.leave.error};
}

template <class Real>
FirstCrossing<Real> first_crossing_of_plane(const Outline& plane, const OutlineAxis& of_plane,
                                            const OutlineLine<Real>& line) {
  // Of the normal one component alone is not 0.
  const int axis = of_plane.normal.x != 0 ? 0 : of_plane.normal.y != 0 ? 1 : 2;
  const auto i = static_cast<std::size_t>(axis);
  const Real& speed = line.direction[i];
  const auto meeting = AxisMeeting<Real>::of(spread<Real>(plane.place[axis]), line.origin[i], speed);
  const auto start = after_start(line, meeting.t, meeting.error);
  return {.found = both(meeting.found, start.surely),
          .unknown = both(meeting.found, start.unknown),
          .entering = of_plane.normal[axis] > 0 ? speed < 0.0 : speed > 0.0,
          .t = meeting.t,
          .error = meeting.error};
}

/// Of one that leaf_told() knows of, and rays that do not start on its surface.
template <class Real>
FirstCrossing<Real> first_crossing(const Outline& outline, std::span<const OutlineAxis> axes,
                                   const OutlineLine<Real>& line) {
  if (outline.kind == Outline::Kind::sphere) return first_crossing_of_sphere(outline, line);
  return first_crossing_of_plane(outline, axes[outline.detail], line);
}

/// Whether a line is within a box at t.
template <class Real>
auto is_within(const Bounds& box, const PlainRay<Real>& line, const Real& t) {
  const Vec3Of<Real> place = line.at(t);
  const auto is_between = [](double lower, const Real& x, double upper) {
    return both(x >= lower, x <= upper);
  };
  return both(
      both(is_between(box.lower.x, place.x, box.upper.x), is_between(box.lower.y, place.y, box.upper.y)),
      is_between(box.lower.z, place.z, box.upper.z));
}

/// Whether the outline alone tells where rays leave that start into the object.
inline bool tells_exit(const Outline& outline) {
  return outline.kind == Outline::Kind::sphere && outline.detail != nothing;
}

/// Where rays that start into a sphere leave it which keeps apart from all else.
template <class Real>
struct ExitApart {
  decltype(Real{} < Real{}) found{};  ///< surely that and nothing before it; else it takes a closer look
  Real t{};
  Real error{};

  /// Nothing else is in `room`.
  static ExitApart of(const Outline& sphere, const Bounds& room, const PlainRay<Real>& line,
                      const Real& begin, const Real& end) {
    const double unit = power_of_two_below(sphere.radius);
    const auto other = SphereOtherEnd<Real>::of(line, sphere.place, sphere.radius, unit);
    const Real reach = other.t + company_width(line, other.t, other.error);
    const auto ahead = both(both(other.t > 0.0, other.t > begin), other.t < end);
    const auto stays = both(is_within(room, line, begin), is_within(room, line, reach < end ? reach : end));
    return {.found = both(ahead, stays), .t = other.t, .error = other.error};
  }
};

/// As the general test has it.
inline void write_first(const Outline& outline, std::uint32_t leaf, double t, double error, bool entering,
                        RayHit& hit) {
  const bool is_second = outline.kind == Outline::Kind::sphere && !entering;
  hit = {.t = t,
         .error = error,
         .object = outline.object,
         .leaf = leaf,
         .face = 0,
         .surface = outline.surface,
         .root = static_cast<std::uint8_t>(is_second),
         .entering = entering};
}

}  // namespace crt::core
