// This file has the built-ins about lists and strings, and print.
#include <array>
#include <cmath>
#include <limits>

#include "lang/builtins.hpp"
#include "lang/failure.hpp"
#include "lang/operators.hpp"
#include "lang/utf8.hpp"

namespace crt::lang {

namespace {

Value count_items(const Arguments& arguments) {
  if (const auto* list = std::get_if<List>(&arguments[0]))
    return static_cast<std::int64_t>((*list)->items.size());
  const auto* string = std::get_if<String>(&arguments[0]);
  if (!string) arguments.wrong_type(0, "a List or a String");
  arguments.context.spend(arguments.call, (*string)->text.size() / bytes_per_step);
  return static_cast<std::int64_t>(count_code_points((*string)->text));
}

[[noreturn]] void refuse_step(const Arguments& arguments) {
  fail(arguments.span(2), "range needs a step other than 0");
}

Value integer_range(const Arguments& arguments, std::int64_t first, std::int64_t end,
                    std::int64_t step) {
  if (step == 0) refuse_step(arguments);
  // The distance is unsigned, since that between two Integers can be larger than an Integer.
  const bool up = step > 0;
  std::uint64_t distance = 0;
  if (up ? end > first : end < first) {
    distance = up ? static_cast<std::uint64_t>(end) - static_cast<std::uint64_t>(first)
                  : static_cast<std::uint64_t>(first) - static_cast<std::uint64_t>(end);
  }
  const std::uint64_t stride =
      up ? static_cast<std::uint64_t>(step) : 0 - static_cast<std::uint64_t>(step);
  const std::uint64_t count = distance / stride + (distance % stride != 0 ? 1 : 0);
  arguments.context.check_list_size(arguments.call, count);
  std::vector<Value> items;
  items.reserve(count);
  auto next = static_cast<std::uint64_t>(first);
  for (std::uint64_t i = 0; i < count; ++i, next += static_cast<std::uint64_t>(step))
    items.emplace_back(static_cast<std::int64_t>(next));
  return arguments.context.make_list(arguments.call, std::move(items));
}

Value float_range(const Arguments& arguments, double first, double end, double step) {
  if (!(step < 0 || step > 0)) refuse_step(arguments);
  if (!std::isfinite(first) || !std::isfinite(end) || !std::isfinite(step))
    fail(arguments.call, "range needs finite numbers");
  const double count = std::max(0.0, std::ceil((end - first) / step));
  constexpr double most = 0x1p62;
  arguments.context.check_list_size(arguments.call,
                                    static_cast<std::size_t>(std::min(count, most)));
  std::vector<Value> items;
  items.reserve(static_cast<std::size_t>(count));
  for (double i = 0; i < count; ++i) items.emplace_back(first + i * step);
  return arguments.context.make_list(arguments.call, std::move(items));
}

/// Computes range(end), range(first, end) or range(first, end, step). `end` is not part of it.
Value range(const Arguments& arguments) {
  const std::size_t count = arguments.size();
  if (arguments.all_integers()) {
    const auto integer = [&](std::size_t i) { return std::get<std::int64_t>(arguments[i]); };
    return integer_range(arguments, count > 1 ? integer(0) : 0, integer(count > 1 ? 1 : 0),
                         count > 2 ? integer(2) : 1);
  }
  const double first = count > 1 ? arguments.number(0) : 0;
  const double end = arguments.number(count > 1 ? 1 : 0);
  return float_range(arguments, first, end, count > 2 ? arguments.number(2) : 1);
}

Value text(const Arguments& arguments) {
  return arguments.context.make_string(arguments.call,
                                       text_of(arguments.context, arguments.call, arguments[0]));
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

constexpr std::array lists_table = {
    Builtin{"len", "len(list)", 1, 1, count_items},
    Builtin{"range", "range(first, end, step)", 1, 3, range},
    Builtin{"str", "str(value)", 1, 1, text},
    Builtin{"print", "print(value, ...)", 0, any_number, print},
};

}  // namespace

std::span<const Builtin> list_builtins() {
  return lists_table;
}

}  // namespace crt::lang
