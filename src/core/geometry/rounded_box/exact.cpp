// The rounded box of the exact tier takes the walk of the standard tier for a guess. A crossing of
// it is right if, in double-double, the square of the distance from the inner box has its root
// there, and the point is surely beside that part of the inner box: as the square is convex along
// the line, it has but one root where it falls and one where it grows. All else, which is next to a
// seam or to a tangent, is walked without rounding.
// Tests: tests/geometry/exact_rounded_box_test.cpp
#include <algorithm>
#include <vector>

#include "core/geometry/clipped_span.hpp"
#include "core/geometry/exact_plane.hpp"
#include "core/geometry/exact_quadratic.hpp"
#include "core/geometry/exact_shape.hpp"
#include "core/geometry/rounded_box/rounded_box.hpp"
#include "core/math/precise_transform.hpp"
#include "core/math/vector.hpp"

namespace crt::core {
namespace {

std::size_t count_of(const Sides& sides) {
  return static_cast<std::size_t>(
      std::count_if(sides.begin(), sides.end(), [](int side) { return side != 0; }));
}

/// An ExactWalk is the walk of a line past the inner box without rounding.
class ExactWalk {
 public:
  ExactWalk(const Vec3& lower, const Vec3& upper, double radius, const ExactLine& line)
      : direction_(line.direction), radius_(line.weight * Dyadic(radius)) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<int>(axis);
      low_[axis] = line.origin[axis] - line.weight * Dyadic(lower[i]) - radius_;
      high_[axis] = line.origin[axis] - line.weight * Dyadic(upper[i]) + radius_;
      const int along = direction_[axis].sign();
      first_[axis] = -along;
      if (along == 0) {
        first_[axis] = low_[axis].sign() < 0 ? -1 : (high_[axis].sign() > 0 ? 1 : 0);
        continue;
      }
      add(along > 0 ? low_[axis] : high_[axis], axis, 0);
      add(along > 0 ? high_[axis] : low_[axis], axis, along);
    }
  }

  /// Returns the square of the distance from a part of the inner box, less that of the radius.
  ExactQuadratic equation(const Sides& sides) const {
    ExactQuadratic result{{}, {}, -square(radius_)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (sides[axis] == 0) continue;
      const Dyadic& offset = sides[axis] < 0 ? low_[axis] : high_[axis];
      result.a = result.a + square(direction_[axis]);
      result.b = result.b + offset * direction_[axis];
      result.c = result.c + square(offset);
    }
    return result;
  }

  /// Finds the sides with which the line enters and leaves. Returns false if it does not.
  bool find(Sides& enter, Sides& leave) const {
    bool inside = false;
    Sides sides = first_;
    for (std::size_t i = 0; i <= ends_.size(); ++i) {
      const ExactQuadratic distance = equation(sides);
      const bool is_inside_after = i < ends_.size() && value_at(distance, ends_[i]).sign() < 0;
      if (inside && !is_inside_after) {
        leave = sides;
        return true;
      }
      if (!inside && is_inside_after) {
        enter = sides;
        inside = true;
      }
      if (!inside && distance.a.sign() > 0) {
        const bool falls = i == 0 || slope_at(distance, ends_[i - 1]).sign() < 0;
        const bool grows = i == ends_.size() || slope_at(distance, ends_[i]).sign() > 0;
        if (falls && grows && distance.discriminant().sign() > 0) {
          enter = leave = sides;
          return true;
        }
      }
      if (i < ends_.size()) sides[ends_[i].axis] = ends_[i].after;
    }
    return false;
  }

 private:
  /// An End of a step is where the line meets a plane of the inner box, at numerator / denominator.
  struct End {
    Dyadic numerator;
    Dyadic denominator;  ///< > 0
    std::size_t axis;
    int after;  ///< the side after it
  };

  void add(const Dyadic& offset, std::size_t axis, int after) {
    const bool is_upwards = direction_[axis].sign() > 0;
    End end{.numerator = is_upwards ? -offset : offset,
            .denominator = is_upwards ? direction_[axis] : -direction_[axis],
            .axis = axis,
            .after = after};
    const auto is_before = [](const End& a, const End& b) {
      return (a.numerator * b.denominator - b.numerator * a.denominator).sign() < 0;
    };
    ends_.insert(std::upper_bound(ends_.begin(), ends_.end(), end, is_before), std::move(end));
  }

