// Where lines are within a cylinder or a cone, surely; and where they surely pass by something
// long.
//
// Notation as in frustum.hpp: r is the narrower radius and R the wider one, H the height, alpha the
// angle of the side to the axis. Let w be the offset from a line's origin to the middle of the
// narrower end, and x the distance along the line. There the line is at the height z = z0 + z1 x,
// at P + M x across the axis, and s = s0 + s1 x = cos(alpha) r + sin(alpha) z. With
//    G(x) = cos(alpha)^2 |P + M x|^2 - s^2 = a x^2 - 2 b x + c
// it is inside where G < 0 and 0 < z < H. Next to the side G is 2 s times the distance from it.
//
// All that matters is at |x| <= L = |w| + R + H. Roundings here, 6 u (|w| + |x|) of a place, and
// 8 u (|w| + |x|)^2 of G for those of a, b and c, change G by less than 150 u L^2 there. Those of
// an exact test do as if the line were moved by e = 8 u (R + H), which changes G by 4 R e. For the
// bounds on the errors of its crossings are e s / sqrt(b^2 - a c) at most, and sqrt(2 e R / a) if
// a > 0. A line that is off by d for other reasons, as is one whose start rounding has put off a
// surface, changes G by less than (4 R + 2 d) d. So with
//    M = 2048 u L^2 + (4 R + 2 d) d
// it surely is outside of the side where G > M and inside where G < -M. Nor does it matter if 2^-50
// takes the place of a smaller |a|, so that no line is parallel to the axis or to a ruling.
//
// The roots of G = M are as precise as their last bits, one by one: they may be far apart. With q =
// sqrt(b^2 - a (c - M)), those of G = -M are beyond them by less than 2 M / q. Where they are far
// from the solid it does not matter where. If a > 0 all places between the roots that are between
// the caps are on the nappe of the solid. If a < 0 one root is. The line is inside on its far side,
// as long as the other root is plainly beyond the apex; else nothing is known.
//
// Heights are off by less than E = 1024 u L + d in the same way. What the exact tests say of lines
// along the caps is as good: they know the rate in twice the digits.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "core/math/lanes.hpp"
#include "core/math/vector.hpp"
#include "core/ray/enclosure.hpp"

namespace crt::core {

/// A cylinder or a cone with its caps.
struct EnclosedFrustum {
  Vec3 narrow{0, 0, 0};  ///< the middle of the narrower end
  Vec3 axis{0, 0, 0};    ///< unit length, to the wider end
  double height = 0;
  double narrow_radius = 0;
  double wide_radius = 0;
  double cosine = 1;  ///< of the side's angle to the axis
  double sine = 0;
  double off = 0;               ///< all of its places may be off by so much
  std::uint32_t wide_face = 0;  ///< the number of the cap at the wider end

  static constexpr std::uint32_t side_face = 0;

  double size() const { return wide_radius + height; }

  /// Returns it where a placement puts it, or nothing if it is of no fair size there or is
  /// distorted.
  template <class Placement>
  std::optional<EnclosedFrustum> placed(const Placement& placement) const;
};

template <class Placement>
std::optional<EnclosedFrustum> EnclosedFrustum::placed(const Placement& placement) const {
  EnclosedFrustum result = *this;
  if (const std::optional<Vec3> place = placement.exactly_to_world(narrow)) {
    result.narrow = *place;
  } else {
    const double scale = placement.even_scale();
    if (!(scale > 0)) return {};
    result.narrow = placement.point_to_world(narrow);
    result.axis = unit_vector(placement.direction_to_world(axis));
    result.height *= scale;
    result.narrow_radius *= scale;
    result.wide_radius *= scale;
    // A map that scales evenly does so but for 2^-40 of each length.
    result.off = 0x1p-36 * result.size() + 0x1p-50 * largest_component(result.narrow);
  }
  if (!has_fair_size(result.wide_radius) || !has_fair_size(result.height)) return {};
  return result;
}

/// What a line is to a frustum, in the notation above.
template <class Real>
struct FrustumPass {
  Real height;         ///< z0
  Real climb;          ///< z1
  Real a, b, c;        ///< of G
  Real margin;         ///< M
  Real height_margin;  ///< E

