// The steps of a field are evaluated in interval arithmetic, with the slopes of each.
//
// Each step has its value in the middle of a part of a line or of space, its values anywhere in
// that part, and its slopes there. Of the whole field the mean value form, value(middle) +
// slope (x - middle), cuts off what the second has too much. Sources: Moore, Kearfott, Cloud,
// Introduction to interval analysis, 2009, chapter 6 (mean value form); Caprani, Madsen, Mean value
// forms in interval analysis, 1980.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/geometry/implicit/field_program.hpp"
#include "core/geometry/implicit/profile_distance.hpp"
#include "core/math/interval.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

/// FieldSlopes are the slopes of a value along so many numbers.
template <std::size_t numbers>
struct FieldSlopes {
  std::array<Interval, numbers> each;

  static FieldSlopes unbounded() {
    FieldSlopes result;
    result.each.fill(Interval::everything());
    return result;
  }
  template <class Function>
  static FieldSlopes of(const Function& function) {
    FieldSlopes result;
    for (std::size_t i = 0; i < numbers; ++i) result.each[i] = function(i);
    return result;
  }

  friend FieldSlopes operator+(const FieldSlopes& a, const FieldSlopes& b) {
    return of([&](std::size_t i) { return a.each[i] + b.each[i]; });
  }
  friend FieldSlopes operator-(const FieldSlopes& a, const FieldSlopes& b) {
    return of([&](std::size_t i) { return a.each[i] - b.each[i]; });
  }
  friend FieldSlopes operator-(const FieldSlopes& a) {
    return of([&](std::size_t i) { return -a.each[i]; });
  }
  friend FieldSlopes operator*(const Interval& a, const FieldSlopes& b) {
    return of([&](std::size_t i) { return a * b.each[i]; });
  }
  friend FieldSlopes operator/(const FieldSlopes& a, const Interval& b) {
    return of([&](std::size_t i) { return a.each[i] / b; });
  }
  friend FieldSlopes hull(const FieldSlopes& a, const FieldSlopes& b) {
    return of([&](std::size_t i) { return core::hull(a.each[i], b.each[i]); });
  }
};

/// A FieldValue is what is known of a step.
template <std::size_t numbers>
struct FieldValue {
  Interval middle;             ///< in the middle of the part
  Interval all;                ///< anywhere in the part
  FieldSlopes<numbers> slope;  ///< between any two points of the part
};

/// FieldValues are what is known of a field.
template <std::size_t numbers>
struct FieldValues {
  FieldValue<numbers> value{};
  /// Says whether the field may have no value somewhere. The intervals are without such points.
  bool may_be_undefined = false;
  bool is_undefined = false;  ///< it has none in the whole part, and the intervals mean nothing
};

/// A FieldPart evaluates the steps of a field where `numbers` change, from those in the middle by
/// no more than their reach.
template <std::size_t numbers>
class FieldPart {
 public:
  using Value = FieldValue<numbers>;
  using Slopes = FieldSlopes<numbers>;

  explicit FieldPart(const std::array<double, numbers>& reach) : reach_(reach) {}

  /// Evaluates a field, of which coordinate(axis) returns the place.
  template <class Coordinate>
  FieldValues<numbers> evaluate(const FieldProgram& program, const Coordinate& coordinate);

 private:
  /// Takes the mean value form to cut off values that a step does not have. It pays for the last.
  void tighten(Value& step) const {
    double change = rounded_up(reach_[0] * step.slope.each[0].magnitude());
    for (std::size_t i = 1; i < numbers; ++i)
      change = sum_up(change + rounded_up(reach_[i] * step.slope.each[i].magnitude()));
    const double lo = sum_down(step.middle.lo - change);
    const double hi = sum_up(step.middle.hi + change);
    if (lo > step.all.lo) step.all.lo = std::min(lo, Interval::largest);
    if (hi < step.all.hi) step.all.hi = std::max(hi, -Interval::largest);
  }

  Value of_one(FieldOperation operation, double number, const Value& a);
  Value of_two(FieldOperation operation, const Value& a, const Value& b);
  /// Cuts off what is not from `least` to `greatest`, where an operation has no value.
  Value within(const Value& a, double least, double greatest);
  Value quotient(const Value& a, const Value& b);
  Value extreme(const Value& a, const Value& b, bool is_least) const;
  Value angle(const Value& y, const Value& x);
  static Value of_profile(const ProfileDistance& profile, const Value& x, const Value& y);
  template <class Function>
  Value staircase(const Value& a, const Function& function) const;

  std::array<double, numbers> reach_;
  bool may_be_undefined_ = false;
  bool is_undefined_ = false;  ///< the field has no value anywhere
};

