#include "core/geometry/torus/line.hpp"

#include <algorithm>

#include "core/math/power.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

template <class Real>
[[gnu::always_inline]] inline auto TorusLineOf<Real>::level(const Real& x) const -> Level {
  const Vec3Of<Real> p = point_ + x * direction_;
  const Real rho = sqrt(p.x * p.x + p.y * p.y);
  const Real outward = rho - ring_;
  const Real rho_rate = select(rho > 0.0, (p.x * direction_.x + p.y * direction_.y) / rho, Real{});
  return {.rho = rho,
          .value = on_surface_ ? value_from_start(x, p, rho)
                               : outward * outward - (tube_ - p.z) * (tube_ + p.z),
          .half_slope = outward * rho_rate + p.z * direction_.z};
}

/// Returns G(x) - G(0), computed with x as a factor.
template <class Real>
Real TorusLineOf<Real>::value_from_start(const Real& x, const Vec3Of<Real>& p,
                                         const Real& rho) const {
  const Vec3Of<Real> sum = p + point_;
  const Real rho_sum = rho + sqrt(point_.x * point_.x + point_.y * point_.y);
  const Real lateral = sum.x * direction_.x + sum.y * direction_.y;
  const Real pull = select(rho_sum > 0.0, lateral - 2 * ring_ * (lateral / rho_sum), Real{});
  return x * (pull + sum.z * direction_.z);
}

template <class Real>
Real TorusLineOf<Real>::half_curvature(const Level& here) const {
  const Real bent = squared_length_ - turning_ / (here.rho * here.rho * here.rho);
  return select(here.rho > 0.0, bent, squared_length_);
}

/// Finds the range of the line within the sphere and the slab that hold the torus, and a little
/// more. So both ends are outside whatever the rounding.
template <class Real>
auto TorusLineOf<Real>::range(const Mask& wanted, Range& result) const -> Mask {
  constexpr double margin = 1 + 0x1p-40;
  const double sphere = reach_ * margin + off_;
  const Real closest = -dot(point_, direction_) / squared_length_;
  const Vec3Of<Real> nearest = point_ + closest * direction_;
  const Real distance = sqrt(dot(nearest, nearest));
  const Mask in_sphere = wanted && distance < sphere;
  if (!any(in_sphere)) return in_sphere;
  const Real half = sqrt((sphere - distance) * (sphere + distance) / squared_length_);
  result = {closest - half, closest + half};

  const double slab = std::min(tube_, reach_) * margin + off_;
  const Mask is_flat = direction_.z == 0.0;
  const Real a = (-slab - point_.z) / direction_.z;
  const Real b = (slab - point_.z) / direction_.z;
  result.low = select(is_flat, result.low, max(result.low, min(a, b)));
  result.high = select(is_flat, result.high, min(result.high, max(a, b)));
  if (on_surface_) {
    result.low = min(result.low, Real{});
    result.high = max(result.high, Real{});
  }
  const Mask in_slab = direction_.z != 0.0 || abs(point_.z) < slab;
  return in_sphere && in_slab && result.low < result.high;
}

/// Returns the range where rho'' > a / R, that is rho^3 < R D / a, or an empty range at the end of
/// `range` if there is none.
template <class Real>
auto TorusLineOf<Real>::concave_part(const Range& range) const -> Range {
  const Real lateral_speed = direction_.x * direction_.x + direction_.y * direction_.y;
  const Mask is_lateral = lateral_speed > 0.0;
  const Real middle = -(point_.x * direction_.x + point_.y * direction_.y) / lateral_speed;
  const Real passing_distance = passing_ / sqrt(lateral_speed);
  const Real cube = turning_ / squared_length_;
  // Most lines pass the axis nearer or farther than that by more than any rounding.
  constexpr double plainly = 1 - 0x1p-40;
  constexpr double smallest = 0x1p-300;
  const Mask passes_by = passing_distance > smallest &&
                         cube < plainly * (passing_distance * passing_distance * passing_distance);
  const Real inflection = any(is_lateral && !passes_by) ? cube_root(cube) : Real{};
  const Mask bends = inflection > passing_distance;
  const Real square =
      (inflection - passing_distance) * (inflection + passing_distance) / lateral_speed;
  const Real half = select(bends, sqrt(square), Real{});
  const Mask somewhere = is_lateral && !(passing_ > 0.0 && !bends);
  return {select(somewhere, clamp(middle - half, range.low, range.high), range.high),
          select(somewhere, clamp(middle + half, range.low, range.high), range.high)};
}