  static Dyadic value_at(const ExactQuadratic& of, const End& end) {
    const Dyadic cross_term = of.b * end.numerator * end.denominator;
    return of.a * square(end.numerator) + cross_term + cross_term + of.c * square(end.denominator);
  }
  static Dyadic slope_at(const ExactQuadratic& of, const End& end) {
    return of.a * end.numerator + of.b * end.denominator;
  }

  DyadicVector direction_;
  DyadicVector low_;   ///< the offset from the inner box's lower corner at t = 0
  DyadicVector high_;  ///< that from its upper corner
  Dyadic radius_;      ///< all times the weight of the line
  Sides first_{};
  std::vector<End> ends_;
};

class ExactRoundedBoxShape final : public ExactShape {
 public:
  explicit ExactRoundedBoxShape(const RoundedBox& box)
      : layout_(box),
        lower_(glm::min(box.corner_a, box.corner_b)),
        upper_(glm::max(box.corner_a, box.corner_b)),
        radius_(radius_of(box)),
        faces_{ExactPlane({-1, 0, 0}, lower_), ExactPlane({1, 0, 0}, upper_),
               ExactPlane({0, -1, 0}, lower_), ExactPlane({0, 1, 0}, upper_),
               ExactPlane({0, 0, -1}, lower_), ExactPlane({0, 0, 1}, upper_)} {}

  bool crossings(const ExactRay& ray, CrossingList& out) const override {
    if (starts_on_face(ray.near.start)) return crossings_from_face(ray, out);
    const std::size_t before = out.size();
    const NearLine line = NearLine::at_closest(ray.near, layout_.center, layout_.unit);
    const Walk walk = walk_through(layout_, line);
    if (!walk.found) {
      if (surely_misses(ray, line)) return false;
      append_exact(ray, out);
    } else {
      Crossing enter;
      Crossing leave;
      bool is_certain = refine(ray, line, walk.enter, true, enter);
      const bool is_enough =
          is_certain && ray.near.start.face == invalid_index && ray.near.is_first_wanted(enter);
      if (is_certain && !is_enough) is_certain = refine(ray, line, walk.leave, false, leave);
      if (!is_certain) {
        append_exact(ray, out);
      } else {
        out.push_back(enter);
        if (!is_enough) out.push_back(leave);
      }
    }
    if (ray.near.start.face == invalid_index) return false;
    for (std::size_t i = before; i < out.size(); ++i) move_behind_plane(ray.near.start, out[i]);
    if (out.size() == before + 2 && !(out[before].t < out[before + 1].t)) out.resize(before);
    return false;
  }

  std::optional<RealRoot> place(const ExactRay& ray, const Crossing& crossing) const override {
    if (is_start(ray, crossing)) return RealRoot::at(0);
    if (crossing.face < flat_faces_of_box)
      return root_at(ray, crossing, faces_[crossing.face].equation(ray.exact()));
    const ExactQuadratic equation = walk(ray).equation(sides_of(crossing.face));
    return root_at(
        ray, crossing,
        ray.near.start.face == crossing.face ? equation.beside_zero() : equation.polynomial());
  }

  ExactSurface surface(std::uint32_t face) const override {
    if (face < flat_faces_of_box)
      return {.is_plane = true, .points = {}, .numbers = faces_[face].numbers()};
    return {.points = {exactly(lower_), exactly(upper_)},
            .numbers = {radius_, static_cast<double>(face)}};
  }

  std::size_t bytes() const override {
    std::size_t bytes = sizeof *this;
    for (const ExactPlane& plane : faces_) bytes += plane.more_bytes();
    return bytes;
  }

 private:
  ExactWalk walk(const ExactRay& ray) const { return {lower_, upper_, radius_, ray.exact()}; }

  /// Returns whether a line misses also a box that is larger by far more than rounding.
  bool surely_misses(const ExactRay& ray, const NearLine& line) const {
    constexpr double filter_rounding = 0x1p10 * unit_roundoff;
    const double t = line.to_t(line.closest());
    const double open = filter_rounding * (glm::length(line.point) + layout_.size) +
                        2 * ray.point_error(layout_.center, t) / layout_.unit;
    return !walk_through(layout_.grown(open), line).found;
  }

