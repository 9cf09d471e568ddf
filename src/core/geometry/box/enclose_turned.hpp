// Where lines are within a box that is turned, surely.
//
// Let w be the offset from a line's origin to the middle of the box, a one of its axes and h half
// its size along that. The line is between the two planes across a from t = (a . w - h) / a . d to
// t = (a . w + h) / a . d, or the other way round. Both scalar products are off by less than 4 u of
// the sums of their terms' sizes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "core/geometry/box/enclose.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

/// A box in any position. Faces are numbered as in geometry/box/box.hpp.
struct EnclosedTurnedBox {
  Vec3 middle{0, 0, 0};
  std::array<Vec3, 3> axes;  ///< of length 1
  Vec3 half{0, 0, 0};        ///< half its size along these
  double off = 0;            ///< all of its places may be off by so much

  /// Returns a box where a placement puts it, or nothing if it is distorted there.
  template <class Placement>
  static std::optional<EnclosedTurnedBox> of(const EnclosedBox& box, const Placement& placement) {
    const double scale = placement.even_scale();
    if (!(scale > 0)) return {};
    EnclosedTurnedBox result;
    result.middle = placement.point_to_world(0.5 * box.lower + 0.5 * box.upper);
    result.half = scale * (0.5 * box.upper - 0.5 * box.lower);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 along(0);
      along[axis] = 1;
      result.axes[static_cast<std::size_t>(axis)] =
          unit_vector(placement.direction_to_world(along));
    }
    // A map that scales evenly does so but for 2^-40 of each length.
    const double size = largest_component(result.half);
    result.off = 0x1p-36 * size + 0x1p-48 * largest_component(result.middle);
    if (!has_fair_size(size) || !(result.off < size)) return {};
    return result;
  }
};

/// Encloses the part of lines in a turned box. Returns false if none of the lines that are asked
/// for comes near it; the enclosure then means nothing. Nothing is known of lines that are so flat
/// to a face that the error of a . d is not small.
template <class Real>
[[gnu::noinline]] bool enclose(const EnclosedTurnedBox& box, const FilterLine<Real>& line,
                               const MaskOf<Real>& asked, Enclosure<Real>& part) {
  using Mask = MaskOf<Real>;
  constexpr double flattest = 0x1p-30;
  const std::array<Real, 3> offset = offset_to(line, box.middle);
  const auto along = [](const Vec3& axis, const std::array<Real, 3>& v) {
    return axis.x * v[0] + axis.y * v[1] + axis.z * v[2];
  };
  const auto sum_of_sizes = [](const std::array<Real, 3>& v) {
    return abs(v[0]) + abs(v[1]) + abs(v[2]);
  };
  const Real speed = sum_of_sizes(line.direction);
  const Real off = enclosing_slack * (sum_of_sizes(offset) + 2 * largest_component(box.half)) +
                   starts_off * line.start_error + box.off;
  std::array<Enclosure<Real>, 3> slabs;
  Mask unknown{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Real rate = along(box.axes[i], line.direction);
    const Real middle = along(box.axes[i], offset);
    const double half = box.half[static_cast<int>(i)];
    unknown = unknown || !(abs(rate) > flattest * speed);
    const Real inverse = 1.0 / rate;
    const Real first = (middle - half) * inverse;
    const Real second = (middle + half) * inverse;
    const Real enter = min(first, second);
    const Real leave = max(first, second);
    const auto error_of = [&](const Real& t) {
      return (off + enclosing_slack * abs(t) * speed) * abs(inverse);
    };
    const Real enter_error = error_of(enter);
    const Real leave_error = error_of(leave);
    slabs[i] = {.enter_from = enter - enter_error,
                .enter_to = enter + enter_error,
                .leave_from = leave - leave_error,
                .leave_to = leave + leave_error};
  }
  const auto most = [&](Real Enclosure<Real>::*end) {
    return max(max(slabs[0].*end, slabs[1].*end), slabs[2].*end);
  };
  const auto least_of = [&](Real Enclosure<Real>::*end) {
    return min(min(slabs[0].*end, slabs[1].*end), slabs[2].*end);
  };
  const Real first_enter = most(&Enclosure<Real>::enter_from);
  const Real last_leave = least_of(&Enclosure<Real>::leave_to);
  const Mask misses = !unknown && first_enter > last_leave;
  if (!any(asked && !misses)) return false;
  // Next to an edge an end may be on either face, and the bound on its error may reach beyond the
  // other: its interval is that of both.
  const Real never = broadcast<Real>(std::numeric_limits<double>::infinity());
  part = {.enter_from = never,
          .enter_to = most(&Enclosure<Real>::enter_to),
          .leave_from = least_of(&Enclosure<Real>::leave_from),
          .leave_to = -never};
  for (const Enclosure<Real>& slab : slabs) {
    part.enter_from =
        min(part.enter_from, select(slab.enter_to >= first_enter, slab.enter_from, never));
    part.leave_to =
        max(part.leave_to, select(slab.leave_from <= last_leave, slab.leave_to, -never));
  }
  if (any(misses)) part.set_outside(misses);
  if (any(unknown)) part.set_unknown(unknown);
  return true;
}

/// Returns whether lines plainly come from outside to a face of a box.
template <class Real>
MaskOf<Real> starts_inwards(const EnclosedTurnedBox& box, std::uint32_t face,
                            const FilterLine<Real>& line) {
  constexpr double plainly = 0x1p-30;
  const Vec3& axis = box.axes[EnclosedBox::axis_of(face)];
  const auto& d = line.direction;
  const Real rate = axis.x * d[0] + axis.y * d[1] + axis.z * d[2];
  const Real least = plainly * (abs(d[0]) + abs(d[1]) + abs(d[2]));
  return EnclosedBox::is_upper(face) ? rate < -least : rate > least;
}

}  // namespace crt::core
