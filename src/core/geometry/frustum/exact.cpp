#include "core/geometry/frustum/exact.hpp"
#include "core/geometry/cone/cone.hpp"
#include "core/geometry/cylinder/cylinder.hpp"

#include <limits>

#include "core/geometry/exact_quadratic.hpp"
#include "core/geometry/exact_shape.hpp"
#include "core/geometry/frustum/frustum.hpp"
#include "core/math/vector.hpp"

namespace crt::core {
namespace {

/// An ExactSide is g along a line without rounding. It answers every question.
class ExactSide {
 public:
  ExactSide(const ExactFrustum& frustum, const ExactRay& ray) : line_(ray.exact()) {
    const DyadicVector axis = exactly(frustum.wide) - exactly(frustum.narrow);
    const DyadicVector offset = line_.origin - line_.weight * exactly(frustum.narrow);
    const Dyadic growth = Dyadic(frustum.wide_radius) - Dyadic(frustum.radius);
    const Dyadic squared_length = dot(axis, axis);
    const DyadicVector across = cross(offset, axis);
    const DyadicVector turning = cross(line_.direction, axis);
    radius_ = Dyadic(frustum.radius) * line_.weight * squared_length + growth * dot(offset, axis);
    radius_rate_ = growth * dot(line_.direction, axis);
    g_ = {squared_length * dot(turning, turning) - square(radius_rate_),
          squared_length * dot(across, turning) - radius_ * radius_rate_,
          squared_length * dot(across, across) - square(radius_)};
  }

  const ExactQuadratic& equation() const { return g_; }

  std::optional<int> sign_at(const CapMeeting& end) const {
    if (!end.found()) return 1;
    if (end.within_rim) return -1;
    if (end.at_start) return g_.c.sign();
    const ExactPlane::Fraction t = end.plane->meet_exactly(line_);
    const Dyadic cross_term = g_.b * t.numerator * t.denominator;
    return (g_.a * square(t.numerator) + cross_term + cross_term + g_.c * square(t.denominator))
        .sign();
  }

  std::optional<bool> is_inside_between(const CapMeeting& enter, const CapMeeting& leave) const {
    if (g_.a.sign() <= 0 || g_.discriminant().sign() <= 0) return false;
    return side_of_vertex(enter) < 0 && side_of_vertex(leave) > 0;
  }

  std::optional<Crossing> root(bool entering, const CapMeeting& /*enter*/,
                               const CapMeeting& /*leave*/) const {
    Crossing crossing{.face = FrustumShape::side_face, .entering = entering};
    if (g_.a.sign() == 0) {
      return exact_crossing((-g_.c.rounded() / (g_.b + g_.b).rounded()).unscaled(), crossing);
    }
    crossing.root = (g_.a.sign() > 0) == entering ? 0 : 1;
    return exact_crossing(g_.roots()[crossing.root], crossing);
  }

  /// Returns the signs that decide what happens to a line that starts on the side.
  SideStart start() const {
    SideStart result{.a = g_.a.sign(),
                     .b = g_.b.sign(),
                     .radius = radius_.sign(),
                     .radius_rate = radius_rate_.sign(),
                     .other = {.face = FrustumShape::side_face}};
    if (result.a != 0) result.other = exact_crossing(g_.root_beside_zero(), result.other);
    return result;
  }

 private:
  /// Returns the sign of the end's t less that of the vertex of g, which opens upwards.
  int side_of_vertex(const CapMeeting& end) const {
    if (!end.found()) return end.meeting.side;
    if (end.at_start) return g_.b.sign();
    const ExactPlane::Fraction t = end.plane->meet_exactly(line_);
    return (g_.a * t.numerator + g_.b * t.denominator).sign();
  }

  ExactLine line_;
  ExactQuadratic g_;
  Dyadic radius_;  ///< r |W|^2 + D p . W at the origin
  Dyadic radius_rate_;
};

class ExactFrustumShape final : public ExactShape {
 public:
  ExactFrustumShape(const Vec3& from, const Vec3& to, double from_radius, double to_radius)
      : frustum_(from, to, from_radius, to_radius),
        caps_{ExactPlane::across_axis(to, from, from), ExactPlane::across_axis(from, to, to)},
        shortest_(unit_roundoff * std::min(frustum_.wide_radius, largest_component(to - from))) {}

