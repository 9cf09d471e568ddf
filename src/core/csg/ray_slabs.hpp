// A line against axis-parallel boxes, by slabs.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/csg/outline_line.hpp"
#include "core/geometry/bounds.hpp"
#include "core/math/lanes.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

/// The part of a line inside a box, rounded outwards; empty (enter > leave) if it misses the box.
struct LineSpan {
  double enter = 0;
  double leave = 0;

  bool empty() const { return !(enter <= leave); }
};

/// The same of several lines.
struct LineSpanLanes {
  Lanes enter;
  Lanes leave;
};

/// What of a line does not change from box to box.
class RaySlabs {
 public:
  /// Three roundings go into each t: of the difference, the inverse and the product.
  static constexpr double slack = 4 * std::numeric_limits<double>::epsilon();
  /// Above that the line is parallel to the slab, or all but, and the quotient must be taken.
  static constexpr double largest_inverse = 0x1p1000;

  /// `origin_error` is how far rounding may have put the origin from where it is meant to be: the spans hold
  /// those of all lines that may be meant.
  RaySlabs(const Vec3& origin, const Vec3& direction, double origin_error = 0)
      : origin_(origin),
        direction_(direction),
        origin_error_(origin_error),
        origin_slack_(origin_error + 4 * slack * largest_component(origin)) {
    for (int axis = 0; axis < 3; ++axis) inverse_[axis] = 1 / direction[axis];
  }

  LineSpan span(const Bounds& box) const {
    std::array<double, 1> enter;
    std::array<double, 1> leave;
    std::array<std::array<double, 1>, 3> lower;
    std::array<std::array<double, 1>, 3> upper;
    for (int axis = 0; axis < 3; ++axis) {
      lower[static_cast<std::size_t>(axis)][0] = box.lower[axis];
      upper[static_cast<std::size_t>(axis)][0] = box.upper[axis];
    }
    spans(lower, upper, enter, leave);
    return {enter[0], leave[0]};
  }

  /// The spans of lines that have their bit in `some`; origins are what is meant.
  static LineSpanLanes spans(const OutlineLine<Lanes>& lines, const Bounds& box, std::uint32_t some) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    LineSpanLanes span{.enter = lanes_of(-infinity), .leave = lanes_of(infinity)};
    LaneMask steep{};
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      const Lanes& inverse = lines.inverse[i];
      const Lanes first = (box.lower[axis] - lines.origin[i]) * inverse;
      const Lanes second = (box.upper[axis] - lines.origin[i]) * inverse;
      const Lanes low = min(first, second);
      const Lanes high = max(first, second);
      span.enter = max(span.enter, low - slack * size_of(low));
      span.leave = min(span.leave, high + slack * size_of(high));
      LaneMask is_steep = size_of(inverse) > largest_inverse;
      if (any(is_steep)) {
        // Between planes that it goes along a line is from minus infinity to infinity, as told above.
        const LaneMask between = (lines.origin[i] > box.lower[axis]) & (lines.origin[i] < box.upper[axis]);
        is_steep &= ~(between & (lines.direction[i] == 0.0));
      }
      steep |= is_steep;
    }
    for (std::uint32_t left = mask_of(steep) & some; left != 0; left &= left - 1) {
      const int i = std::countr_zero(left);
      const Vec3 origin(lines.origin[0][i], lines.origin[1][i], lines.origin[2][i]);
      const Vec3 direction(lines.direction[0][i], lines.direction[1][i], lines.direction[2][i]);
      const LineSpan of_line = RaySlabs(origin, direction).span(box);
      span.enter[i] = of_line.enter;
      span.leave[i] = of_line.leave;
    }
    return span;
  }

  /// The span of a line whose origin is what is meant, axes side by side.
  static LineSpan span(const Vec3& origin, const Vec3& direction, const Bounds& box) {
    const auto by_axis = [](const Vec3& v) { return Lanes{v.x, v.y, v.z, v.z}; };
    const Lanes inverse = 1.0 / by_axis(direction);
    if (!all(size_of(inverse) <= largest_inverse)) return RaySlabs(origin, direction).span(box);
    const Lanes first = (by_axis(box.lower) - by_axis(origin)) * inverse;
    const Lanes second = (by_axis(box.upper) - by_axis(origin)) * inverse;
    const Lanes low = min(first, second);
    const Lanes high = max(first, second);
    const Lanes enter = low - slack * size_of(low);
    const Lanes leave = high + slack * size_of(high);
    return {.enter = std::max(std::max(enter[0], enter[1]), enter[2]),
            .leave = std::min(std::min(leave[0], leave[1]), leave[2])};
  }

  /// The spans of several boxes at once, given by axis. The same bits as of each alone.
  template <std::size_t Count>
  void spans(const std::array<std::array<double, Count>, 3>& lower,
             const std::array<std::array<double, Count>, 3>& upper, std::array<double, Count>& enter,
             std::array<double, Count>& leave) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    enter.fill(-infinity);
    leave.fill(infinity);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double o = origin_[static_cast<int>(axis)];
      const double inverse = inverse_[static_cast<int>(axis)];
      if (std::abs(inverse) > largest_inverse) {
        clip_steep(static_cast<int>(axis), lower[axis], upper[axis], enter, leave);
        continue;
      }
      const double error = origin_error_ * std::abs(inverse);
      for (std::size_t i = 0; i < Count; ++i) {
        const double first = (lower[axis][i] - o) * inverse;
        const double second = (upper[axis][i] - o) * inverse;
        const double low = first < second ? first : second;
        const double high = first < second ? second : first;
        const double safe_low = low - slack * std::abs(low) - error;
        const double safe_high = high + slack * std::abs(high) + error;
        enter[i] = safe_low > enter[i] ? safe_low : enter[i];
        leave[i] = safe_high < leave[i] ? safe_high : leave[i];
      }
    }
  }

 private:
  template <std::size_t Count>
  void clip_steep(int axis, const std::array<double, Count>& lower, const std::array<double, Count>& upper,
                  std::array<double, Count>& enter, std::array<double, Count>& leave) const {
    const double o = origin_[axis];
    const double d = direction_[axis];
    for (std::size_t i = 0; i < Count; ++i) {
      if (d == 0) {
        const bool beside = o < lower[i] - origin_slack_ || o > upper[i] + origin_slack_;
        if (beside) leave[i] = -std::numeric_limits<double>::infinity();
        continue;
      }
      const double first = (lower[i] - o) / d;
      const double second = (upper[i] - o) / d;
      const double low = std::min(first, second);
      const double high = std::max(first, second);
      const double error = origin_error_ / std::abs(d);
      enter[i] = std::max(enter[i], low - slack * std::abs(low) - error);
      leave[i] = std::min(leave[i], high + slack * std::abs(high) + error);
    }
  }

  Vec3 origin_;
  Vec3 direction_;
  Vec3 inverse_{0, 0, 0};
  double origin_error_;
  /// Rounding may have put a line that starts on the side of a box next to it.
  double origin_slack_;
};

}  // namespace crt::core
