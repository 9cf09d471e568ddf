// This file has the built-ins that compute numbers: trigonometry, powers, rounding, random numbers.
#include <crt/elementary.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "lang/builtins.hpp"
#include "lang/failure.hpp"
#include "lang/fields.hpp"
#include "lang/random.hpp"
#include "text/format.hpp"

namespace crt::lang {

namespace {

constexpr double degrees_in_half_turn = 180;

using FieldFunction = Field (*)(const Field&);
using FieldFunctionOfTwo = Field (*)(const Field&, const Field&);

/// Returns a function of the first argument, which is a field.
template <FieldFunction function>
Value of_field(const Arguments& arguments) {
  return make_field(arguments.context, arguments.call,
                    [&] { return function(arguments.field(0)); });
}

template <double (*function)(double), FieldFunction field_function>
Value of_number(const Arguments& arguments) {
  if (arguments.any_field()) return of_field<field_function>(arguments);
  return function(arguments.number(0));
}

template <double (*function)(double), FieldFunction field_function>
Value of_angle(const Arguments& arguments) {
  arguments.expect_radians();
  return of_number<function, field_function>(arguments);
}

Value in_degrees(const Arguments& arguments) {
  return arguments.number(0) * degrees_in_half_turn / std::numbers::pi;
}

Value in_radians(const Arguments& arguments) {
  return arguments.number(0) * std::numbers::pi / degrees_in_half_turn;
}

// The standard's functions are overloaded, and a template argument must be one of them.
double sine(double x) {
  return elementary::sin(x);
}
double cosine(double x) {
  return elementary::cos(x);
}
double tangent(double x) {
  return elementary::tan(x);
}
double arc_sine(double x) {
  return elementary::asin(x);
}
double arc_cosine(double x) {
  return elementary::acos(x);
}
double arc_tangent(double x) {
  return elementary::atan(x);
}
double square_root(double x) {
  return std::sqrt(x);
}
double exponential(double x) {
  return elementary::exp(x);
}
double logarithm(double x) {
  return elementary::log(x);
}
double floor_of(double x) {
  return std::floor(x);
}
double ceiling_of(double x) {
  return std::ceil(x);
}
double rounded(double x) {
  return std::round(x);
}

/// Computes floor, ceil or round, which give Integers so that they can count and index.
template <double (*function)(double), FieldFunction field_function>
Value to_integer(const Arguments& arguments) {
  if (arguments.any_field()) return of_field<field_function>(arguments);
  if (std::holds_alternative<std::int64_t>(arguments[0])) return arguments[0];
  const double whole = function(arguments.number(0));
  constexpr double beyond = 0x1p63;
  if (!(whole >= -beyond && whole < beyond))
    fail(arguments.span(0), "{} does not fit into a 64-bit Integer", float_text(whole));
  return static_cast<std::int64_t>(whole);
}

Value absolute(const Arguments& arguments) {
  if (arguments.any_field()) return of_field<crt::abs>(arguments);
  if (const auto* integer = std::get_if<std::int64_t>(&arguments[0])) {
    if (*integer == std::numeric_limits<std::int64_t>::min())
      fail(arguments.span(0), "the result does not fit into a 64-bit Integer");
    return *integer < 0 ? -*integer : *integer;
  }
  return std::abs(arguments.number(0));
}

/// Combines fields one after the other.
template <FieldFunctionOfTwo function>
Value of_fields(const Arguments& arguments) {
  Value result = arguments.field(0);
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    result = make_field(arguments.context, arguments.call,
                        [&] { return function(std::get<Field>(result), arguments.field(i)); });
  }
  return result;
}

Value arc_tangent_of_two(const Arguments& arguments) {
  if (arguments.any_field()) return of_fields<crt::atan2>(arguments);
  return elementary::atan2(arguments.number(0), arguments.number(1));
}

Value power(const Arguments& arguments) {
  if (arguments.any_field()) return of_fields<crt::pow>(arguments);
  return elementary::pow(arguments.number(0), arguments.number(1));
}

/// Returns the least or greatest argument: an Integer if all are Integers, else a Float.
template <bool want_greatest>
Value extreme(const Arguments& arguments) {
  if (arguments.any_field()) return of_fields < want_greatest ? crt::max : crt::min > (arguments);
  const bool integers = arguments.all_integers();
  Value best = integers ? arguments[0] : arguments.number(0);
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    if (integers) {
      const auto a = std::get<std::int64_t>(best);
      const auto b = std::get<std::int64_t>(arguments[i]);
      best = want_greatest ? std::max(a, b) : std::min(a, b);
    } else {
      const double a = std::get<double>(best);
      const double b = arguments.number(i);
      best = want_greatest ? std::max(a, b) : std::min(a, b);
    }
  }
  return best;
}