  bool crossings(const ExactRay& ray, CrossingList& out) const override {
    const FaceStart& start = ray.near.start;
    if (start.face == FrustumShape::side_face) return crossings_from_side(ray, out);
    CapMeeting enter;
    CapMeeting leave;
    enter.meeting.side = -1;
    leave.meeting.side = 1;
    for (std::uint32_t cap = 0; cap < caps_.size(); ++cap) {
      CapMeeting end;
      end.plane = &caps_[cap];
      end.face = cap + 1;
      if (start.face == end.face) {
        end.at_start = true;
        end.within_rim = start.on_face;
        end.meeting.side = caps_[cap].side(ray);
        if (end.meeting.side <= 0 && start.side == Side::outside) return false;
      } else {
        end.meeting = caps_[cap].meet(ray);
        if (!end.meeting.found() && !end.meeting.behind) return false;
      }
      if (end.meeting.found()) (end.meeting.side < 0 ? enter : leave) = end;
    }
    const double first_wanted_after = start.face == invalid_index
                                          ? ray.near.first_wanted_after
                                          : std::numeric_limits<double>::infinity();
    Piece piece;
    FilteredSide filtered(frustum_, ray);
    std::optional<bool> hit = cut(filtered, enter, leave, first_wanted_after, piece);
    if (!hit) {
      ExactSide exact(frustum_, ray);
      hit = cut(exact, enter, leave, first_wanted_after, piece);
    }
    if (!*hit || !std::isfinite(piece.enter.t) || !std::isfinite(piece.leave.t)) return false;
    if (start.face == invalid_index) {
      out.push_back(piece.enter);
      if (piece.leave.face != invalid_index) out.push_back(piece.leave);
      return false;
    }
    ClippedSpan span(start, shortest_ / largest_component(ray.near.direction));
    span.enter(piece.enter);
    span.leave(piece.leave);
    return span.finish(out);
  }

  std::optional<RealRoot> place(const ExactRay& ray, const Crossing& crossing) const override {
    if (is_start(ray, crossing)) return RealRoot::at(0);
    if (crossing.face != FrustumShape::side_face) {
      return root_at(ray, crossing, caps_[crossing.face - 1].equation(ray.exact()));
    }
    const ExactQuadratic side = ExactSide(frustum_, ray).equation();
    return root_at(ray, crossing,
                   ray.near.start.face == crossing.face ? side.beside_zero() : side.polynomial());
  }

  ExactSurface surface(std::uint32_t face) const override {
    if (face != FrustumShape::side_face) {
      return {.is_plane = true, .points = {}, .numbers = caps_[face - 1].numbers()};
    }
    return {.points = {exactly(frustum_.narrow), exactly(frustum_.wide)},
            .numbers = {frustum_.radius, frustum_.wide_radius}};
  }

  std::size_t bytes() const override {
    std::size_t bytes = sizeof *this;
    for (const ExactPlane& plane : caps_) bytes += plane.more_bytes();
    return bytes;
  }

 private:
  struct Piece {
    Crossing enter;
    Crossing leave{.face = invalid_index};  ///< left out, if it is not needed
  };

  /// Finds what the line cuts out of the solid. The result is unknown if the side cannot decide.
  template <typename Side>
  static std::optional<bool> cut(Side& side, const CapMeeting& enter, const CapMeeting& leave,
                                 double first_wanted_after, Piece& piece) {
    const std::optional<int> at_enter = side.sign_at(enter);
    const std::optional<int> at_leave = side.sign_at(leave);
    if (!at_enter || !at_leave) return std::nullopt;
    if (*at_enter >= 0 && *at_leave >= 0) {
      const std::optional<bool> is_inside = side.is_inside_between(enter, leave);
      if (!is_inside || !*is_inside) return is_inside;
    }
    const auto first = *at_enter < 0 ? enter.crossing() : side.root(true, enter, leave);
    if (first && first->t - errors_at_start * first->error > first_wanted_after) {
      piece.enter = *first;
      return true;
    }
    const auto last = *at_leave < 0 ? leave.crossing() : side.root(false, enter, leave);
    if (!first || !last) return std::nullopt;
    piece = {*first, *last};
    return true;
  }

  bool crossings_from_side(const ExactRay& ray, CrossingList& out) const {
    const FaceStart& start = ray.near.start;
    ClippedSpan span(start, shortest_ / largest_component(ray.near.direction));
    for (std::uint32_t cap = 0; cap < caps_.size(); ++cap) {
      const ExactPlane::Meeting meeting = caps_[cap].meet(ray);
      if (!meeting.found()) {
        if (!meeting.behind) span.clear();
      } else if (meeting.side < 0) {
        span.enter(meeting.crossing(cap + 1));
      } else {
        span.leave(meeting.crossing(cap + 1));
      }
    }
    std::optional<SideStart> side = FilteredSide(frustum_, ray).start();
    if (!side) side = ExactSide(frustum_, ray).start();
    clip_side_from_surface(*side, start, span);
    return span.finish(out);
  }

  ExactFrustum frustum_;
  std::array<ExactPlane, 2> caps_;  ///< at from and to
  double shortest_;                 ///< the shortest span of a ray that starts inwards, for |d| = 1
};

}  // namespace

std::unique_ptr<const ExactShape> make_exact_shape(const Cylinder& cylinder) {
  return std::make_unique<ExactFrustumShape>(cylinder.from, cylinder.to, cylinder.radius,
                                             cylinder.radius);
}

std::unique_ptr<const ExactShape> make_exact_shape(const Cone& cone) {
  return std::make_unique<ExactFrustumShape>(cone.from, cone.to, cone.radius, cone.radius2);
}

}  // namespace crt::core
