// A line is tested against axis-parallel boxes by slabs.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/geometry/bounds.hpp"
#include "core/math/lanes.hpp"
#include "core/math/vector.hpp"
#include "core/ray/filter_line.hpp"

namespace crt::core {

/// A LineSpan is the part of a line inside a box, rounded outwards. It is empty (enter > leave) if
/// the line misses the box.
struct LineSpan {
  double enter = 0;
  double leave = 0;

  bool empty() const { return !(enter <= leave); }
};

/// LineSpanLanes are spans side by side, of several lines or of several boxes.
struct LineSpanLanes {
  Lanes enter;
  Lanes leave;
};

/// RaySlabs are what of a line does not change from box to box.
class RaySlabs {
 public:
  /// Three roundings go into each t: of the difference, the inverse and the product.
  static constexpr double slack = 4 * std::numeric_limits<double>::epsilon();
  /// If an inverse is above this, the line is parallel to the slab, or all but, and the quotient
  /// must be taken.
  static constexpr double largest_inverse = 0x1p1000;

  /// `origin_error` is how far rounding may have put the origin from where it is meant to be. The
  /// spans hold those of all lines that may be meant.
  RaySlabs(const Vec3& origin, const Vec3& direction, double origin_error = 0)
      : origin_(origin),
        direction_(direction),
        origin_error_(origin_error),
        origin_slack_(origin_error + 4 * slack * largest_component(origin)) {
    for (int axis = 0; axis < 3; ++axis) inverse_[axis] = 1 / direction[axis];
  }

  LineSpan span(const Bounds& box) const {
    LineSpan span;
    span_of<double>(by_axis(box.lower), by_axis(box.upper), span.enter, span.leave);
    return span;
  }

  /// Corners are those of several boxes side by side, by axis.
  using Corners = std::array<std::array<double, lane_count>, 3>;
  LineSpanLanes spans(const Corners& lower, const Corners& upper) const {
    LineSpanLanes spans;
    span_of<Lanes>(lower, upper, spans.enter, spans.leave);
    return spans;
  }

  /// Returns the spans in one box of the lines that have their bit in `some`, as span() of each
  /// returns them.
  static LineSpanLanes spans(const FilterLine<Lanes>& lines, const Bounds& box, std::uint32_t some,
                             const Lanes& origin_errors = Lanes{}) {
    LineSpanLanes span{.enter = lanes_of(-infinity), .leave = lanes_of(infinity)};
    LaneMask steep{};
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      const Lanes& inverse = lines.inverse[i];
      const Lanes first = (box.lower[axis] - lines.origin[i]) * inverse;
      const Lanes second = (box.upper[axis] - lines.origin[i]) * inverse;
      const Lanes low = min(first, second);
      const Lanes high = max(first, second);
      const Lanes error = select(origin_errors > 0.0, origin_errors * abs(inverse), Lanes{});
      span.enter = max(span.enter, low - slack * abs(low) - error);
      span.leave = min(span.leave, high + slack * abs(high) + error);
      LaneMask is_steep = abs(inverse) > largest_inverse;
      if (any(is_steep)) {
        // A line that runs along two planes, between them, is there from minus infinity to
        // infinity, as computed above.
        const LaneMask between =
            (lines.origin[i] > box.lower[axis]) & (lines.origin[i] < box.upper[axis]);
        is_steep &= !(between & (lines.direction[i] == 0.0));
      }
      steep |= is_steep;
    }
    for (std::uint32_t left = mask_of(steep) & some; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      const Vec3 origin(lines.origin[0][i], lines.origin[1][i], lines.origin[2][i]);
      const Vec3 direction(lines.direction[0][i], lines.direction[1][i], lines.direction[2][i]);
      const LineSpan of_line = RaySlabs(origin, direction, origin_errors[i]).span(box);
      span.enter[i] = of_line.enter;
      span.leave[i] = of_line.leave;
    }
    return span;
  }

  /// Does so for one line.
  static LineSpan spans(const FilterLine<double>& line, const Bounds& box, std::uint32_t /*some*/,
                        double origin_error = 0) {
    const auto& [origin, direction] = plain_ray(line);
    if (origin_error == 0) return span(origin, direction, box);
    return RaySlabs(origin, direction, origin_error).span(box);
  }

  /// Returns the span of a line whose origin is what is meant, with the axes side by side.
  static LineSpan span(const Vec3& origin, const Vec3& direction, const Bounds& box) {
    const auto by_axis = [](const Vec3& v) { return lanes_of(v.x, v.y, v.z, v.z); };
    const Lanes inverse = 1.0 / by_axis(direction);
    if (!all(abs(inverse) <= largest_inverse)) return RaySlabs(origin, direction).span(box);
    const Lanes first = (by_axis(box.lower) - by_axis(origin)) * inverse;
    const Lanes second = (by_axis(box.upper) - by_axis(origin)) * inverse;
    const Lanes low = min(first, second);
    const Lanes high = max(first, second);
    const Lanes enter = low - slack * abs(low);
    const Lanes leave = high + slack * abs(high);
    return {.enter = std::max(std::max(enter[0], enter[1]), enter[2]),
            .leave = std::min(std::min(leave[0], leave[1]), leave[2])};
  }

 private:
  static std::array<double, 3> by_axis(const Vec3& v) { return {v.x, v.y, v.z}; }
  static double loaded(double number) { return number; }
  static Lanes loaded(const std::array<double, lane_count>& numbers) {
    return lanes_at<Lanes>(numbers.data());
  }

  /// Computes the span in one box, or in as many as a Real has lanes. Each lane has the bits that
  /// it would have alone.
  template <class Real, class Corners>
  void span_of(const Corners& lowers, const Corners& uppers, Real& enter, Real& leave) const {
    enter = broadcast<Real>(-infinity);
    leave = broadcast<Real>(infinity);
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      const Real lower = loaded(lowers[i]);
      const Real upper = loaded(uppers[i]);
      const double inverse = inverse_[axis];
      if (std::abs(inverse) > largest_inverse) {
        clip_steep(axis, lower, upper, enter, leave);
        continue;
      }
      const double error = origin_error_ * std::abs(inverse);
      clip((lower - origin_[axis]) * inverse, (upper - origin_[axis]) * inverse, error, enter,
           leave);
    }
  }

  /// Clips a span by where the line meets the planes across an axis, in either order.
  template <class Real>
  static void clip(const Real& first, const Real& second, double error, Real& enter, Real& leave) {
    const Real low = min(first, second);
    const Real high = max(first, second);
    const Real safe_low = low - slack * abs(low) - error;
    const Real safe_high = high + slack * abs(high) + error;
    // NaN, as from infinity less infinity, clips nothing.
    enter = select(safe_low > enter, safe_low, enter);
    leave = select(safe_high < leave, safe_high, leave);
  }

  template <class Real>
  void clip_steep(int axis, const Real& lower, const Real& upper, Real& enter, Real& leave) const {
    const double o = origin_[axis];
    const double d = direction_[axis];
    if (d == 0) {
      const auto beside = o < lower - origin_slack_ || o > upper + origin_slack_;
      leave = select(beside, broadcast<Real>(-std::numeric_limits<double>::infinity()), leave);
      return;
    }
    clip((lower - o) / d, (upper - o) / d, origin_error_ / std::abs(d), enter, leave);
  }

  Vec3 origin_;
  Vec3 direction_;
  Vec3 inverse_{0, 0, 0};
  double origin_error_;
  /// Rounding may have put a line that starts on the side of a box next to it by this much.
  double origin_slack_;
};

}  // namespace crt::core
