#include "cli/intervals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <limits>

namespace crt::cli {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int most_digits = 17;  ///< that say more of a double

/// A bound that was rounded to nearest is within the next double.
Interval widened(double lower, double upper) {
  return {std::nextafter(lower, -infinity), std::nextafter(upper, infinity)};
}

Interval around(std::initializer_list<double> ends) {
  return widened(std::min(ends), std::max(ends));
}

double number_of(const std::string& text) {
  double number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// Returns the place of the first digit: 0 for 1 to 9, 1 for 10 to 99.
int place_of(double number) {
  const std::string text = fmt::format("{:e}", std::abs(number));
  const std::size_t e = text.find('e');
  return static_cast<int>(number_of(text.substr(text[e + 1] == '+' ? e + 2 : e + 1)));
}

/// Returns a number with so many digits, zeros at the end among them.
std::string with_digits(double number, int wanted) {
  const int digits = std::clamp(wanted, 1, most_digits);
  // Without a digit behind the point, the form with zeros would add one.
  if (place_of(number) == digits - 1) return fmt::format("{:.{}g}", number, digits);
  return fmt::format("{:#.{}g}", number, digits);
}

}  // namespace

Interval sum_of(const Interval& a, const Interval& b) {
  return widened(a.lower + b.lower, a.upper + b.upper);
}

Interval product_of(const Interval& a, const Interval& b) {
  return around({a.lower * b.lower, a.lower * b.upper, a.upper * b.lower, a.upper * b.upper});
}

Interval quotient_of(const Interval& a, const Interval& divisor) {
  return around({a.lower / divisor.lower, a.lower / divisor.upper, a.upper / divisor.lower,
                 a.upper / divisor.upper});
}

std::string number_text(const Interval& number) {
  const double width = number.width();
  if (!std::isfinite(width)) return "?";
  if (width == 0) return fmt::format("{}", number.lower);
  if (number.contains(0)) return "0";
  return with_digits(number.middle(), place_of(number.middle()) - place_of(width));
}

std::string end_text(double end, double width, bool up) {
  if (!std::isfinite(end) || end == 0) return fmt::format("{}", end);
  constexpr int more_digits = 2;
  const int place = width > 0 ? place_of(width) - more_digits : place_of(end) - most_digits;
  const int digits = std::clamp(place_of(end) - place + 1, 1, most_digits);
  const double unit = number_of(fmt::format("1e{}", place_of(end) - digits + 1));
  for (const double candidate : {end, up ? end + unit : end - unit}) {
    std::string text = fmt::format("{:.{}g}", candidate, digits);
    const double written = number_of(text);
    if (up ? written >= end : written <= end) return text;
  }
  return fmt::format("{}", end);
}

std::string bounds_text(const Interval& number) {
  return fmt::format("between {} and {}", end_text(number.lower, number.width(), false),
                     end_text(number.upper, number.width(), true));
}

}  // namespace crt::cli