  /// A NearPoint is a point of the line relative to the inner box's corners.
  struct NearPoint {
    PreciseVec3 low;
    PreciseVec3 high;
    double error = 0;  ///< of each component

    const DoubleDouble& beyond(const Sides& sides, std::size_t axis) const {
      return (sides[axis] < 0 ? low : high)[axis];
    }
    /// Returns whether the point has these sides, and all next to it within a distance.
    bool is_at(const Sides& sides, double near) const {
      const double margin = error + near;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool is_above_lower = low[axis].hi > margin;
        const bool is_below_upper = high[axis].hi < -margin;
        if (sides[axis] < 0 ? !(low[axis].hi < -margin)
                            : (sides[axis] > 0 ? !(high[axis].hi > margin)
                                               : !(is_above_lower && is_below_upper)))
          return false;
      }
      return true;
    }
  };
  NearPoint near_point(const ExactRay& ray, DoubleDouble t) const {
    NearPoint point{.low = precise_from_center(ray.near, lower_, t),
                    .high = precise_from_center(ray.near, upper_, t)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      point.low[axis] = point.low[axis] - DoubleDouble(radius_);
      point.high[axis] = point.high[axis] + DoubleDouble(radius_);
    }
    point.error = std::max(ray.point_error(lower_, t.hi), ray.point_error(upper_, t.hi)) +
                  precise_roundoff * radius_;
    return point;
  }

  /// Finds the crossing of a step. Returns false if it is not certain to be there.
  bool refine(const ExactRay& ray, const NearLine& line, const WalkStep& step, bool entering,
              Crossing& crossing) const {
    crossing.face = face_at(step.sides);
    crossing.entering = entering;
    const bool is_flat = crossing.face < flat_faces_of_box;
    if (is_flat) {
      if (!meet_plane(ray, crossing)) return false;
    } else {
      crossing.root = entering ? 0 : 1;
      crossing.t = round_crossing(layout_, ray.near, line, step, entering).t;
      if (!polish(ray, step.sides, crossing)) return false;
    }
    const double moved = crossing.error * largest_component(ray.near.direction);
    return near_point(ray, {crossing.t, crossing.t_low}).is_at(step.sides, 2 * moved);
  }

  bool meet_plane(const ExactRay& ray, Crossing& crossing) const {
    if (ray.near.start.face == crossing.face) return true;
    const ExactPlane::Meeting meeting = faces_[crossing.face].meet(ray);
    const bool entering = crossing.entering;
    crossing = meeting.crossing(crossing.face);
    crossing.entering = entering;
    return meeting.found() && (meeting.side < 0) == entering;
  }

  /// Takes steps of Newton's iteration until t is certain to the last bit. Returns false if that
  /// fails.
  bool polish(const ExactRay& ray, const Sides& sides, Crossing& crossing) const {
    const Vec3& d = ray.near.direction;
    DoubleDouble t = crossing.t;
    constexpr int most_steps = 4;
    for (int step = 0; step < most_steps; ++step) {
      const NearPoint p = near_point(ray, t);
      PreciseVec3 q{0.0, 0.0, 0.0};
      double slope = 0;
      double squared_length = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (sides[axis] == 0) continue;
        const double along = d[static_cast<int>(axis)];
        q[axis] = p.beyond(sides, axis);
        slope += q[axis].hi * along;
        squared_length += along * along;
      }
      if ((slope < 0) != crossing.entering || slope == 0) return false;
      const DoubleDouble height = precise_dot(q, q) - two_product(radius_, radius_);
      const double size = sum_of_sizes(q);
      const double change = height.value() / (2 * slope);
      t = t + DoubleDouble(-change);
      // The slope and the change are rounded, too.
      constexpr double change_rounding = 0x1p-48;
      const NewtonStep newton{
          .change = change,
          .value_error = 2 * size * p.error + precise_roundoff * (size * size + radius_ * radius_),
          .rate = 2 * slope,
          .rate_error = 2 * change_rounding * size * largest_component(d),
          .half_curvature = squared_length};
      const double error = newton.error() + precise_roundoff * std::abs(t.hi);
      if (settle(ray, t, error, crossing)) return true;
    }
    return false;
  }

  /// Appends the crossings of a line without rounding.
  void append_exact(const ExactRay& ray, CrossingList& out) const {
    const ExactWalk exact = walk(ray);
    Sides sides[2];
    if (!exact.find(sides[0], sides[1])) return;
    Crossing ends[2];
    for (int i = 0; i < 2; ++i) {
      Crossing& end = ends[i];
      end.face = face_at(sides[i]);
      end.entering = i == 0;
      if (end.face < flat_faces_of_box) {
        if (!meet_plane(ray, end)) return;
        continue;
      }
      end.root = static_cast<std::uint8_t>(i);
      end = exact_crossing(exact.equation(sides[i]).roots()[end.root], end);
      if (!std::isfinite(end.t)) return;
    }
    out.push_back(ends[0]);
    out.push_back(ends[1]);
  }

  /// Finds the crossings of a ray that starts on a face. As in the standard tier, the distance of
  /// the start is that of the surface.
  bool crossings_from_face(const ExactRay& ray, CrossingList& out) const {
    const FaceStart& start = ray.near.start;
    const bool leaves = start.side == Side::outside;
    ObjectRay near = leaves ? turned_round(ray.near) : ray.near;
    near.start = {};
    ExactRay ahead = ray.seen_as(near);
    if (leaves) ahead.world_direction = -ray.world_direction;
    const double shortest = unit_roundoff * layout_.unit / largest_component(near.direction);
    return append_from_face(start, exit_from_face(ahead, start.face, out), shortest, out);
  }

  /// Returns where a ray leaves that starts on a face and goes in. `out` has room for crossings,
  /// and is left as it was.
  Crossing exit_from_face(const ExactRay& ray, std::uint32_t start, CrossingList& out) const {
    const NearLine line = NearLine::at_origin(ray.near, layout_.center, layout_.unit);
    const WayOut way = way_out(layout_, line);
    if (way.is_first) return second_crossing(ray, start, way.leave.sides);
    Crossing leave;
    if (refine(ray, line, way.leave, false, leave)) return leave;
    const std::size_t size = out.size();
    append_exact(ray, out);
    const bool is_found = out.size() > size;
    if (is_found) leave = out.back();
    out.resize(size);
    if (is_found && leave.face == start) return second_crossing(ray, start, sides_of(start));
    // The rounding of the start may be all that makes the line miss. Then it leaves at once.
    return is_found ? leave : Crossing{.face = start};
  }

  /// Returns where a ray from a face is as far from that part of the inner box once more.
  Crossing second_crossing(const ExactRay& ray, std::uint32_t start, const Sides& sides) const {
    Crossing crossing{.face = start};
    if (count_of(sides) < 2) return crossing;
    crossing.root = 1;
    const NearPoint p = near_point(ray, 0.0);
    PreciseVec3 q{0.0, 0.0, 0.0};
    PreciseVec3 d{0.0, 0.0, 0.0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (sides[axis] == 0) continue;
      q[axis] = p.beyond(sides, axis);
      d[axis] = precise_direction(ray.near)[axis];
    }
    const DoubleDouble a = precise_dot(d, d);
    const DoubleDouble half = -precise_dot(q, d) / a;
    const DoubleDouble t{2 * half.hi, 2 * half.lo};
    const double size = sum_of_sizes(q);
    const double speed = std::sqrt(a.hi);
    const double error =
        2 * (2 * speed * p.error + size * ray.direction_error + precise_roundoff * size * speed) /
            a.hi +
        (precise_roundoff + 4 * ray.direction_error / speed) * std::abs(t.hi);
    if (settle(ray, t, error, crossing)) return crossing;
    return exact_crossing(walk(ray).equation(sides).root_beside_zero(), crossing);
  }

  RoundedBoxLayout layout_;
  Vec3 lower_;
  Vec3 upper_;
  double radius_;
  std::array<ExactPlane, 6> faces_;
};

}  // namespace

std::unique_ptr<const ExactShape> make_exact_shape(const RoundedBox& box) {
  if (box.radius == 0) return make_exact_shape(box_of(box));
  return std::make_unique<ExactRoundedBoxShape>(box);
}

}  // namespace crt::core
