// Planes, half planes, discs and triangles of the exact tier: a plane, and on which side of its edges the
// line meets it. Edges belong to the surface.
#include <algorithm>

#include "core/geometry/exact_plane.hpp"
#include "core/geometry/exact_shape.hpp"
#include "core/geometry/plane_face.hpp"
#include "core/math/vector.hpp"

namespace crt::core {
namespace {

/// Far more roundings than any of the filters below has. Rays that pass an edge more closely are few.
constexpr double filter_roundings = 0x1p8;
constexpr double filter_rounding = filter_roundings * unit_roundoff;

using Meeting = ExactPlane::Meeting;
using Fraction = ExactPlane::Fraction;

std::optional<RealRoot> place_on(const ExactPlane& plane, const ExactRay& ray, const Crossing& crossing) {
  if (is_start(ray, crossing)) return RealRoot::at(0);
  return root_at(ray, crossing, plane.equation(ray.exact()));
}

class ExactPlaneShape final : public ExactShape {
 public:
  explicit ExactPlaneShape(const Plane& plane) : plane_(plane.normal, plane.position) {}

  bool crossings(const ExactRay& ray, CrossingList& out) const override {
    if (ray.near.start.face == 0) {
      const bool entering = ray.near.start.side == Side::inside;
      if (plane_.side(ray) == 0) return entering;
      out.push_back({.entering = entering});
      return !entering;
    }
    const Meeting meeting = plane_.meet(ray);
    if (!meeting.found()) return meeting.behind;
    out.push_back(meeting.crossing());
    return meeting.side > 0;
  }

  std::optional<RealRoot> place(const ExactRay& ray, const Crossing& crossing) const override {
    return place_on(plane_, ray, crossing);
  }

  ExactSurface surface(std::uint32_t /*face*/) const override {
    return {.is_plane = true, .points = {}, .numbers = plane_.numbers()};
  }

  std::size_t bytes() const override { return sizeof *this + plane_.more_bytes(); }

 private:
  ExactPlane plane_;
};

/// A piece of a plane.
class ExactFlatShape : public ExactShape {
 public:
  explicit ExactFlatShape(ExactPlane plane) : plane_(std::move(plane)) {}

  bool crossings(const ExactRay& ray, CrossingList& out) const final {
    const Meeting meeting = plane_.meet_surface(ray);
    if (!meeting.found()) return false;
    if (PlaneFace::starts_here(ray.near) || contains(ray, meeting)) out.push_back(meeting.crossing());
    return false;
  }

  std::optional<RealRoot> place(const ExactRay& ray, const Crossing& crossing) const final {
    return place_on(plane_, ray, crossing);
  }

  ExactSurface surface(std::uint32_t /*face*/) const final {
    return {.is_plane = true, .points = {}, .numbers = plane_.numbers()};
  }

 protected:
  virtual bool contains(const ExactRay& ray, const Meeting& meeting) const = 0;

  const ExactPlane& plane() const { return plane_; }

  /// The meeting relative to `center`, and what each of its components may be off by.
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

  /// The meeting without rounding. A ray that starts on the plane meets it at its start, whatever its
  /// rounded origin says.
  ExactPoint exact_meeting(const ExactRay& ray, const Meeting& meeting) const {
    const ExactLine line = ray.exact();
    const bool at_start = meeting.t.hi == 0 && meeting.error == 0;
    const Fraction t = at_start ? Fraction{.numerator = {}, .denominator = 1} : plane_.meet_exactly(line);
    return exact_point(line, t, plane_.position());
  }

 private:
  ExactPlane plane_;
};

class ExactDiscShape final : public ExactFlatShape {
 public:
  explicit ExactDiscShape(const Disc& disc)
      : ExactFlatShape(ExactPlane(disc.normal, disc.center)), radius_(disc.radius) {}

  std::size_t bytes() const override { return sizeof *this + plane().more_bytes(); }