template <std::size_t numbers>
FieldValue<numbers> FieldPart<numbers>::within(const Value& a, double least, double greatest) {
  if (a.all.lo >= least && a.all.hi <= greatest) {
    // Rounding may have put the middle outside.
    const Interval& m = a.middle;
    return {{std::clamp(m.lo, least, greatest), std::clamp(m.hi, least, greatest)}, a.all, a.slope};
  }
  may_be_undefined_ = true;
  if (a.all.hi < least || a.all.lo > greatest) is_undefined_ = true;
  const auto cut = [&](const Interval& i) {
    return Interval{std::clamp(i.lo, least, greatest), std::clamp(i.hi, least, greatest)};
  };
  return {cut(a.middle), cut(a.all), a.slope};
}

template <std::size_t numbers>
FieldValue<numbers> FieldPart<numbers>::quotient(const Value& a, const Value& b) {
  if (b.all.contains(0)) {
    may_be_undefined_ = true;
    if (b.all.is_point()) is_undefined_ = true;
    return {a.middle / b.middle, a.all / b.all, Slopes::unbounded()};
  }
  const Interval all = a.all / b.all;
  return {a.middle / b.middle, all, (a.slope - all * b.slope) / b.all};
}

template <std::size_t numbers>
FieldValue<numbers> FieldPart<numbers>::extreme(const Value& a, const Value& b,
                                                bool is_least) const {
  const bool is_a = is_least ? a.all.hi < b.all.lo : a.all.lo > b.all.hi;
  const bool is_b = is_least ? b.all.hi < a.all.lo : b.all.lo > a.all.hi;
  const auto of = [&](const Interval& i, const Interval& j) {
    return is_least ? Interval{std::min(i.lo, j.lo), std::min(i.hi, j.hi)}
                    : Interval{std::max(i.lo, j.lo), std::max(i.hi, j.hi)};
  };
  return {of(a.middle, b.middle), of(a.all, b.all),
          is_a   ? a.slope
          : is_b ? b.slope
                 : hull(a.slope, b.slope)};
}

template <std::size_t numbers>
FieldValue<numbers> FieldPart<numbers>::angle(const Value& y, const Value& x) {
  constexpr double pi = std::numbers::pi;
  const Interval half = around(pi / 2, pi / 2);
  const auto of = [&](const Interval& j, const Interval& i) {
    if (i.lo > 0) return arc_tangent(j / i);
    if (j.lo > 0) return half - arc_tangent(i / j);
    if (j.hi < 0) return -half - arc_tangent(i / j);
    return around(-pi, pi);
  };
  const bool is_cut = !(x.all.lo > 0) && y.all.contains(0);
  if (is_cut && x.all.contains(0)) {
    may_be_undefined_ = true;
    if (x.all.is_point() && y.all.is_point()) is_undefined_ = true;
  }
  return {of(y.middle, x.middle), of(y.all, x.all),
          is_cut ? Slopes::unbounded()
                 : (x.all * y.slope - y.all * x.slope) / (square(x.all) + square(y.all))};
}

template <std::size_t numbers>
FieldValue<numbers> FieldPart<numbers>::of_profile(const ProfileDistance& profile, const Value& x,
                                                   const Value& y) {
  const ProfileDistance::Values found = profile.evaluate({x.middle, y.middle}, {x.all, y.all});
  return {found.middle, found.all, found.slope_x * x.slope + found.slope_y * y.slope};
}

template <std::size_t numbers>
template <class Function>
FieldValue<numbers> FieldPart<numbers>::staircase(const Value& a, const Function& function) const {
  const auto of = [&](const Interval& i) { return Interval{function(i.lo), function(i.hi)}; };
  const Interval all = of(a.all);
  return {of(a.middle), all, all.is_point() ? Slopes{} : Slopes::unbounded()};
}

