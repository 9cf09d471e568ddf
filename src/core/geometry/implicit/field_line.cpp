#include "core/geometry/implicit/field_line.hpp"

#include <numbers>

#include "core/math/vector.hpp"

namespace crt::core {

namespace {

/// A Triple is what is known of a step: FieldLine::Values without what is undefined.
struct Triple {
  Interval middle;
  Interval all;
  Interval slope;
};

/// A Part evaluates steps on a part of a line.
class Part {
 public:
  Part(double from, double to)
      : all_{from, to},
        middle_(FieldLine::middle_of(from, to)),
        reach_(rounded_up(std::max(middle_ - from, to - middle_))) {}

  bool may_be_undefined = false;
  bool is_undefined = false;

  Triple coordinate(const Interval& place, const Interval& direction) const {
    return {place + direction * Interval::of(middle_), place + direction * all_, direction};
  }

  /// Takes the mean value form to cut off values that a step does not have. It pays for the last.
  void tighten(Triple& step) const {
    const double change = rounded_up(reach_ * step.slope.magnitude());
    const double lo = sum_down(step.middle.lo - change);
    const double hi = sum_up(step.middle.hi + change);
    if (lo > step.all.lo) step.all.lo = std::min(lo, Interval::largest);
    if (hi < step.all.hi) step.all.hi = std::max(hi, -Interval::largest);
  }

  Triple of_one(FieldOperation operation, double number, const Triple& a);
  Triple of_two(FieldOperation operation, const Triple& a, const Triple& b);

 private:
  /// Cuts off what is not from `least` to `greatest`, where an operation has no value.
  Triple within(const Triple& a, double least, double greatest);
  Triple quotient(const Triple& a, const Triple& b);
  Triple extreme(const Triple& a, const Triple& b, bool is_least) const;
  Triple angle(const Triple& y, const Triple& x);
  template <class Function>
  Triple staircase(const Triple& a, const Function& function) const;

  Interval all_;
  double middle_;
  double reach_;  ///< no point is farther from the middle
};

Triple Part::within(const Triple& a, double least, double greatest) {
  if (a.all.lo >= least && a.all.hi <= greatest) {
    // Rounding may have put the middle outside.
    const Interval& m = a.middle;
    return {{std::clamp(m.lo, least, greatest), std::clamp(m.hi, least, greatest)}, a.all, a.slope};
  }
  may_be_undefined = true;
  if (a.all.hi < least || a.all.lo > greatest) is_undefined = true;
  const auto cut = [&](const Interval& i) {
    return Interval{std::clamp(i.lo, least, greatest), std::clamp(i.hi, least, greatest)};
  };
  return {cut(a.middle), cut(a.all), a.slope};
}

Triple Part::quotient(const Triple& a, const Triple& b) {
  if (b.all.contains(0)) {
    may_be_undefined = true;
    if (b.all.is_point()) is_undefined = true;
    return {a.middle / b.middle, a.all / b.all, Interval::everything()};
  }
  const Interval all = a.all / b.all;
  return {a.middle / b.middle, all, (a.slope - all * b.slope) / b.all};
}

Triple Part::extreme(const Triple& a, const Triple& b, bool is_least) const {
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

Triple Part::angle(const Triple& y, const Triple& x) {
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
    may_be_undefined = true;
    if (x.all.is_point() && y.all.is_point()) is_undefined = true;
  }
  return {of(y.middle, x.middle), of(y.all, x.all),
          is_cut ? Interval::everything()
                 : (x.all * y.slope - y.all * x.slope) / (square(x.all) + square(y.all))};
}

template <class Function>
Triple Part::staircase(const Triple& a, const Function& function) const {
  const auto of = [&](const Interval& i) { return Interval{function(i.lo), function(i.hi)}; };
  const Interval all = of(a.all);
  return {of(a.middle), all, all.is_point() ? Interval{} : Interval::everything()};
}

Triple Part::of_one(FieldOperation operation, double number, const Triple& a) {
  const Interval one = Interval::of(1);
  switch (operation) {
    case FieldOperation::negate:
      return {-a.middle, -a.all, -a.slope};
    case FieldOperation::whole_power:
      return {whole_power(a.middle, number), whole_power(a.all, number),
              Interval::of(number) * whole_power(a.all, number - 1) * a.slope};
    case FieldOperation::power: {
      const Triple b = within(a, 0, infinity);
      const Interval all = power(b.all, number);
      const Interval rate = number > 1 ? power(b.all, number - 1) : one / power(b.all, 1 - number);
      return {power(b.middle, number), all, Interval::of(number) * rate * b.slope};
    }
    case FieldOperation::square_root: {
      const Triple b = within(a, 0, infinity);
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
      if (all.magnitude() == infinity) may_be_undefined = true;
      return {tangent(a.middle), all, (one + square(all)) * a.slope};
    }
    case FieldOperation::arc_sine:
    case FieldOperation::arc_cosine: {
      const Triple b = within(a, -1, 1);
      const Interval rest = one - square(b.all);
      const Interval slope = b.slope / square_root({std::max(0.0, rest.lo), rest.hi});
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
      const Triple b = within(a, least, infinity);
      const bool is_cut = a.all.lo < least;
      Interval all = logarithm(b.all);
      if (is_cut) all.lo = -infinity;
      return {logarithm(b.middle), all, is_cut ? Interval::everything() : b.slope / b.all};
    }
    case FieldOperation::floor:
      return staircase(a, [](double x) { return std::floor(x); });
    case FieldOperation::ceiling:
      return staircase(a, [](double x) { return std::ceil(x); });
    default:
      return staircase(a, [](double x) { return std::round(x); });
  }
}

Triple Part::of_two(FieldOperation operation, const Triple& a, const Triple& b) {
  switch (operation) {
    case FieldOperation::divide:
      return quotient(a, b);
    case FieldOperation::arc_tangent_of_two:
      return angle(a, b);
    default:
      return extreme(a, b, operation == FieldOperation::minimum);
  }
}

}  // namespace

FieldLine::Values FieldLine::evaluate(double from, double to) const {
  using enum FieldOperation;
  std::array<Triple, FieldProgram::max_registers> registers;
  Part part(from, to);
  Triple* last = nullptr;
  for (const FieldStep& step : program_.steps()) {
    Triple& result = registers[step.result];
    const Triple& a = registers[step.a];
    const Triple& b = registers[step.b];
    last = &result;
    switch (step.operation) {
      case constant:
        result = {Interval::of(step.number), Interval::of(step.number), Interval{}};
        continue;
      case x:
      case y:
      case z: {
        const auto axis = static_cast<std::size_t>(step.operation) - static_cast<std::size_t>(x);
        result = part.coordinate(place_[axis], direction_[axis]);
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
        const Interval twice = a.all * a.slope;
        result = {core::square(a.middle), core::square(a.all), twice + twice};
        break;
      }
      case divide:
      case minimum:
      case maximum:
      case arc_tangent_of_two:
        result = part.of_two(step.operation, a, b);
        break;
      default:
        result = part.of_one(step.operation, step.number, a);
        break;
    }
    if (part.is_undefined) {
      return {.middle = {}, .all = {}, .slope = {}, .may_be_undefined = true, .is_undefined = true};
    }
  }
  part.tighten(*last);
  return {.middle = last->middle,
          .all = last->all,
          .slope = last->slope,
          .may_be_undefined = part.may_be_undefined};
}

}  // namespace crt::core