 private:
  bool contains(const ExactRay& ray, const Meeting& meeting) const override {
    const NearPoint point = near_point(ray, meeting);
    const double distance = glm::length(point.offset / radius_);
    const double room = 1 - distance;
    if (std::abs(room) > filter_rounding * (1 + distance) + 2 * (point.error / radius_)) return room > 0;
    const ExactPoint exact = exact_meeting(ray, meeting);
    return (dot(exact.offset, exact.offset) - square(exact.weight * Dyadic(radius_))).sign() <= 0;
  }

  double radius_;
};

/// Of a point in the plane, the direction tells the side as well as what of it is across the normal.
class ExactHalfPlaneShape final : public ExactFlatShape {
 public:
  explicit ExactHalfPlaneShape(const HalfPlane& half_plane)
      : ExactFlatShape(ExactPlane(half_plane.normal, half_plane.position)),
        direction_(half_plane.direction),
        scaled_direction_(scaled_to_one(half_plane.direction)) {}

  std::size_t bytes() const override { return sizeof *this + plane().more_bytes(); }

 private:
  bool contains(const ExactRay& ray, const Meeting& meeting) const override {
    const NearPoint point = near_point(ray, meeting);
    const double inward = glm::dot(point.offset, scaled_direction_);
    constexpr double largest_sum = 6;  // of three components below 2
    if (std::abs(inward) > largest_sum * point.error) return inward > 0;
    const ExactPoint exact = exact_meeting(ray, meeting);
    return dot(exact.offset, exactly(direction_)).sign() >= 0;
  }

  Vec3 direction_;
  Vec3 scaled_direction_;
};

class ExactTriangleShape final : public ExactFlatShape {
 public:
  explicit ExactTriangleShape(const Triangle& triangle)
      : ExactFlatShape(ExactPlane::through(triangle.a, triangle.b, triangle.c)),
        corners_{triangle.a, triangle.b, triangle.c} {}

  std::size_t bytes() const override { return sizeof *this + plane().more_bytes(); }

 private:
  bool contains(const ExactRay& ray, const Meeting& meeting) const override {
    bool left = false;
    bool right = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const int side = side_of_edge(ray, meeting.t.hi, corners_[i], corners_[(i + 1) % 3]);
      left = left || side > 0;
      right = right || side < 0;
      if (left && right) return false;
    }
    return true;
  }

  /// The sign of (from - o) . ((to - from) x d), as in triangle.hpp.
  static int side_of_edge(const ExactRay& ray, double t, const Vec3& from, const Vec3& to) {
    const Vec3 d = scaled_to_one(ray.near.direction);
    const double stretch = largest_component(d) / largest_component(ray.near.direction);
    const Vec3 edge = to - from;
    const Vec3 start = -ray.near.from_center(from, t);
    const double volume = glm::dot(start, accurate_cross(edge, d));
    const double start_size = largest_component(start);
    const double open =
        filter_rounding * start_size + ray.point_error(from, t) + start_size * stretch * ray.direction_error;
    constexpr double largest_sum = 12;  // of six products, each of components of edge and d (below 2)
    if (std::abs(volume) > largest_sum * open * largest_component(edge)) return volume > 0 ? 1 : -1;
    return exact_side_of_edge(ray.exact(), from, to);
  }

  static int exact_side_of_edge(const ExactLine& line, const Vec3& from, const Vec3& to) {
    const DyadicVector start = line.weight * exactly(from) - line.origin;
    return dot(start, cross(exactly(to) - exactly(from), line.direction)).sign();
  }

  std::array<Vec3, 3> corners_;
};

}  // namespace

std::unique_ptr<const ExactShape> make_exact_shape(const Plane& plane) {
  return std::make_unique<ExactPlaneShape>(plane);
}

std::unique_ptr<const ExactShape> make_exact_shape(const HalfPlane& half_plane) {
  return std::make_unique<ExactHalfPlaneShape>(half_plane);
}

std::unique_ptr<const ExactShape> make_exact_shape(const Disc& disc) {
  return std::make_unique<ExactDiscShape>(disc);
}

std::unique_ptr<const ExactShape> make_exact_shape(const Triangle& triangle) {
  return std::make_unique<ExactTriangleShape>(triangle);
}

}  // namespace crt::core