template <std::size_t numbers>
FieldValue<numbers> FieldPart<numbers>::of_one(FieldOperation operation, double number,
                                               const Value& a) {
  const Interval one = Interval::of(1);
  switch (operation) {
    case FieldOperation::negate:
      return {-a.middle, -a.all, -a.slope};
    case FieldOperation::whole_power:
      return {whole_power(a.middle, number), whole_power(a.all, number),
              Interval::of(number) * whole_power(a.all, number - 1) * a.slope};
    case FieldOperation::power: {
      const Value b = within(a, 0, infinity);
      const Interval all = power(b.all, number);
      const Interval rate = number > 1 ? power(b.all, number - 1) : one / power(b.all, 1 - number);
      return {power(b.middle, number), all, Interval::of(number) * rate * b.slope};
    }
    case FieldOperation::square_root: {
      const Value b = within(a, 0, infinity);
      const Interval all = square_root(b.all);
      return {square_root(b.middle), all, b.slope / (Interval::of(2) * all)};
    }
    case FieldOperation::absolute: {
      const auto of = [](const Interval& i) {
        return i.lo >= 0 ? i : i.hi <= 0 ? -i : Interval{0, i.magnitude()};
      };
      return {of(a.middle), of(a.all),
              a.all.lo >= 0   ? a.slope
              : a.all.hi <= 0 ? -a.slope
                              : hull(a.slope, -a.slope)};
    }
    case FieldOperation::sine: {
      const Wave of_a = wave(a.middle, a.all);
      return {of_a.sine_in_middle, of_a.sine, of_a.cosine * a.slope};
    }
    case FieldOperation::cosine: {
      const Wave of_a = wave(a.middle, a.all);
      return {of_a.cosine_in_middle, of_a.cosine, -(of_a.sine * a.slope)};
    }
    case FieldOperation::tangent: {
      const Interval all = tangent(a.all);
      if (all.magnitude() == infinity) may_be_undefined_ = true;
      return {tangent(a.middle), all, (one + square(all)) * a.slope};
    }
    case FieldOperation::arc_sine:
    case FieldOperation::arc_cosine: {
      const Value b = within(a, -1, 1);
      const Interval rest = one - square(b.all);
      const Slopes slope = b.slope / square_root({std::max(0.0, rest.lo), rest.hi});
      if (operation == FieldOperation::arc_sine)
        return {arc_sine(b.middle), arc_sine(b.all), slope};
      return {arc_cosine(b.middle), arc_cosine(b.all), -slope};
    }
    case FieldOperation::arc_tangent:
      return {arc_tangent(a.middle), arc_tangent(a.all), a.slope / (one + square(a.all))};
    case FieldOperation::exponential: {
      const Interval all = exponential(a.all);
      return {exponential(a.middle), all, all * a.slope};
    }
    case FieldOperation::logarithm: {
      constexpr double least = std::numeric_limits<double>::denorm_min();
      const Value b = within(a, least, infinity);
      const bool is_cut = a.all.lo < least;
      Interval all = logarithm(b.all);
      if (is_cut) all.lo = -infinity;
      return {logarithm(b.middle), all, is_cut ? Slopes::unbounded() : b.slope / b.all};
    }
    case FieldOperation::floor:
      return staircase(a, [](double x) { return std::floor(x); });
    case FieldOperation::ceiling:
      return staircase(a, [](double x) { return std::ceil(x); });
    default:
      return staircase(a, [](double x) { return std::round(x); });
  }
}

template <std::size_t numbers>
FieldValue<numbers> FieldPart<numbers>::of_two(FieldOperation operation, const Value& a,
                                               const Value& b) {
  switch (operation) {
    case FieldOperation::divide:
      return quotient(a, b);
    case FieldOperation::arc_tangent_of_two:
      return angle(a, b);
    default:
      return extreme(a, b, operation == FieldOperation::minimum);
  }
}

template <std::size_t numbers>
template <class Coordinate>
FieldValues<numbers> FieldPart<numbers>::evaluate(const FieldProgram& program,
                                                  const Coordinate& coordinate) {
  using enum FieldOperation;
  std::array<Value, FieldProgram::max_registers> registers;
  Value* last = nullptr;
  for (const FieldStep& step : program.steps()) {
    Value& result = registers[step.result];
    const Value& a = registers[step.a];
    const Value& b = registers[step.b];
    last = &result;
    switch (step.operation) {
      case constant:
        result = {Interval::of(step.number), Interval::of(step.number), {}};
        continue;
      case x:
      case y:
      case z: {
        result = coordinate(static_cast<std::size_t>(step.operation) - static_cast<std::size_t>(x));
        continue;
      }
      case add:
        result = {a.middle + b.middle, a.all + b.all, a.slope + b.slope};
        break;
      case subtract:
        result = {a.middle - b.middle, a.all - b.all, a.slope - b.slope};
        break;
      case multiply:
        result = {a.middle * b.middle, a.all * b.all, a.all * b.slope + b.all * a.slope};
        break;
      case square: {
        const Slopes twice = a.all * a.slope;
        result = {core::square(a.middle), core::square(a.all), twice + twice};
        break;
      }
      case profile_distance:
        result = of_profile(*step.profile, a, b);
        break;
      case divide:
      case minimum:
      case maximum:
      case arc_tangent_of_two:
        result = of_two(step.operation, a, b);
        break;
      default:
        result = of_one(step.operation, step.number, a);
        break;
    }
    if (is_undefined_) return {.may_be_undefined = true, .is_undefined = true};
  }
  tighten(*last);
  return {.value = *last, .may_be_undefined = may_be_undefined_};
}

}  // namespace crt::core
