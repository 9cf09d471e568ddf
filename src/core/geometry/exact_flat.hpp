// Discs, half planes and triangles of the exact tier have in common a plane, and the question on
// which side of its edges the line meets it. Edges belong to the surface.
#pragma once

#include "core/geometry/exact_plane.hpp"
#include "core/geometry/exact_shape.hpp"
#include "core/geometry/plane_face.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

/// These are far more roundings than any of the filters below has. Rays that pass an edge more
/// closely are few.
inline constexpr double filter_roundings = 0x1p8;
inline constexpr double filter_rounding = filter_roundings * unit_roundoff;

/// Returns where a line meets a plane, without rounding, as ExactShape::place() does.
inline std::optional<RealRoot> place_on(const ExactPlane& plane, const ExactRay& ray,
                                        const Crossing& crossing) {
  if (is_start(ray, crossing)) return RealRoot::at(0);
  return root_at(ray, crossing, plane.equation(ray.exact()));
}

/// An ExactFlatShape is a piece of a plane.
class ExactFlatShape : public ExactShape {
 public:
  explicit ExactFlatShape(ExactPlane plane) : plane_(std::move(plane)) {}

  bool crossings(const ExactRay& ray, CrossingList& out) const final {
    const ExactPlane::Meeting meeting = plane_.meet_surface(ray);
    if (!meeting.found()) return false;
    if (PlaneFace::starts_here(ray.near) || contains(ray, meeting))
      out.push_back(meeting.crossing());
    return false;
  }

  std::optional<RealRoot> place(const ExactRay& ray, const Crossing& crossing) const final {
    return place_on(plane_, ray, crossing);
  }

  ExactSurface surface(std::uint32_t /*face*/) const final {
    return {.is_plane = true, .points = {}, .numbers = plane_.numbers()};
  }

 protected:
  using Meeting = ExactPlane::Meeting;

  virtual bool contains(const ExactRay& ray, const Meeting& meeting) const = 0;

  const ExactPlane& plane() const { return plane_; }

  /// A NearPoint is the meeting relative to `center`, with a bound on the error of each component.
  struct NearPoint {
    Vec3 offset;
    double error;
  };
  NearPoint near_point(const ExactRay& ray, const Meeting& meeting) const {
    const Vec3& center = plane_.position();
    const double t = meeting.t.hi;
    const Vec3 offset = ray.near.from_center(center, t, meeting.t.lo);
    return {offset, filter_rounding * largest_component(offset) + ray.point_error(center, t) +
                        meeting.error * largest_component(ray.near.direction)};
  }

  /// Returns the meeting without rounding. A ray that starts on the plane meets it at its start,
  /// whatever its rounded origin says.
  ExactPoint exact_meeting(const ExactRay& ray, const Meeting& meeting) const {
    const ExactLine line = ray.exact();
    const bool at_start = meeting.t.hi == 0 && meeting.error == 0;
    const ExactPlane::Fraction t = at_start
                                       ? ExactPlane::Fraction{.numerator = {}, .denominator = 1}
                                       : plane_.meet_exactly(line);
    return exact_point(line, t, plane_.position());
  }

 private:
  ExactPlane plane_;
};

}  // namespace crt::core
