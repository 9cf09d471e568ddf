#include "core/geometry/torus/spans.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/power.hpp"

namespace crt::core {

double TorusLine::level_at_start() const {
  const double outward = std::sqrt(point_.x * point_.x + point_.y * point_.y) - ring_;
  return outward * outward - (tube_ - point_.z) * (tube_ + point_.z);
}

/// Returns how far G may lie below its tangents, as the points where it turns from convex to
/// concave are rounded. Between the true point and the rounded one it is the change of slope times
/// the step. The slope of rho changes by no more than twice the lateral speed. Next to the point of
/// inflection it changes by its third derivative times the step squared.
double TorusLine::inflection_error(const Range& concave) const {
  const double lateral_speed = direction_.x * direction_.x + direction_.y * direction_.y;
  if (off_ == 0 || ring_ < 0 || !(lateral_speed > 0)) return 0;
  const double speed = std::sqrt(lateral_speed);
  const double size = ring_ + tube_;
  const double passing_error = off_ * (speed + size * std::sqrt(squared_length_));
  const double largest_passing = passing_ + passing_error;
  const double inflection = cube_root(ring_ * largest_passing * largest_passing / squared_length_);
  const double inflection_off = inflection * std::min(1.0, passing_error / largest_passing);
  const double passing_distance = largest_passing / speed;
  const double square_off =
      2 * (inflection * inflection_off + passing_distance * passing_error / speed) / lateral_speed;
  const double half = (concave.high - concave.low) / 2;
  const double half_off = std::min(std::sqrt(square_off), square_off / half);
  const double step = speed * half_off + 2 * off_ * (1 + size);
  const double bend = 6 * step / (passing_ / speed);
  return ring_ * step * std::min(4.0, bend * bend);
}

/// Finds a point outside in the concave part, if there is one.
TorusLine::Search TorusLine::find_rise(const Range& concave, const Search& first,
                                       const Search& second) const {
  const auto& [low, high] = concave;
  // Mostly the spans were found at these points.
  const double at_low = (first.x == low ? first.level : level(low)).value;
  const double at_high = (second.x == high ? second.level : level(high)).value;
  if (at_low > value_error(low)) return {.x = low, .found = true, .certain = true};
  if (at_high > value_error(high)) return {.x = high, .found = true, .certain = true};
  if (!(low < high)) return {.certain = at_low < -value_error(low)};
  return find_sign(low, high, -1, true);
}

/// Returns the root, or any point between its bounds if both are before `begin`.
double TorusLine::place(const Bracket& bracket, double begin) const {
  const bool is_before = std::max(bracket.negative, bracket.positive) < begin;
  return is_before ? bracket.negative + (bracket.positive - bracket.negative) / 2
                   : root(bracket, true);
}

TorusLine::Intervals TorusLine::intervals() {
  Intervals result;
  Range whole;
  if (!range(true, whole)) return result;
  const Range concave = concave_part(whole);
  inflection_error_ = inflection_error(concave);
  const Search first = find_dip(whole.low, concave.low, true);
  const Search second = find_dip(whole.high, concave.high, true);
  // Nothing is hidden at the ends of the whole range, which are outside.
  result.certain =
      (first.certain || concave.low == whole.low) && (second.certain || concave.high == whole.high);
  const auto add = [&](double outside_before, const Search& first_inside, const Search& last_inside,
                       double outside_after) {
    result.interval[result.count++] = {
        .enter = {first_inside.x, outside_before, first_inside.level},
        .leave = {last_inside.x, outside_after, last_inside.level}};
  };
  if (first.found && second.found) {
    const Search rise = find_rise(concave, first, second);
    result.certain = result.certain && rise.certain;
    if (rise.found) {
      add(whole.low, first, first, rise.x);
      add(rise.x, second, second, whole.high);
    } else {
      add(whole.low, first, second, whole.high);
    }
  } else if (first.found) {
    add(whole.low, first, first, concave.high);
  } else if (second.found) {
    add(concave.low, second, second, whole.high);
  }
  return result;
}

TorusLine::Spans TorusLine::spans(double begin) {
  const Intervals found = intervals();
  Spans result{.span = {}, .count = found.count, .certain = found.certain};
  for (std::size_t i = 0; i < found.count; ++i) {
    result.span[i] = {place(found.interval[i].enter, begin), place(found.interval[i].leave, begin)};
  }
  return result;
}

void obey_side(Side side, bool bulging, double shortest, TorusLine::Spans& spans) {
  std::size_t here = 0;  // the first span that ends after the start
  while (here < spans.count && !(spans.span[here].leave > 0)) ++here;
  TorusLine::Span& next = spans.span[std::min(here, spans.span.size() - 1)];
  const bool inside = here < spans.count && next.enter <= 0;
  if (inside == (side == Side::inside)) return;

  if (side == Side::inside) {
    const bool leaves_at_start = here > 0 && spans.span[here - 1].leave == 0;
    if (!bulging && here < spans.count) {
      const TorusLine::Span onwards{0, next.leave};
      if (leaves_at_start) --spans.count;
      spans.span[leaves_at_start ? here - 1 : here] = onwards;
      return;
    }
    if (leaves_at_start) {
      spans.span[here - 1] = {0, shortest};
    } else if (spans.count < spans.span.size()) {
      if (here < spans.count) spans.span[here + 1] = next;
      spans.span[here] = {0, shortest};
      ++spans.count;
    }
    return;
  }
  if (bulging && next.enter == 0) {
    if (here + 1 < spans.count) next = spans.span[here + 1];
    --spans.count;
  } else {
    next.enter = std::min(shortest, next.leave / 2);
  }
}

}  // namespace crt::core