/// Returns the error of G at x. The gradient of G is twice the distance from the ring.
template <class Real>
Real TorusLineOf<Real>::value_error(const Real& x) const {
  if (off_ == 0) return Real{};
  const Vec3Of<Real> p = point_ + x * direction_;
  const Real outward = sqrt(p.x * p.x + p.y * p.y) - ring_;
  return 2 * off_ * (abs(outward) + abs(p.z) + tube_ + off_);
}

template <class Real>
Real TorusLineOf<Real>::slope_error() const {
  return 4 * off_ * sqrt(squared_length_);
}

/// Returns how far above 0 a tangent must stay to show that all of a part of this length is above
/// 0.
template <class Real>
Real TorusLineOf<Real>::margin(const Real& value_error, const Real& length) const {
  return off_ > 0 ? value_error + slope_error() * length + inflection_error_ : Real{};
}

/// Finds a point inside in the convex part between a point outside and the concave part, if there
/// is one.
template <class Real>
auto TorusLineOf<Real>::find_dip(const Real& outer, const Real& inner, const Mask& wanted) const
    -> Search {
  const Mask has_part = wanted && outer != inner;
  Search result{.certain = wanted && !has_part};
  if (!any(has_part)) return result;
  const Level here = level(inner);
  const Real error = value_error(inner);
  result.x = inner;
  result.level = here;
  result.found = has_part && here.value < -error;
  result.certain = result.certain || result.found;
  Mask open = has_part && !result.found;
  if (!any(open)) return result;
  // If G increases from here outwards, it does so up to the outer end. Next to the axis the slope
  // is not known.
  constexpr double next_to_axis = 0x1p-20;
  const Real rise = select(outer < inner, -here.half_slope, here.half_slope);
  const Mask rises = rise >= 0.0 && here.rho > next_to_axis;
  const Mask is_outside = rises && here.value >= margin(error, abs(inner - outer));
  result.certain = result.certain || (open && is_outside);
  open = open && !is_outside;
  if (!any(open)) return result;
  const Search within = find_sign(min(outer, inner), max(outer, inner), 1, open);
  return {.x = select(open, within.x, result.x),
          .found = select(open, within.found, result.found),
          .certain = select(open, within.certain, result.certain),
          .level = Level::chosen(open, within.level, result.level)};
}

/// Finds a point where sign * G is negative, if there is one, in a part where it is convex, and not
/// negative at the ends. Newton's iteration looks for the minimum between bounds. It stops when the
/// tangents show that all is positive.
template <class Real>
auto TorusLineOf<Real>::find_sign(const Real& from, const Real& to, double sign,
                                  const Mask& wanted) const -> Search {
  constexpr int most_steps = 200;
  const Real length = to - from;
  Real low = from;
  Real high = to;
  Search result{.x = low + length / 2.0};
  Mask active = wanted;
  for (int step = 0; step < most_steps; ++step) {
    const Real x = result.x;
    active = active && low < x && x < high;
    if (!any(active)) break;
    const Level here = level(x);
    const Real height = sign * here.value;
    const Real error = value_error(x);
    const Mask is_found = active && height < -error;
    result.level = Level::chosen(is_found, here, result.level);
    result.found = result.found || is_found;
    result.certain = result.certain || is_found;
    active = active && !is_found;
    if (!any(active)) break;

    const Real slope = 2.0 * sign * here.half_slope;
    const Mask upwards = slope > 0.0;
    const Mask is_level = slope == 0.0;
    const Real farthest = select(upwards, x - low, high - x);
    const Real open = margin(error, high - low);
    const Mask is_none = select(is_level, height > open, height - abs(slope) * farthest > open);
    result.certain = result.certain || (active && is_none);
    active = active && !(is_none || is_level);
    if (!any(active)) break;

    low = select(upwards, low, x);
    high = select(upwards, x, high);
    const Real curvature = 2.0 * sign * half_curvature(here);
    const Real next = x - slope / curvature;
    const bool shrinks =
        step % 4 != 3;  // every fourth step halves, so that the bounds close in from both sides
    const Mask by_newton = curvature > 0.0 && next > low && next < high;
    const Real middle = low + (high - low) / 2.0;
    const Real onwards = select(shrinks, select(by_newton, next, middle), middle);
    result.x = select(active, onwards, x);
  }
  return result;
}

/// Returns where the parabola that osculates G at the bracket's inner end is 0, or the outer end if
/// that is not in between.
template <class Real>
Real TorusLineOf<Real>::first_guess(const Bracket& bracket) const {
  const Real step = bracket.positive - bracket.negative;
  const Level& inside = bracket.inside;
  // `onwards` is half the slope of the parabola on the step.
  const Real bend = half_curvature(inside);
  const Mask backwards = step < 0.0;
  const Real onwards = select(backwards, -inside.half_slope, inside.half_slope);
  const Real root = sqrt(onwards * onwards - bend * inside.value);
  const Mask is_uphill = onwards > 0.0;
  const Real length =
      select(is_uphill, -inside.value, root - onwards) / select(is_uphill, onwards + root, bend);
  const Mask is_within = length > 0.0 && length < abs(step);
  return select(is_within, bracket.negative + select(backwards, -length, length), bracket.positive);
}

