#include "core/geometry/torus_line.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/vector.hpp"

namespace crt::core {

TorusLine::TorusLine(const Vec3& point, const Vec3& direction, double ring, double tube, bool on_surface)
    : point_(point),
      direction_(direction),
      ring_(ring),
      tube_(tube),
      squared_speed_(glm::dot(direction, direction)),
      passing_(std::abs(difference_of_products(point.x, direction.y, point.y, direction.x))),
      turning_(ring * passing_ * passing_),
      on_surface_(on_surface) {}

TorusLine::Level TorusLine::level(double x) const {
  const Vec3 p = point_ + x * direction_;
  const double rho = std::sqrt(p.x * p.x + p.y * p.y);
  const double outward = rho - ring_;
  const double rho_rate = rho > 0 ? (p.x * direction_.x + p.y * direction_.y) / rho : 0;
  return {
      .rho = rho,
      .value = on_surface_ ? value_from_start(x, p, rho) : outward * outward - (tube_ - p.z) * (tube_ + p.z),
      .half_slope = outward * rho_rate + p.z * direction_.z};
}

/// G(x) - G(0) with x as a factor.
double TorusLine::value_from_start(double x, const Vec3& p, double rho) const {
  const Vec3 sum = p + point_;
  const double rho_sum = rho + std::sqrt(point_.x * point_.x + point_.y * point_.y);
  const double lateral = sum.x * direction_.x + sum.y * direction_.y;
  const double pull = rho_sum > 0 ? lateral - 2 * ring_ * (lateral / rho_sum) : 0;
  return x * (pull + sum.z * direction_.z);
}

double TorusLine::level_at_start() const {
  const double outward = std::sqrt(point_.x * point_.x + point_.y * point_.y) - ring_;
  return outward * outward - (tube_ - point_.z) * (tube_ + point_.z);
}

double TorusLine::half_curvature(const Level& here) const {
  if (!(here.rho > 0)) return squared_speed_;
  return squared_speed_ - turning_ / (here.rho * here.rho * here.rho);
}

/// Where the line can be inside: within the ball and the slab that hold the torus, and a little more,
/// so that both ends are outside whatever the rounding.
std::optional<TorusLine::Range> TorusLine::range() const {
  constexpr double margin = 1 + 0x1p-40;
  const double ball = (ring_ + tube_) * margin + off_;
  const double closest = -glm::dot(point_, direction_) / squared_speed_;
  const double distance = glm::length(point_ + closest * direction_);
  if (!(distance < ball)) return std::nullopt;
  const double half = std::sqrt((ball - distance) * (ball + distance) / squared_speed_);
  Range result{closest - half, closest + half};

  const double slab = tube_ * margin + off_;
  if (direction_.z != 0) {
    const double a = (-slab - point_.z) / direction_.z;
    const double b = (slab - point_.z) / direction_.z;
    result.low = std::max(result.low, std::min(a, b));
    result.high = std::min(result.high, std::max(a, b));
  } else if (!(std::abs(point_.z) < slab)) {
    return std::nullopt;
  }
  if (on_surface_) {
    result.low = std::min(result.low, 0.0);
    result.high = std::max(result.high, 0.0);
  }
  if (!(result.low < result.high)) return std::nullopt;
  return result;
}

/// Where rho'' > a / R, that is rho^3 < R D / a; an empty range at its middle if nowhere.
TorusLine::Range TorusLine::concave_part(const Range& range) const {
  const double lateral_speed = direction_.x * direction_.x + direction_.y * direction_.y;
  if (!(lateral_speed > 0)) return {range.high, range.high};
  const double middle = -(point_.x * direction_.x + point_.y * direction_.y) / lateral_speed;
  const double inflection = std::cbrt(turning_ / squared_speed_);
  const double passing_distance = passing_ / std::sqrt(lateral_speed);
  double half = 0;
  if (inflection > passing_distance) {
    half = std::sqrt((inflection - passing_distance) * (inflection + passing_distance) / lateral_speed);
  } else if (passing_ > 0) {
    return {range.high, range.high};
  }
  return {std::clamp(middle - half, range.low, range.high), std::clamp(middle + half, range.low, range.high)};
}

/// The gradient of G is twice the distance from the ring.
double TorusLine::value_error(double x) const {
  if (off_ == 0) return 0;
  const Vec3 p = point_ + x * direction_;
  const double outward = std::sqrt(p.x * p.x + p.y * p.y) - ring_;
  return 2 * off_ * (std::abs(outward) + std::abs(p.z) + tube_ + off_);
}

double TorusLine::slope_error() const {
  return 4 * off_ * std::sqrt(squared_speed_);
}

/// How far above 0 a tangent must stay to show that all of a part of this length is.
double TorusLine::margin(double value_error, double length) const {
  return off_ > 0 ? value_error + slope_error() * length + inflection_error_ : 0;
}

/// Where G turns from convex to concave is known only so well, and between there and where it is taken to
/// turn it may lie below its tangents: by the change of slope times the way. The slope of rho changes by no
/// more than twice the lateral speed, and next to the point of inflection by its third derivative times the
/// way squared.
double TorusLine::inflection_error(const Range& concave) const {
  const double lateral_speed = direction_.x * direction_.x + direction_.y * direction_.y;
  if (off_ == 0 || !(lateral_speed > 0)) return 0;
  const double speed = std::sqrt(lateral_speed);
  const double size = ring_ + tube_;
  const double passing_error = off_ * (speed + size * std::sqrt(squared_speed_));
  const double largest_passing = passing_ + passing_error;
  const double inflection = std::cbrt(ring_ * largest_passing * largest_passing / squared_speed_);
  const double inflection_off = inflection * std::min(1.0, passing_error / largest_passing);
  const double passing_distance = largest_passing / speed;
  const double square_off =
      2 * (inflection * inflection_off + passing_distance * passing_error / speed) / lateral_speed;
  const double half = (concave.high - concave.low) / 2;
  const double half_off = std::min(std::sqrt(square_off), square_off / half);
  const double way = speed * half_off + 2 * off_ * (1 + size);
  const double bend = 6 * way / (passing_ / speed);
  return ring_ * way * std::min(4.0, bend * bend);
}

/// In the convex part between a point outside and the concave part: a point inside, if there is one.
TorusLine::Search TorusLine::find_dip(double outer, double inner) const {
  if (outer == inner) return {};
  const Level here = level(inner);
  const double error = value_error(inner);
  if (here.value < -error) return {inner};
  // If G rises from here on, it rises all the way out. Next to the axis the slope is not known.
  constexpr double next_to_axis = 0x1p-20;
  const double rise = outer < inner ? -here.half_slope : here.half_slope;
  const bool rises = rise >= 0 && here.rho > next_to_axis;
  if (rises && here.value >= margin(error, std::abs(inner - outer))) return {};
  return find_sign(std::min(outer, inner), std::max(outer, inner), 1);
}

/// In the concave part: a point outside, if there is one.
TorusLine::Search TorusLine::find_rise(double low, double high) const {
  if (level(low).value > value_error(low)) return {low};
  if (level(high).value > value_error(high)) return {high};
  if (!(low < high)) return {std::nullopt, level(low).value < -value_error(low)};
  return find_sign(low, high, -1);
}

/// In a part where sign * G is convex, and not negative at its ends: a point where it is negative, if there
/// is one. Newton's iteration for the minimum, kept between bounds; it stops when the tangents show that all
/// is positive.
TorusLine::Search TorusLine::find_sign(double low, double high, double sign) const {
  constexpr int most_steps = 200;
  double x = low + (high - low) / 2;
  for (int step = 0; step < most_steps && low < x && x < high; ++step) {
    const Level here = level(x);
    const double height = sign * here.value;
    const double error = value_error(x);
    if (height < -error) return {x};
    const double slope = 2 * sign * here.half_slope;
    const double farthest = slope > 0 ? x - low : high - x;
    const double open = margin(error, high - low);
    if (slope == 0) return {std::nullopt, height > open};
    if (height - std::abs(slope) * farthest > open) return {};
    (slope > 0 ? high : low) = x;
    const double curvature = 2 * sign * half_curvature(here);
    const double next = x - slope / curvature;
    const bool shrinks = step % 4 != 3;  // now and then halve, so that the bounds close in from both sides
    x = shrinks && curvature > 0 && low < next && next < high ? next : low + (high - low) / 2;
  }
  return {std::nullopt, false};
}

/// Where the parabola that osculates G at the bracket's inner end is 0; the outer end if that is not in
/// between.
double TorusLine::first_guess(const Bracket& bracket) const {
  const double way = bracket.positive - bracket.negative;
  const Level inside = level(bracket.negative);
  // `onwards` is half its slope on the way.
  const double bend = half_curvature(inside);
  const double onwards = way < 0 ? -inside.half_slope : inside.half_slope;
  const double root = std::sqrt(onwards * onwards - bend * inside.value);
  const double length = onwards > 0 ? -inside.value / (onwards + root) : (root - onwards) / bend;
  const bool is_within = 0 < length && length < std::abs(way);
  return is_within ? bracket.negative + std::copysign(length, way) : bracket.positive;
}

/// Whether a step of Newton's leaves G at less than what its rounding is anyway. However the line slants,
/// what is left is no more than the step's square times the largest |G'' / 2| on the way; with the root at
/// the start divided out, G'(x) / x more.
bool TorusLine::is_last_step(double x, const Level& from, double step) const {
  const double rounding = unit_roundoff * tube_ * (ring_ + tube_);
  const double cube = from.rho * from.rho * from.rho;
  const double bend =
      squared_speed_ + turning_ / cube + (on_surface_ ? std::abs(2 * from.half_slope / x) : 0);
  // Near enough that the distance from the axis does not shrink by more than a fourth, its cube to less than
  // a third.
  constexpr double change_of_bend = 3;
  const bool is_near = 16 * squared_speed_ * step * step < from.rho * from.rho;
  return is_near && change_of_bend * bend * step * step < rounding;
}

/// Newton, and bisection where it would leave the bounds or does not at least halve its steps, each beside
/// the last but one.
double TorusLine::root(const Bracket& bracket) const {
  double negative = bracket.negative;
  double positive = bracket.positive;
  if (on_surface_ && std::min(negative, positive) <= 0 && std::max(negative, positive) >= 0) return 0;
  constexpr int most_steps = 200;
  double x = first_guess(bracket);
  double step = std::abs(positive - negative);
  double step_before = step;
  for (int steps = 0; steps < most_steps; ++steps) {
    const Level here = level(x);
    const double height = here.value;
    if (height == 0) return x;
    (height < 0 ? negative : positive) = x;
    // With the known root divided out, so is its slope: G = x H, H' = (G' - H) / x.
    const double slope = 2 * here.half_slope;
    const double change = on_surface_ ? height / (slope - height / x) : height / slope;
    double next = x - change;
    const double low = std::min(negative, positive);
    const double high = std::max(negative, positive);
    if (is_last_step(x, here, change)) return std::clamp(next, low, high);
    const bool halves = low < next && next < high && std::abs(change) <= step_before / 2;
    if (!halves) next = low + (high - low) / 2;
    step_before = step;
    step = std::abs(next - x);
    if (next == x || next == low || next == high) return next;
    x = next;
  }
  return x;
}

/// The root; anywhere between its bounds if both are before `begin`.
double TorusLine::place(const Bracket& bracket, double begin) const {
  const bool is_before = std::max(bracket.negative, bracket.positive) < begin;
  return is_before ? bracket.negative + (bracket.positive - bracket.negative) / 2 : root(bracket);
}

TorusLine::Stretches TorusLine::stretches() {
  Stretches result;
  const std::optional<Range> whole = range();
  if (!whole) return result;
  const Range concave = concave_part(*whole);
  inflection_error_ = inflection_error(concave);
  const Search first = find_dip(whole->low, concave.low);
  const Search second = find_dip(whole->high, concave.high);
  // Nothing is hidden at the ends of the whole range, which are outside.
  result.certain =
      (first.certain || concave.low == whole->low) && (second.certain || concave.high == whole->high);
  const auto add = [&](double outside_before, double first_inside, double last_inside, double outside_after) {
    result.stretch[result.count++] = {.enter = {first_inside, outside_before},
                                      .leave = {last_inside, outside_after}};
  };
  if (first.x && second.x) {
    const Search rise = find_rise(concave.low, concave.high);
    result.certain = result.certain && rise.certain;
    if (rise.x) {
      add(whole->low, *first.x, *first.x, *rise.x);
      add(*rise.x, *second.x, *second.x, whole->high);
    } else {
      add(whole->low, *first.x, *second.x, whole->high);
    }
  } else if (first.x) {
    add(whole->low, *first.x, *first.x, concave.high);
  } else if (second.x) {
    add(concave.low, *second.x, *second.x, whole->high);
  }
  return result;
}

TorusLine::Dips TorusLine::dips(double begin) {
  const Stretches found = stretches();
  Dips result{.dip = {}, .count = found.count, .certain = found.certain};
  for (std::size_t i = 0; i < found.count; ++i) {
    result.dip[i] = {place(found.stretch[i].enter, begin), place(found.stretch[i].leave, begin)};
  }
  return result;
}

void obey_side(Side side, bool bulging, double shortest, TorusLine::Dips& dips) {
  std::size_t here = 0;  // the first stretch that goes on after the start
  while (here < dips.count && !(dips.dip[here].leave > 0)) ++here;
  TorusLine::Dip& next = dips.dip[std::min(here, dips.dip.size() - 1)];
  const bool inside = here < dips.count && next.enter <= 0;
  if (inside == (side == Side::inside)) return;

  if (side == Side::inside) {
    const bool leaves_at_start = here > 0 && dips.dip[here - 1].leave == 0;
    if (!bulging && here < dips.count) {
      const TorusLine::Dip onwards{0, next.leave};
      if (leaves_at_start) --dips.count;
      dips.dip[leaves_at_start ? here - 1 : here] = onwards;
      return;
    }
    if (leaves_at_start) {
      dips.dip[here - 1] = {0, shortest};
    } else if (dips.count < dips.dip.size()) {
      if (here < dips.count) dips.dip[here + 1] = next;
      dips.dip[here] = {0, shortest};
      ++dips.count;
    }
    return;
  }
  if (bulging && next.enter == 0) {
    if (here + 1 < dips.count) next = dips.dip[here + 1];
    --dips.count;
  } else {
    next.enter = std::min(shortest, next.leave / 2);
  }
}

}  // namespace crt::core