  FrustumPass(const EnclosedFrustum& frustum, const FilterLine<Real>& line);
};

template <class Real>
[[gnu::always_inline]] inline FrustumPass<Real>::FrustumPass(const EnclosedFrustum& frustum,
                                                             const FilterLine<Real>& line) {
  const std::array<Real, 3> offset = offset_to(line, frustum.narrow);
  const std::array<Real, 3> axis = {broadcast<Real>(frustum.axis.x),
                                    broadcast<Real>(frustum.axis.y),
                                    broadcast<Real>(frustum.axis.z)};
  const auto scaled = [](const std::array<Real, 3>& v, const Real& factor) {
    return std::array<Real, 3>{v[0] * factor, v[1] * factor, v[2] * factor};
  };
  const auto across_axis = [&](const std::array<Real, 3>& v, const Real& along) {
    return std::array<Real, 3>{multiply_add(-along, axis[0], v[0]),
                               multiply_add(-along, axis[1], v[1]),
                               multiply_add(-along, axis[2], v[2])};
  };
  const std::array<Real, 3> direction = scaled(line.direction, line.inverse_length);
  climb = fused_dot(direction, axis);
  const Real down = fused_dot(offset, axis);
  height = -down;
  const std::array<Real, 3> to_axis = across_axis(offset, down);  // -P
  const std::array<Real, 3> across = across_axis(direction, climb);
  const double squared_cosine = frustum.cosine * frustum.cosine;
  const Real radius = frustum.cosine * frustum.narrow_radius - frustum.sine * down;
  const Real rate = frustum.sine * climb;
  constexpr double flattest = 0x1p-50;
  const Real opening = squared_cosine * fused_dot(across, across) - rate * rate;
  a = select(abs(opening) < flattest, broadcast<Real>(flattest), opening);
  b = squared_cosine * fused_dot(to_axis, across) + radius * rate;
  c = squared_cosine * fused_dot(to_axis, to_axis) - radius * radius;
  const Real reach = abs(offset[0]) + abs(offset[1]) + abs(offset[2]) + frustum.size();
  const Real off = starts_off * line.start_error + frustum.off;
  margin = (4 * enclosing_slack) * reach * reach + (4 * frustum.wide_radius + 2.0 * off) * off;
  height_margin = (2 * enclosing_slack) * reach + off;
}

/// Encloses the part of lines between the caps of a frustum, by distance. Nothing is known of
/// `unknown` lines, which run along a cap.
template <class Real>
[[gnu::always_inline]] inline Enclosure<Real> between_caps(const EnclosedFrustum& frustum,
                                                           const FrustumPass<Real>& pass,
                                                           MaskOf<Real>& misses,
                                                           MaskOf<Real>& unknown) {
  constexpr double flattest = 0x1p-50;
  const Real& margin = pass.height_margin;
  const MaskOf<Real> level = abs(pass.climb) < flattest;
  const Real inverse = 1.0 / select(level, broadcast<Real>(1), pass.climb);
  const Real narrow = -pass.height * inverse;
  const Real wide = (frustum.height - pass.height) * inverse;
  Real enter = min(narrow, wide);
  Real leave = max(narrow, wide);
  Real more = margin * abs(inverse);
  if (any(level)) {
    const Real above = pass.height - frustum.height;
    const MaskOf<Real> beside = level && (pass.height < -margin || above > margin);
    misses = misses || beside;
    unknown = unknown || (level && !beside && !(pass.height > margin && above < -margin));
    enter = select(level, broadcast<Real>(-far_away), enter);
    leave = select(level, broadcast<Real>(far_away), leave);
    more = select(level, Real{}, more);
  }
  const Real enter_error = more + enclosing_slack * abs(enter);
  const Real leave_error = more + enclosing_slack * abs(leave);
  return {.enter_from = enter - enter_error,
          .enter_to = enter + enter_error,
          .leave_from = leave - leave_error,
          .leave_to = leave + leave_error};
}

/// Encloses the part of lines on the inner side of a frustum's side, by distance, where they are
/// between the caps. `discriminant` is that of G = M.
template <class Real>
[[gnu::always_inline]] inline Enclosure<Real> within_side(const FrustumPass<Real>& pass,
                                                          const Real& discriminant,
                                                          MaskOf<Real>& unknown) {
  const Real root = sqrt(max(discriminant, Real{}));
  const Real sum = select(pass.b >= 0.0, pass.b + root, pass.b - root);
  const Real first = sum / pass.a;
  const Real second = (pass.c - pass.margin) / sum;
  const Real enter = min(first, second);
  const Real leave = max(first, second);
  const Real deeper = 2.0 * pass.margin * inverse_or_more(root);
  const auto error_of = [](const Real& x) { return enclosing_slack * abs(x); };
  Enclosure<Real> part{.enter_from = enter - error_of(enter),
                       .enter_to = enter + deeper + error_of(enter),
                       .leave_from = leave - deeper - error_of(leave),
                       .leave_to = leave + error_of(leave)};
  const MaskOf<Real> steep = pass.a < 0.0;
  if (!any(steep)) return part;
  const Real never = broadcast<Real>(far_away);
  const MaskOf<Real> climbs = pass.climb > 0.0;
  const Real other = select(climbs, enter, leave);
  const Real least = pass.height_margin + error_of(other);
  const MaskOf<Real> is_beyond = discriminant > 0.0 && pass.height + pass.climb * other < -least;
  unknown = unknown || (steep && !is_beyond);
  const Enclosure<Real> of_steep{
      .enter_from = select(climbs, leave - error_of(leave), -never),
      .enter_to = select(climbs, leave + deeper + error_of(leave), -never),
      .leave_from = select(climbs, never, enter - deeper - error_of(enter)),
      .leave_to = select(climbs, never, enter + error_of(enter))};
  return {.enter_from = select(steep, of_steep.enter_from, part.enter_from),
          .enter_to = select(steep, of_steep.enter_to, part.enter_to),
          .leave_from = select(steep, of_steep.leave_from, part.leave_from),
          .leave_to = select(steep, of_steep.leave_to, part.leave_to)};
}

/// Encloses the part of lines in a cylinder or cone. Returns false if none of the lines that are
/// asked for comes near it; the enclosure then means nothing.
template <class Real>
[[gnu::noinline]] bool enclose(const EnclosedFrustum& frustum, const FilterLine<Real>& line,
                               const MaskOf<Real>& asked, Enclosure<Real>& part) {
  using Mask = MaskOf<Real>;
  const FrustumPass<Real> pass(frustum, line);
  const Real discriminant = difference_of_products(pass.b, pass.b, pass.a, pass.c - pass.margin);
  Mask misses = pass.a > 0.0 && discriminant < 0.0;
  if (!any(asked && !misses)) return false;
  constexpr double largest = 0x1p900;
  Mask unknown = !(pass.margin < largest);
  const Enclosure<Real> caps = between_caps(frustum, pass, misses, unknown);
  const Enclosure<Real> side = within_side(pass, discriminant, unknown);
  misses = misses ||
           (!unknown && max(caps.enter_from, side.enter_from) > min(caps.leave_to, side.leave_to));
  if (!any(asked && !misses)) return false;
  // Next to a rim an end may be on either face, and the bound on its error may reach beyond the
  // other: its interval is that of both.
  const Mask enters_apart = side.enter_from > caps.enter_to || caps.enter_from > side.enter_to;
  const Mask leaves_apart = side.leave_from > caps.leave_to || caps.leave_from > side.leave_to;
  const Real enter_from = select(enters_apart, max(caps.enter_from, side.enter_from),
                                 min(caps.enter_from, side.enter_from));
  const Real leave_to =
      select(leaves_apart, min(caps.leave_to, side.leave_to), max(caps.leave_to, side.leave_to));
  const Real& inverse = line.inverse_length;
  part = {.enter_from = enter_from * inverse,
          .enter_to = max(caps.enter_to, side.enter_to) * inverse,
          .leave_from = min(caps.leave_from, side.leave_from) * inverse,
          .leave_to = leave_to * inverse};
  if (any(misses)) part.set_outside(misses);
  unknown = unknown && !misses;
  if (any(unknown)) part.set_unknown(unknown);
  return true;
}

/// Returns whether lines that start on a face, and to its inner side, come into a frustum there:
/// they start on its surface but for what rounding makes of 0, and plainly inwards on a cap.
template <class Real>
[[gnu::noinline]] MaskOf<Real> starts_inwards(const EnclosedFrustum& frustum, std::uint32_t face,
                                              const FilterLine<Real>& line) {
  constexpr double share_of_start = 0x1p-4;
  constexpr double plainly = 0x1p-40;
  const FrustumPass<Real> pass(frustum, line);
  if (face == EnclosedFrustum::side_face) return abs(pass.c) < share_of_start * pass.margin;
  const bool is_wide = face == frustum.wide_face;
  const Real above = is_wide ? pass.height - frustum.height : pass.height;
  const Real inwards = is_wide ? -pass.climb : pass.climb;
  return inwards > plainly && abs(above) < share_of_start * pass.height_margin;
}

/// A cylinder without ends. What it encloses is somewhere in it.
struct EndlessCylinder {
  Vec3 place{0, 0, 0};  ///< a point of the axis
  Vec3 axis{0, 0, 0};   ///< unit length
  double radius = 0;
};

/// Returns false if none of the lines that are asked for comes into an endless cylinder. Of the
/// others nothing is known.
///
/// With m = d x n for the axis n, the two lines are |w . m| / |m| apart. Roundings change w . m and
/// r |m| by less than 16 u (|w| + r) |d|; and whatever they make of the axis, it passes the
/// cylinder as near as the radius says.
template <class Real>
bool enclose(const EndlessCylinder& cylinder, const FilterLine<Real>& line,
             const MaskOf<Real>& asked, Enclosure<Real>& part) {
  const std::array<Real, 3> offset = offset_to(line, cylinder.place);
  const std::array<Real, 3>& d = line.direction;
  const Vec3& n = cylinder.axis;
  const std::array<Real, 3> across = {d[1] * n.z - d[2] * n.y, d[2] * n.x - d[0] * n.z,
                                      d[0] * n.y - d[1] * n.x};
  const Real speed = line.squared_length * line.inverse_length;
  const Real error = enclosing_slack *
                     (abs(offset[0]) + abs(offset[1]) + abs(offset[2]) + cylinder.radius) * speed;
  const Real distance = abs(dot(offset, across)) - error;
  const double squared_radius = cylinder.radius * cylinder.radius;
  const MaskOf<Real> misses =
      distance > 0.0 && distance * distance > squared_radius * dot(across, across);
  if (!any(asked && !misses)) return false;
  const Real nothing_known = broadcast<Real>(std::numeric_limits<double>::quiet_NaN());
  part = {nothing_known, nothing_known, nothing_known, nothing_known};
  if (any(misses)) part.set_outside(misses);
  return true;
}

}  // namespace crt::core
