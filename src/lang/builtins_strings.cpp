// This file has the built-ins that make text of values, and say it.
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

#include "lang/builtins.hpp"
#include "lang/failure.hpp"
#include "lang/operators.hpp"
#include "lang/utf8.hpp"

namespace crt::lang {

namespace {

Value text(const Arguments& arguments) {
  return arguments.context.make_string(arguments.call,
                                       text_of(arguments.context, arguments.call, arguments[0]));
}

/// Returns a number with so many digits behind the point. What rounds to 0 has no sign.
std::string fixed_text(double number, int digits) {
  if (!std::isfinite(number)) return float_text(number);
  // The largest number has 309 digits before the point.
  std::array<char, 400> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number,
                                 std::chars_format::fixed, digits);
  std::string_view text(buffer.data(), static_cast<std::size_t>(end.ptr - buffer.data()));
  if (text.find_first_not_of("-0.") == std::string_view::npos && text.starts_with('-'))
    text.remove_prefix(1);
  return std::string(text);
}

/// Computes format(x, digits).
Value format_number(const Arguments& arguments) {
  constexpr std::int64_t most_digits = 20;
  const std::int64_t digits = arguments.integer(1);
  if (digits < 0 || digits > most_digits)
    fail(arguments.span(1), "format takes 0 to {} digits, not {}", most_digits, digits);
  std::string text;
  if (const auto* whole = std::get_if<std::int64_t>(&arguments[0])) {
    text = std::to_string(*whole);
    if (digits > 0) text += '.' + std::string(static_cast<std::size_t>(digits), '0');
  } else {
    text = fixed_text(arguments.number(0), static_cast<int>(digits));
  }
  return arguments.context.make_string(arguments.call, std::move(text));
}

Value print(const Arguments& arguments) {
  std::string line;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (i > 0) line += ' ';
    line += text_of(arguments.context, arguments.span(i), arguments[i]);
  }
  arguments.context.print(arguments.call, line);
  return Nothing{};
}

/// Does assert(condition, text): an error with this text if the condition is false.
Value assert_that(const Arguments& arguments) {
  const auto* holds = std::get_if<bool>(&arguments[0]);
  if (!holds) arguments.wrong_type(0, "a Boolean");
  if (*holds) return Nothing{};
  if (arguments.size() == 1)
    fail(arguments.call, "what is asserted here is false; assert(condition, text) says why");
  fail(arguments.call, "{}",
       abbreviated(text_of(arguments.context, arguments.span(1), arguments[1])));
}

constexpr std::array strings_table = {
    Builtin{"str", "str(value)", 1, 1, text},
    Builtin{"format", "format(x, digits)", 2, 2, format_number},
    Builtin{"print", "print(value, ...)", 0, any_number, print},
    Builtin{"assert", "assert(condition, text)", 1, 2, assert_that},
};

}  // namespace

std::span<const Builtin> string_builtins() {
  return strings_table;
}

}  // namespace crt::lang
