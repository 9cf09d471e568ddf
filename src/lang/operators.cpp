#include "lang/operators.hpp"

#include <crt/elementary.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lang/failure.hpp"
#include "lang/fields.hpp"
#include "lang/utf8.hpp"
#include "text/format.hpp"

namespace crt::lang {

namespace {

const char* sign(BinaryOperator op) {
  switch (op) {
    case BinaryOperator::power:
      return "**";
    case BinaryOperator::multiply:
      return "*";
    case BinaryOperator::divide:
      return "/";
    case BinaryOperator::remainder:
      return "%";
    case BinaryOperator::add:
      return "+";
    case BinaryOperator::subtract:
      return "-";
    case BinaryOperator::intersect:
      return "^";
    case BinaryOperator::less:
      return "<";
    case BinaryOperator::less_or_equal:
      return "<=";
    case BinaryOperator::greater:
      return ">";
    case BinaryOperator::greater_or_equal:
      return ">=";
    case BinaryOperator::equal:
      return "==";
    case BinaryOperator::not_equal:
      return "!=";
  }
  return "";
}

[[noreturn]] void wrong_types(BinaryOperator op, Span span, const Value& left, const Value& right) {
  const bool are_numbers = as_field(left) && as_field(right);
  const char* hint = op == BinaryOperator::intersect && are_numbers ? "; a power is a ** b" : "";
  fail(span, "'{}' does not take {} and {}{}", sign(op), left, right, hint);
}

[[noreturn]] void overflow(Span span) {
  fail(span, "the result does not fit into a 64-bit Integer; with a Float (2.0 for 2) it would");
}

/// Computes base ** exponent by squaring. A negative exponent gives a Float.
Value integer_power(Span span, std::int64_t base, std::int64_t exponent) {
  if (exponent < 0)
    return elementary::pow(static_cast<double>(base), static_cast<double>(exponent));
  std::int64_t result = 1;
  for (;;) {
    if ((exponent & 1) != 0 && __builtin_mul_overflow(result, base, &result)) overflow(span);
    exponent >>= 1;
    if (exponent == 0) return result;
    // Powers of 0, 1 and -1 stay in range, and all others overflow within 64 rounds.
    if (__builtin_mul_overflow(base, base, &base)) overflow(span);
  }
}

Value integers(BinaryOperator op, Span span, std::int64_t a, std::int64_t b) {
  std::int64_t result = 0;
  switch (op) {
    case BinaryOperator::power:
      return integer_power(span, a, b);
    case BinaryOperator::add:
      if (__builtin_add_overflow(a, b, &result)) overflow(span);
      return result;
    case BinaryOperator::subtract:
      if (__builtin_sub_overflow(a, b, &result)) overflow(span);
      return result;
    case BinaryOperator::multiply:
      if (__builtin_mul_overflow(a, b, &result)) overflow(span);
      return result;
    case BinaryOperator::divide:
    case BinaryOperator::remainder:
      if (b == 0) fail(span, "division by zero");
      if (b == -1)
        return op == BinaryOperator::remainder ? 0 : integers(BinaryOperator::subtract, span, 0, a);
      return op == BinaryOperator::divide ? a / b : a % b;
    case BinaryOperator::less:
      return a < b;
    case BinaryOperator::less_or_equal:
      return a <= b;
    case BinaryOperator::greater:
      return a > b;
    case BinaryOperator::greater_or_equal:
      return a >= b;
    default:
      wrong_types(op, span, a, b);
  }
}

template <class Ordered>
bool compare(BinaryOperator op, const Ordered& a, const Ordered& b) {
  switch (op) {
    case BinaryOperator::less:
      return a < b;
    case BinaryOperator::less_or_equal:
      return a <= b;
    case BinaryOperator::greater:
      return a > b;
    default:
      return a >= b;
  }
}

bool is_comparison(BinaryOperator op) {
  return op >= BinaryOperator::less && op <= BinaryOperator::greater_or_equal;
}

Value floats(BinaryOperator op, Span span, double a, double b) {
  switch (op) {
    case BinaryOperator::power:
      return elementary::pow(a, b);
    case BinaryOperator::add:
      return a + b;
    case BinaryOperator::subtract:
      return a - b;
    case BinaryOperator::multiply:
      return a * b;
    case BinaryOperator::divide:
      return a / b;
    case BinaryOperator::remainder:
      return std::fmod(a, b);
    default:
      break;
  }
  if (is_comparison(op)) return compare(op, a, b);
  wrong_types(op, span, a, b);
}

Value vectors(BinaryOperator op, Span span, const Vec3& a, const Vec3& b) {
  switch (op) {
    case BinaryOperator::add:
      return a + b;
    case BinaryOperator::subtract:
      return a - b;
    case BinaryOperator::multiply:
      return a * b;
    default:
      wrong_types(op, span, a, b);
  }
}

/// Computes with the three channels. Alpha stays the left colour's, but products multiply it.
Value colors(BinaryOperator op, Span span, const Color& a, const Color& b) {
  switch (op) {
    case BinaryOperator::add:
      return Color{a.r + b.r, a.g + b.g, a.b + b.b, a.a};
    case BinaryOperator::subtract:
      return Color{a.r - b.r, a.g - b.g, a.b - b.b, a.a};
    case BinaryOperator::multiply:
      return Color{a.r * b.r, a.g * b.g, a.b * b.b, a.a * b.a};
    default:
      wrong_types(op, span, a, b);
  }
}

Value scaled(const Vec3& v, double factor) {
  return v * factor;
}

Value scaled(const Color& c, double factor) {
  return Color{c.r * factor, c.g * factor, c.b * factor, c.a};
}

Value divided(const Vec3& v, double divisor) {
  return v / divisor;
}

Value divided(const Color& c, double divisor) {
  return Color{c.r / divisor, c.g / divisor, c.b / divisor, c.a};
}

/// Computes with a Vec3 or Color and a number on either side.
template <class Triple>
bool scale_by_number(BinaryOperator op, const Value& left, const Value& right, Value& result) {
  double storage = 0;
  if (const auto* triple = std::get_if<Triple>(&left)) {
    const double* number = as_float(right, storage);
    if (!number || (op != BinaryOperator::multiply && op != BinaryOperator::divide)) return false;
    result = op == BinaryOperator::multiply ? scaled(*triple, *number) : divided(*triple, *number);
    return true;
  }
  const auto* triple = std::get_if<Triple>(&right);
  const double* number = triple ? as_float(left, storage) : nullptr;
  if (!number || op != BinaryOperator::multiply) return false;
  result = scaled(*triple, *number);
  return true;
}

/// Computes with a field and another one or a number.
Value fields(Context& context, BinaryOperator op, Span span, const Value& left,
             const Value& right) {
  const std::optional<Field> a = as_field(left);
  const std::optional<Field> b = as_field(right);
  if (!a || !b) wrong_types(op, span, left, right);
  return make_field(context, span, [&]() -> Field {
    switch (op) {
      case BinaryOperator::power:
        return pow(*a, *b);
      case BinaryOperator::add:
        return *a + *b;
      case BinaryOperator::subtract:
        return *a - *b;
      case BinaryOperator::multiply:
        return *a * *b;
      case BinaryOperator::divide:
        return *a / *b;
      default:
        wrong_types(op, span, left, right);
    }
  });
}

Value entities(Context& context, BinaryOperator op, Span span, const Entity& a, const Entity& b) {
  context.count_made(span);
  try {
    switch (op) {
      case BinaryOperator::add: {
        Entity sum = a + b;
        context.check_size(span, sum);
        return sum;
      }
      case BinaryOperator::subtract: {
        Entity difference = a - b;
        context.check_size(span, difference);
        return difference;
      }
      case BinaryOperator::intersect: {
        Entity intersection = a ^ b;
        context.check_size(span, intersection);
        return intersection;
      }
      default:
        break;
    }
  } catch (const Error& error) {
    throw Failure{.span = span, .message = error.what(), .code = error.code()};
  }
  wrong_types(op, span, a, b);
}

Value join_strings(Context& context, Span span, const Value& left, const Value& right) {
  std::string text = text_of(context, span, left);
  text += text_of(context, span, right);
  context.check_string_size(span, text.size());
  return context.make_string(span, std::move(text));
}

Value repeat_string(Context& context, Span span, const std::string& text, std::int64_t times) {
  if (times < 0) fail(span, "a string cannot be repeated less than 0 times");
  std::uint64_t bytes = 0;
  if (__builtin_mul_overflow(text.size(), static_cast<std::uint64_t>(times), &bytes))
    bytes = std::numeric_limits<std::uint64_t>::max();
  context.check_string_size(span, bytes);
  std::string result;
  result.reserve(bytes);
  if (!text.empty()) {
    for (std::int64_t i = 0; i < times; ++i) result += text;
  }
  return context.make_string(span, std::move(result));
}

Value join_lists(Context& context, Span span, const ListValue& a, const ListValue& b) {
  context.check_list_size(span, a.items.size() + b.items.size());
  std::vector<Value> items;
  items.reserve(a.items.size() + b.items.size());
  items.insert(items.end(), a.items.begin(), a.items.end());
  items.insert(items.end(), b.items.begin(), b.items.end());
  return context.make_list(span, std::move(items));
}

/// Joins two dictionaries. Of entries with one name the right one counts.
Value join_dictionaries(Context& context, Span span, const DictionaryValue& a,
                        const DictionaryValue& b) {
  context.spend(span, a.entries.size() + b.entries.size());
  Variables entries;
  for (const auto& [name, value] : a.entries) entries.set(name, value);
  for (const auto& [name, value] : b.entries) entries.set(name, value);
  return context.make_dictionary(span, std::move(entries));
}

Value with_strings(Context& context, BinaryOperator op, Span span, const Value& left,
                   const Value& right) {
  const auto* a = std::get_if<String>(&left);
  const auto* b = std::get_if<String>(&right);
  if (op == BinaryOperator::add) return join_strings(context, span, left, right);
  if (a && b && is_comparison(op)) return compare(op, (*a)->text, (*b)->text);
  if (op == BinaryOperator::multiply) {
    const auto* times = std::get_if<std::int64_t>(a ? &right : &left);
    if (times) return repeat_string(context, span, a ? (*a)->text : (*b)->text, *times);
  }
  wrong_types(op, span, left, right);
}

/// Computes with all operands but two numbers.
Value other_types(Context& context, BinaryOperator op, Span span, const Value& left,
                  const Value& right) {
  if (std::holds_alternative<String>(left) || std::holds_alternative<String>(right))
    return with_strings(context, op, span, left, right);
  if (is_field(left) || is_field(right)) return fields(context, op, span, left, right);
  if (left.index() == right.index()) {
    if (const auto* entity = std::get_if<Entity>(&left))
      return entities(context, op, span, *entity, std::get<Entity>(right));
    if (const auto* vector = std::get_if<Vec3>(&left))
      return vectors(op, span, *vector, std::get<Vec3>(right));
    if (const auto* color = std::get_if<Color>(&left))
      return colors(op, span, *color, std::get<Color>(right));
    if (const auto* list = std::get_if<List>(&left); list && op == BinaryOperator::add)
      return join_lists(context, span, **list, *std::get<List>(right));
    const auto* dictionary = std::get_if<Dictionary>(&left);
    if (dictionary && op == BinaryOperator::add)
      return join_dictionaries(context, span, **dictionary, *std::get<Dictionary>(right));
  }
  Value result;
  if (scale_by_number<Vec3>(op, left, right, result) ||
      scale_by_number<Color>(op, left, right, result))
    return result;
  wrong_types(op, span, left, right);
}

}  // namespace

Value binary(Context& context, BinaryOperator op, Span op_span, const Value& left,
             const Value& right) {
  // Whether fields are equal depends on where.
  if (is_field(left) || is_field(right)) return other_types(context, op, op_span, left, right);
  if (op == BinaryOperator::equal) return equal(context, op_span, left, right);
  if (op == BinaryOperator::not_equal) return !equal(context, op_span, left, right);
  const auto* a = std::get_if<std::int64_t>(&left);
  const auto* b = std::get_if<std::int64_t>(&right);
  if (a && b) return integers(op, op_span, *a, *b);
  double left_room = 0;
  double right_room = 0;
  const double* x = as_float(left, left_room);
  const double* y = as_float(right, right_room);
  if (x && y) return floats(op, op_span, *x, *y);
  return other_types(context, op, op_span, left, right);
}

void append(Context& context, Span op_span, const List& list, const ListValue& more) {
  // Lists are made as what may change.
  auto& grown =
      const_cast<ListValue&>(*list);  // NOLINT(cppcoreguidelines-pro-type-const-cast): ours
  std::vector<Value>& items = grown.items;
  const std::size_t count = items.size() + more.items.size();
  context.check_list_size(op_span, count);
  context.spend_on_items(op_span, more.items);
  if (count > items.capacity()) {
    const std::size_t room = std::max(count, items.capacity() + items.capacity() / 2);
    Charge charge = context.charge_memory(op_span, (room - items.capacity()) * sizeof(Value));
    items.reserve(room);
    grown.charge.add(std::move(charge));
  }
  items.insert(items.end(), more.items.begin(), more.items.end());
  grown.depth = std::max(grown.depth, more.depth);
}

Entity union_of(Context& context, Span span, const std::vector<Entity>& parts) {
  context.count_made(span);
  try {
    Entity whole = csg_union(parts);
    context.check_size(span, whole);
    return whole;
  } catch (const Error& error) {
    throw Failure{.span = span, .message = error.what(), .code = error.code()};
  }
}

Value unary(UnaryOperator op, Span span, const Value& operand) {
  if (op == UnaryOperator::negation) {
    if (const auto* boolean = std::get_if<bool>(&operand)) return !*boolean;
    fail(span, "'!' takes a Boolean, not {}", operand);
  }
  const bool minus = op == UnaryOperator::minus;
  if (const auto* integer = std::get_if<std::int64_t>(&operand))
    return minus ? integers(BinaryOperator::subtract, span, 0, *integer) : operand;
  if (const auto* number = std::get_if<double>(&operand)) return minus ? -*number : *number;
  if (const auto* vector = std::get_if<Vec3>(&operand)) return minus ? -*vector : *vector;
  if (const auto* field = std::get_if<Field>(&operand)) return minus ? -*field : *field;
  fail(span, "a sign stands before a number or a Vec3, not {}", operand);
}

}  // namespace crt::lang
