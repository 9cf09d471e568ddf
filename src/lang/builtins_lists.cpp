// This file has the built-ins about lists and dictionaries.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lang/builtins.hpp"
#include "lang/failure.hpp"
#include "lang/operators.hpp"
#include "lang/utf8.hpp"

namespace crt::lang {

namespace {

Value count_items(const Arguments& arguments) {
  if (const auto* list = std::get_if<List>(&arguments[0]))
    return static_cast<std::int64_t>((*list)->items.size());
  if (const auto* dictionary = std::get_if<Dictionary>(&arguments[0]))
    return static_cast<std::int64_t>((*dictionary)->entries.size());
  const auto* string = std::get_if<String>(&arguments[0]);
  if (!string) arguments.wrong_type(0, "a List, a String or a Dictionary");
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

/// An Activity names the built-in that a script spends its steps in.
Context::Activity loop_of(const char* name, const Arguments& arguments) {
  return {.name = name, .span = arguments.call, .is_loop = true};
}

void begin_round(const Arguments& arguments) {
  arguments.context.step(arguments.call);
  arguments.context.count_round();
}

/// Computes map(list, f): what f gives for each item.
Value map(const Arguments& arguments) {
  const Context::Running running(arguments.context, loop_of("map", arguments));
  ListMaker result(arguments.context, arguments.call);
  for (const Value& item : arguments.list(0).items) {
    begin_round(arguments);
    result.add(arguments.call_argument(1, {&item, 1}));
  }
  return result.finish();
}

/// Computes filter(list, f): the items for which f gives true.
Value filter(const Arguments& arguments) {
  const Context::Running running(arguments.context, loop_of("filter", arguments));
  ListMaker result(arguments.context, arguments.call);
  for (const Value& item : arguments.list(0).items) {
    begin_round(arguments);
    const Value is_kept = arguments.call_argument(1, {&item, 1});
    const auto* boolean = std::get_if<bool>(&is_kept);
    if (!boolean) fail(arguments.span(1), "filter takes what gives a Boolean, not {}", is_kept);
    if (*boolean) result.add(item);
  }
  return result.finish();
}

/// Says which of two keys comes first. Both are Integers, or numbers, or Strings.
bool is_before(const Value& a, const Value& b) {
  if (const auto* text = std::get_if<String>(&a)) return (*text)->text < std::get<String>(b)->text;
  const auto* left = std::get_if<std::int64_t>(&a);
  const auto* right = std::get_if<std::int64_t>(&b);
  if (left && right) return *left < *right;
  double left_storage = 0;
  double right_storage = 0;
  return *as_float(a, left_storage) < *as_float(b, right_storage);
}

/// Checks that keys can be put into an order, and makes numbers of one type. Returns how many bytes
/// all Strings have together.
std::size_t check_keys(const Arguments& arguments, std::vector<Value>& keys) {
  std::size_t bytes = 0;
  std::size_t texts = 0;
  std::size_t integers = 0;
  for (const Value& key : keys) {
    const auto* text = std::get_if<String>(&key);
    const auto* number = std::get_if<double>(&key);
    if (text) ++texts, bytes += (*text)->text.size();
    if (std::holds_alternative<std::int64_t>(key)) ++integers;
    if ((number && std::isnan(*number)) || (!text && !number && !std::get_if<std::int64_t>(&key))) {
      fail(arguments.call, "sort takes numbers or Strings, not {}; {}",
           number ? std::string("nan") : type_with_article(key),
           "sort(list, key) sorts by what the macro 'key' gives for each item");
    }
  }
  if (texts > 0 && texts < keys.size())
    fail(arguments.call, "sort takes numbers or Strings, not both");
  if (integers > 0 && integers < keys.size()) {
    for (Value& key : keys) {
      double storage = 0;
      key = double{*as_float(key, storage)};
    }
  }
  return bytes;
}

/// Computes sort(list) or sort(list, key). Items whose keys are equal stay in their order.
Value sort(const Arguments& arguments) {
  Context& context = arguments.context;
  const Context::Running running(context, loop_of("sort", arguments));
  const std::vector<Value>& items = arguments.list(0).items;
  const Charge charge = context.charge_memory(
      arguments.call, items.size() * (sizeof(Value) + 2 * sizeof(std::size_t)));
  std::vector<Value> keys;
  keys.reserve(items.size());
  for (const Value& item : items) {
    begin_round(arguments);
    keys.push_back(arguments.size() > 1 ? arguments.call_argument(1, {&item, 1}) : item);
  }
  const std::size_t bytes = check_keys(arguments, keys);
  const auto rounds = static_cast<std::size_t>(std::bit_width(keys.size()));
  context.spend(arguments.call, (keys.size() / items_per_step + bytes / bytes_per_step) * rounds);
  std::vector<std::size_t> order(keys.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&keys](std::size_t a, std::size_t b) { return is_before(keys[a], keys[b]); });
  ListMaker result(context, arguments.call);
  for (const std::size_t i : order) result.add(items[i]);
  return result.finish();
}

/// Computes sum(list): the items joined by '+', and 0 for none.
Value sum(const Arguments& arguments) {
  Context& context = arguments.context;
  const std::vector<Value>& items = arguments.list(0).items;
  const bool are_entities =
      !items.empty() && std::all_of(items.begin(), items.end(), [](const Value& item) {
        return std::holds_alternative<Entity>(item);
      });
  context.spend(arguments.call, items.size());
  if (are_entities) {
    std::vector<Entity> parts;
    parts.reserve(items.size());
    for (const Value& item : items) parts.push_back(std::get<Entity>(item));
    return union_of(context, arguments.call, parts);
  }
  Value result = items.empty() ? Value(std::int64_t{0}) : items.front();
  for (std::size_t i = 1; i < items.size(); ++i)
    result = binary(context, BinaryOperator::add, arguments.call, result, items[i]);
  return result;
}

/// Computes zip(a, b, ...): Lists of the first items, of the second items and so on, up to the end
/// of the shortest.
Value zip(const Arguments& arguments) {
  Context& context = arguments.context;
  const Context::Running running(context, loop_of("zip", arguments));
  std::size_t count = arguments.list(0).items.size();
  for (std::size_t i = 1; i < arguments.size(); ++i)
    count = std::min(count, arguments.list(i).items.size());
  ListMaker result(context, arguments.call);
  for (std::size_t row = 0; row < count; ++row) {
    begin_round(arguments);
    std::vector<Value> items;
    for (std::size_t i = 0; i < arguments.size(); ++i)
      items.push_back(arguments.list(i).items[row]);
    result.add(context.make_list(arguments.call, std::move(items)));
  }
  return result.finish();
}

const DictionaryValue& dictionary(const Arguments& arguments) {
  const auto* dictionary = std::get_if<Dictionary>(&arguments[0]);
  if (!dictionary) arguments.wrong_type(0, "a Dictionary");
  return **dictionary;
}

Value keys(const Arguments& arguments) {
  Context& context = arguments.context;
  ListMaker result(context, arguments.call);
  for (const auto& [name, value] : dictionary(arguments).entries) {
    context.step(arguments.call);
    result.add(context.make_string(arguments.call, std::string(context.symbols.name(name))));
  }
  return result.finish();
}

Value has(const Arguments& arguments) {
  const DictionaryValue& entries = dictionary(arguments);
  const auto* name = std::get_if<String>(&arguments[1]);
  if (!name) arguments.wrong_type(1, "a String");
  arguments.context.spend(arguments.call, (*name)->text.size() / bytes_per_step);
  const std::optional<Symbol> symbol = arguments.context.symbols.find((*name)->text);
  return symbol && entries.entries.find(*symbol) != nullptr;
}

constexpr std::array lists_table = {
    Builtin{"len", "len(list)", 1, 1, count_items},
    Builtin{"range", "range(first, end, step)", 1, 3, range},
    Builtin{"map", "map(list, f)", 2, 2, map, true},
    Builtin{"filter", "filter(list, f)", 2, 2, filter, true},
    Builtin{"sort", "sort(list, key)", 1, 2, sort, true},
    Builtin{"sum", "sum(list)", 1, 1, sum},
    Builtin{"zip", "zip(a, b, ...)", 2, any_number, zip},
    Builtin{"keys", "keys(dictionary)", 1, 1, keys},
    Builtin{"has", "has(dictionary, name)", 2, 2, has},
};

}  // namespace

std::span<const Builtin> list_builtins() {
  return lists_table;
}

}  // namespace crt::lang
