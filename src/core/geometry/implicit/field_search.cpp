#include "core/geometry/implicit/field_search.hpp"

#include <algorithm>
#include <cmath>

namespace crt::core {

namespace {

/// Returns how far from the middle of a part the sign surely is that of the middle, or 0.
double known_about_middle(const FieldLine::Values& values, double length) {
  if (values.may_be_undefined || values.middle.contains(0)) return 0;
  const double least = std::max(values.middle.lo, -values.middle.hi);
  const double known = rounded_down(rounded_down(least / values.slope.magnitude()));
  constexpr double least_share = 0x1p-4;
  return known > least_share * length ? std::min(known, 0.5 * length) : 0;
}

}  // namespace

void FieldSearch::leave_open(double from, double to, bool has_one_root) {
  if (!has_gap_) gap_from_ = from;
  gap_has_one_root_ = has_one_root && (!has_gap_ || gap_has_one_root_);
  gap_to_ = to;
  has_gap_ = true;
}

void FieldSearch::know(double x, bool is_inside) {
  if (ignores_inside_ && is_inside) {
    has_gap_ = false;
    return;
  }
  ignores_inside_ = false;
  const double from = has_gap_ ? gap_from_ : x;
  const double to = has_gap_ ? gap_to_ : x;
  is_undecided_ = is_undecided_ || (has_gap_ && !gap_has_one_root_);
  has_gap_ = false;
  if (!is_known_) {
    is_known_ = true;
    first_inside_ = is_inside;
    first_gap_ = to - from;
    last_enter_ = x;
    is_awaited_ = is_inside && limits_.is_enough_inside;
  } else if (is_inside != last_inside_) {
    if (count_ == max_roots) {
      is_undecided_ = true;
      return;
    }
    const double middle = FieldLine::middle_of(from, to);
    const double error = rounded_up(std::max(middle - from, to - middle));
    roots_[count_++] = {.x = middle, .error = error, .is_entering = is_inside};
    const bool is_asked = middle - error > limits_.enough_after;
    if (is_inside) {
      last_enter_ = middle;
      is_awaited_ = is_asked;
    } else {
      has_enough_ = (is_asked || is_awaited_) && middle - last_enter_ > limits_.same_place;
      is_awaited_ = false;
    }
  } else if (is_inside && is_awaited_) {
    has_enough_ = x - last_enter_ > limits_.same_place;
  }
  last_inside_ = is_inside;
}

void FieldSearch::search(double from, double to) {
  struct Range {
    double from;
    double to;
    int sign;  ///< of f there, or 0 if that is not known
  };
  constexpr std::size_t max_open = 120;
  std::array<Range, max_open> open;
  std::size_t count = 0;
  open[count++] = {from, to, 0};
  const double whole = to - from;
  while (count > 0 && !has_enough_) {
    const auto [low, high, sign] = open[--count];
    if (high <= limits_.first) continue;
    if (sign != 0) {
      know(low, sign < 0);
      continue;
    }
    const FieldLine::Values values = evaluate(low, high);
    if (values.is_inside() || values.is_outside()) {
      know(low, values.is_inside());
    } else if (values.is_monotone()) {
      const Rest rest = narrow(low, high, values);
      if (rest.sign_after != 0) open[count++] = {rest.to, high, rest.sign_after};
      if (!rest.is_open || has_enough_) continue;
      if (count + 2 > max_open) {
        leave_open(rest.from, rest.to, true);
        continue;
      }
      const double middle = FieldLine::middle_of(rest.from, rest.to);
      open[count++] = {middle, rest.to, 0};
      open[count++] = {rest.from, middle, 0};
    } else {
      if (is_settled(values, high - low, shortest_part(whole)) || count + 3 > max_open) {
        leave_open(low, high, false);
        continue;
      }
      const double middle = FieldLine::middle_of(low, high);
      const double known = known_about_middle(values, high - low);
      open[count++] = {middle + known, high, 0};
      if (known > 0)
        open[count++] = {middle - known, middle + known, values.middle.lo > 0 ? 1 : -1};
      open[count++] = {low, middle - known, 0};
    }
  }
}

// There are n squared of the shortest parts in the second share of n evaluations, and n / 4 in all
// that follow. These take less than n / 2 evaluations, and the steps that narrow roots.
double FieldSearch::shortest_part(double whole) const {
  const double share = limits_.max_evaluations;
  if (evaluations_ < share) return limits_.shortest;
  const double parts = evaluations_ < 2 * share ? share * share : share / 4;
  return std::max(limits_.shortest, whole / parts);
}

bool FieldSearch::is_settled(const FieldLine::Values& values, double length,
                             double shortest) const {
  // Where rounding alone makes the sign at the middle unsure, halves get no surer.
  constexpr double roundings = 4;
  const bool is_noise = values.middle.contains(0) && !values.may_be_undefined &&
                        values.all.width() <= roundings * values.middle.width();
  constexpr std::uint32_t max_shares = 4;
  return is_noise || !(length > shortest) || evaluations_ >= max_shares * limits_.max_evaluations;
}

FieldSearch::Rest FieldSearch::narrow(double from, double to, FieldLine::Values values) {
  const bool is_rising = values.slope.lo > 0;
  bool is_passed = false;  // what follows is known to be beyond the root
  while (true) {
    const Interval root =
        Interval::of(FieldLine::middle_of(from, to)) - values.middle / values.slope;
    const int sign_after = is_passed ? (is_rising ? 1 : -1) : 0;
    if (root.hi < from) {
      know(from, !is_rising);
      return {};
    }
    if (root.lo > to) {
      know(from, is_rising);
      return {.from = to, .to = to, .sign_after = sign_after};
    }
    const double length = to - from;
    if (root.lo > from) {
      know(from, is_rising);
      from = root.lo;
    }
    if (root.hi < to) {
      is_passed = true;
      to = root.hi;
    }
    constexpr double least_gain = 0.75;
    const bool gains = to - from <= least_gain * length;
    const bool settled = is_settled(values, to - from, limits_.shortest);
    if (gains && !settled) {
      values = evaluate(from, to);
      if (values.is_monotone() && (values.slope.lo > 0) == is_rising) continue;
    }
    // A step without gain, from a middle that is nearly the root, leaves halves to be narrowed.
    if (settled) leave_open(from, to, true);
    return {.from = from,
            .to = to,
            .is_open = !settled,
            .sign_after = is_passed ? (is_rising ? 1 : -1) : 0};
  }
}

FieldSearch::StartPart FieldSearch::part_beside_root(double to) {
  constexpr double share = 0.25;
  constexpr double smallest = 0x1p-40;
  double length = to;
  for (double part = 1; part > smallest; part *= share) {
    length = to * part;
    const FieldLine::Values values = evaluate(std::min(0.0, length), std::max(0.0, length));
    if (!values.is_monotone()) continue;
    // Rounding has put f at the start only nearly at 0. Here it is so far off that f shows it.
    const FieldLine::Values end = evaluate(length, length);
    const int sign = (values.slope.lo > 0) == (length > 0) ? 1 : -1;
    const bool agrees = sign > 0 ? end.is_outside() : end.is_inside();
    return {length, agrees ? sign : 0};
  }
  return {length, 0};
}

void FieldSearch::search_from_root(double to, Side side) {
  const bool is_inside = side == Side::inside;
  const StartPart part = to > 0 ? part_beside_root(to) : StartPart{};
  know(0, is_inside);
  if (part.sign != 0 && (part.sign < 0) != is_inside) {
    if (is_inside) {
      // The line leaves at once.
      leave_open(0, std::min(part.length, 2 * limits_.shortest), true);
      know(0, false);
    } else {
      ignores_inside_ = true;
    }
  } else if (part.sign == 0) {
    leave_open(0, part.length, false);
  }
  if (part.length < to) search(part.length, to);
}

void FieldSearch::search_to_root(double from) {
  if (!(from < 0)) return;
  const StartPart part = part_beside_root(from);
  if (part.length > from) search(from, part.length);
  if (part.sign != 0) know(part.length, part.sign < 0);
  // What follows is at 0 itself.
  has_gap_ = true;
  gap_has_one_root_ = true;
  gap_from_ = gap_to_ = 0;
}

void FieldSearch::finish(double from, double to) {
  if (has_enough_) return;
  if (!is_known_) {
    const double middle = FieldLine::middle_of(from, to);
    const FieldLine::Values values = evaluate(middle, middle);
    const bool is_inside = !values.may_be_undefined && values.middle.lo + values.middle.hi <= 0;
    is_undecided_ = is_undecided_ || (has_gap_ && !gap_has_one_root_);
    has_gap_ = false;
    know(from, is_inside);
    first_gap_ = last_gap_ = to - from;
    return;
  }
  if (!has_gap_) return;
  last_gap_ = gap_to_ - gap_from_;
  is_undecided_ = is_undecided_ || !gap_has_one_root_;
  has_gap_ = false;
}

}  // namespace crt::core