Value clamp(const Arguments& arguments) {
  if (arguments.any_field()) {
    return make_field(arguments.context, arguments.call, [&] {
      return min(max(arguments.field(0), arguments.field(1)), arguments.field(2));
    });
  }
  const auto refuse = [&] { fail(arguments.call, "clamp needs low <= high"); };
  if (arguments.all_integers()) {
    const std::int64_t low = arguments.integer(1);
    const std::int64_t high = arguments.integer(2);
    if (low > high) refuse();
    return std::clamp(arguments.integer(0), low, high);
  }
  const double low = arguments.number(1);
  const double high = arguments.number(2);
  const double x = arguments.number(0);
  if (!(low <= high)) refuse();
  return std::clamp(x, low, high);
}

Value random_number(const Arguments& arguments) {
  const double low = arguments.size() > 0 ? arguments.number(0) : 0;
  const double high = arguments.size() > 1 ? arguments.number(1) : 1;
  if (arguments.size() == 1)
    fail(arguments.call, "rand takes no arguments or two: rand(low, high)");
  Context& context = arguments.context;
  const bool in_2015 = context.compat == compat_2015;
  // In 2015 both orders were fine.
  if (!(low <= high) && !(in_2015 && low > high)) fail(arguments.call, "rand needs low <= high");
  const double share = in_2015 ? context.random_2015.next_float() : context.random.next_float();
  const double number = low + (high - low) * share;
  // Rounding may reach `high`, which is not among the results unless it is `low` too.
  const bool is_before_high = low <= high ? number < high : number > high;
  return is_before_high ? number : low;
}

Value noise(const Arguments& arguments) {
  Vec3 point(0);
  if (arguments.size() == 1 && std::holds_alternative<Vec3>(arguments[0])) {
    point = arguments.vector(0);
  } else {
    for (std::size_t i = 0; i < arguments.size(); ++i)
      point[static_cast<int>(i)] = arguments.number(i);
  }
  return gradient_noise(point);
}

constexpr std::array numbers_table = {
    Builtin{"sin", "sin(x)", 1, 1, of_angle<sine, crt::sin>},
    Builtin{"cos", "cos(x)", 1, 1, of_angle<cosine, crt::cos>},
    Builtin{"tan", "tan(x)", 1, 1, of_angle<tangent, crt::tan>},
    Builtin{"asin", "asin(x)", 1, 1, of_number<arc_sine, crt::asin>},
    Builtin{"acos", "acos(x)", 1, 1, of_number<arc_cosine, crt::acos>},
    Builtin{"atan", "atan(x)", 1, 1, of_number<arc_tangent, crt::atan>},
    Builtin{"atan2", "atan2(y, x)", 2, 2, arc_tangent_of_two},
    Builtin{"deg", "deg(x)", 1, 1, in_degrees},
    Builtin{"rad", "rad(x)", 1, 1, in_radians},
    Builtin{"sqrt", "sqrt(x)", 1, 1, of_number<square_root, crt::sqrt>},
    Builtin{"pow", "pow(base, exponent)", 2, 2, power},
    Builtin{"exp", "exp(x)", 1, 1, of_number<exponential, crt::exp>},
    Builtin{"log", "log(x)", 1, 1, of_number<logarithm, crt::log>},
    Builtin{"abs", "abs(x)", 1, 1, absolute},
    Builtin{"min", "min(a, b, ...)", 1, any_number, extreme<false>},
    Builtin{"max", "max(a, b, ...)", 1, any_number, extreme<true>},
    Builtin{"floor", "floor(x)", 1, 1, to_integer<floor_of, crt::floor>},
    Builtin{"ceil", "ceil(x)", 1, 1, to_integer<ceiling_of, crt::ceil>},
    Builtin{"round", "round(x)", 1, 1, to_integer<rounded, crt::round>},
    Builtin{"clamp", "clamp(x, low, high)", 3, 3, clamp},
    Builtin{"rand", "rand(low, high)", 0, 2, random_number},
    Builtin{"noise", "noise(x, y, z)", 1, 3, noise},
};

}  // namespace

std::span<const Builtin> number_builtins() {
  return numbers_table;
}

}  // namespace crt::lang
