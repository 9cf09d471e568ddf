// This file has the built-ins that lead from one value to another.
#include <algorithm>
#include <array>
#include <cmath>
#include <crt/elementary.hpp>
#include <numbers>

#include "lang/builtins.hpp"
#include "lang/failure.hpp"
#include "lang/fields.hpp"
#include "lang/operators.hpp"

namespace crt::lang {

namespace {

double lerp_number(double a, double b, double t) {
  return a * (1 - t) + b * t;
}

/// Computes lerp(a, b, t): a for t = 0, b for t = 1, and what lies on the line between or beyond.
Value lerp(const Arguments& arguments) {
  const Value& a = arguments[0];
  const Value& b = arguments[1];
  if (arguments.any_field()) {
    return make_field(arguments.context, arguments.call, [&] {
      const Field t = arguments.field(2);
      return arguments.field(0) * (Field(1) - t) + arguments.field(1) * t;
    });
  }
  const double t = arguments.number(2);
  if (std::holds_alternative<Vec3>(a))
    return arguments.vector(0) * (1 - t) + arguments.vector(1) * t;
  if (const auto* from = std::get_if<Color>(&a)) {
    const auto* to = std::get_if<Color>(&b);
    if (!to) arguments.wrong_type(1, "a Color");
    return Color{lerp_number(from->r, to->r, t), lerp_number(from->g, to->g, t),
                 lerp_number(from->b, to->b, t), lerp_number(from->a, to->a, t)};
  }
  return lerp_number(arguments.number(0), arguments.number(1), t);
}

/// Computes smoothstep(low, high, x): 0 at `low`, 1 at `high`, and smooth everywhere.
Value smoothstep(const Arguments& arguments) {
  if (arguments.any_field()) {
    return make_field(arguments.context, arguments.call, [&] {
      const Field low = arguments.field(0);
      const Field share = (arguments.field(2) - low) / (arguments.field(1) - low);
      const Field s = min(max(share, Field(0)), Field(1));
      return s * s * (Field(3) - Field(2) * s);
    });
  }
  const double low = arguments.number(0);
  const double high = arguments.number(1);
  if (low == high) fail(arguments.call, "smoothstep needs two different bounds");
  const double s = std::clamp((arguments.number(2) - low) / (high - low), 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

/// Returns the share of the way in time, from 0 to 1.
double time_of(const Arguments& arguments) {
  return std::clamp(arguments.number(0), 0.0, 1.0);
}

double power_of(const Arguments& arguments) {
  constexpr double usual = 3;
  const double power = arguments.size() > 1 ? arguments.number(1) : usual;
  if (!(power > 0)) fail(arguments.span(1), "the power must be above 0");
  return power;
}

Value ease_in(const Arguments& arguments) {
  return elementary::pow(time_of(arguments), power_of(arguments));
}

Value ease_out(const Arguments& arguments) {
  return 1 - elementary::pow(1 - time_of(arguments), power_of(arguments));
}

Value ease_in_out(const Arguments& arguments) {
  const double t = time_of(arguments);
  const double power = power_of(arguments);
  if (t < 0.5) return elementary::pow(2 * t, power) / 2;
  return 1 - elementary::pow(2 * (1 - t), power) / 2;
}

/// Goes a tenth too far, and back.
Value ease_back(const Arguments& arguments) {
  constexpr double overshoot = 1.70158;
  const double left = time_of(arguments) - 1;
  return 1 + left * left * ((overshoot + 1) * left + overshoot);
}

/// Falls, and jumps up three times.
Value ease_bounce(const Arguments& arguments) {
  constexpr double steepness = 7.5625;
  constexpr double unit = 2.75;
  struct Jump {
    double end;
    double middle;
    double height;
  };
  constexpr std::array jumps = {Jump{1, 0, 0}, Jump{2, 1.5, 0.75}, Jump{2.5, 2.25, 0.9375},
                                Jump{unit, 2.625, 0.984375}};
  const double t = time_of(arguments) * unit;
  const auto* jump =
      std::find_if(jumps.begin(), jumps.end() - 1, [t](const Jump& one) { return t < one.end; });
  const double distance = (t - jump->middle) / unit;
  return steepness * distance * distance + jump->height;
}

/// Swings about the end, less and less.
Value ease_elastic(const Arguments& arguments) {
  constexpr double decay = 10;
  constexpr double period = 0.3;
  const double t = time_of(arguments);
  if (t == 0 || t == 1) return t;
  const double swing = elementary::sin((t - period / 4) * 2 * std::numbers::pi / period);
  return 1 + elementary::pow(2, -decay * t) * swing;
}

constexpr std::array easing_table = {
    Builtin{"lerp", "lerp(a, b, t)", 3, 3, lerp},
    Builtin{"smoothstep", "smoothstep(low, high, x)", 3, 3, smoothstep},
    Builtin{"easein", "easein(t, power)", 1, 2, ease_in},
    Builtin{"easeout", "easeout(t, power)", 1, 2, ease_out},
    Builtin{"easeinout", "easeinout(t, power)", 1, 2, ease_in_out},
    Builtin{"easeback", "easeback(t)", 1, 1, ease_back},
    Builtin{"easebounce", "easebounce(t)", 1, 1, ease_bounce},
    Builtin{"easeelastic", "easeelastic(t)", 1, 1, ease_elastic},
};

}  // namespace

std::span<const Builtin> easing_builtins() {
  return easing_table;
}

}  // namespace crt::lang