/// Returns whether a step of Newton's iteration leaves less of G than its rounding. However the
/// line slants, at most the step's square times the largest |G'' / 2| on the step is left. With the
/// root at the start divided out, |G'(x) / x| adds to that factor.
template <class Real>
auto TorusLineOf<Real>::is_last_step(const Real& x, const Level& from, const Real& step) const
    -> Mask {
  const double rounding = unit_roundoff * tube_ * (std::abs(ring_) + tube_);
  const Real cube = from.rho * from.rho * from.rho;
  const Real bend = squared_length_ + abs(turning_) / cube +
                    (on_surface_ ? Real(abs(2.0 * from.half_slope / x)) : Real{});
  // The step is so short that the distance from the axis shrinks by no more than a fourth, and its
  // cube to no less than a third.
  constexpr double change_of_bend = 3;
  const Mask is_near = 16.0 * squared_length_ * step * step < from.rho * from.rho;
  return is_near && change_of_bend * bend * step * step < rounding;
}

/// Finds the root by Newton's iteration. Bisection replaces steps that would leave the bounds or
/// that are more than half of the last but one.
template <class Real>
Real TorusLineOf<Real>::root(const Bracket& bracket, const Mask& wanted) const {
  Real negative = bracket.negative;
  Real positive = bracket.positive;
  Mask active = wanted;
  Real x = first_guess(bracket);
  if (on_surface_) {
    const Mask at_start = min(negative, positive) <= 0.0 && max(negative, positive) >= 0.0;
    x = select(at_start, Real{}, x);
    active = active && !at_start;
  }
  constexpr int most_steps = 200;
  Real step = abs(positive - negative);
  Real step_before = step;
  for (int steps = 0; steps < most_steps && any(active); ++steps) {
    const Level here = level(x);
    const Real height = here.value;
    const Mask is_there = height == 0.0;
    const Mask is_below = height < 0.0;
    negative = select(is_below, x, negative);
    positive = select(is_below, positive, x);
    // With the known root divided out, its slope is divided out, too: G = x H, H' = (G' - H) / x.
    const Real slope = 2.0 * here.half_slope;
    const Real change = height / (on_surface_ ? Real(slope - height / x) : slope);
    const Real next = x - change;
    const Real low = min(negative, positive);
    const Real high = max(negative, positive);
    const Mask is_last = is_last_step(x, here, change);
    const Mask is_found = active && (is_there || is_last);
    const Real from = x;
    x = select(is_found, select(is_there, from, clamp(next, low, high)), from);
    active = active && !is_found;
    if (!any(active)) break;

    const Mask halves = low < next && next < high && abs(change) <= step_before / 2.0;
    const Real onwards = select(halves, next, low + (high - low) / 2.0);
    step_before = step;
    step = abs(onwards - from);
    x = select(active, onwards, x);
    active = active && !(onwards == from || onwards == low || onwards == high);
  }
  return x;
}

template <class Real>
auto TorusLineOf<Real>::first_entry(const Mask& wanted) const -> Entry {
  Range whole;
  const Mask comes_near = range(wanted, whole);
  if (!any(comes_near)) return {};
  const Range concave = concave_part(whole);
  const Search first = find_dip(whole.low, concave.low, comes_near);
  const Mask rest = comes_near && !first.found;
  if (!any(rest)) return {first.found, {first.x, whole.low, first.level}};
  const Search second = find_dip(whole.high, concave.high, rest);
  return {first.found || second.found,
          {select(first.found, first.x, second.x), select(first.found, whole.low, concave.low),
           Level::chosen(first.found, first.level, second.level)}};
}

/// The last span ends after the last point that is found to be inside. If that point is not ahead
/// of the start, the span ends at the start or before it.
template <class Real>
auto TorusLineOf<Real>::reenters(const Mask& wanted) const -> Mask {
  Range whole;
  const Mask comes_near = range(wanted, whole);
  if (!any(comes_near)) return comes_near;
  const Range concave = concave_part(whole);
  const Search last = find_dip(whole.high, concave.high, comes_near);
  const Mask ahead = last.found && last.x > 0.0;
  const Mask rest = comes_near && !last.found;
  if (!any(rest)) return ahead;
  const Search first = find_dip(whole.low, concave.low, rest);
  return ahead || (first.found && first.x > 0.0);
}

template class TorusLineOf<double>;
template class TorusLineOf<Lanes>;

}  // namespace crt::core
