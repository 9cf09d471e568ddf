#include "lang/builtins.hpp"
#include "lang/failure.hpp"
#include "lang/fields.hpp"
#include "text/format.hpp"

#include <algorithm>
#include <vector>

namespace crt::lang {

void Arguments::wrong_type(std::size_t i, std::string_view wanted) const {
  fail(span(i), "{} takes {} here, not {}", builtin_.signature, wanted, values_[i]);
}

double Arguments::number(std::size_t i) const {
  double storage = 0;
  const double* number = as_float(values_[i], storage);
  if (!number) wrong_type(i, "a number");
  if (number == &storage) context.used_as_float(span(i));
  return *number;
}

std::int64_t Arguments::integer(std::size_t i) const {
  const auto* number = std::get_if<std::int64_t>(&values_[i]);
  if (!number) wrong_type(i, "an Integer");
  return *number;
}

const ListValue& Arguments::list(std::size_t i) const {
  const auto* list = std::get_if<List>(&values_[i]);
  if (!list) wrong_type(i, "a List");
  return **list;
}

Value Arguments::call_argument(std::size_t i, std::span<const Value> values) const {
  const auto* name = std::get_if<Name>(&expressions_[i]->node);
  const std::string_view shown = name ? context.symbols.name(name->symbol) : "a macro";
  return context.call(shown, span(i), values_[i], values);
}

void Arguments::expect_radians() const {
  const auto* sign = std::get_if<Unary>(&expressions_[0]->node);
  const auto* literal = std::get_if<Literal>(&(sign ? sign->operand : expressions_[0])->node);
  const auto* whole = literal ? std::get_if<std::int64_t>(&literal->value) : nullptr;
  constexpr std::int64_t beyond_turn = 6;
  if (!whole || *whole <= beyond_turn || context.compat == compat_2015) return;
  context.reporter.warning(
      span(0),
      text::format("{} takes radians, of which 2 pi are a whole turn: for {} degrees write "
                   "{}deg",
                   builtin_.signature, *whole, *whole));
}

Vec3 Arguments::vector(std::size_t i) const {
  const auto* vector = std::get_if<Vec3>(&values_[i]);
  if (!vector) wrong_type(i, "a Vec3");
  return *vector;
}

bool Arguments::all_integers() const {
  return std::all_of(values_.begin(), values_.end(), [](const Value& value) {
    return std::holds_alternative<std::int64_t>(value);
  });
}

bool Arguments::any_field() const {
  return std::any_of(values_.begin(), values_.end(), is_field);
}

Field Arguments::field(std::size_t i) const {
  const std::optional<Field> field = as_field(values_[i]);
  if (!field) wrong_type(i, "a Field or a finite number");
  return *field;
}

std::span<const Builtin> builtins() {
  static const std::vector<Builtin> all = [] {
    std::vector<Builtin> result;
    for (const std::span<const Builtin> part :
         {number_builtins(), easing_builtins(), vector_builtins(), list_builtins(),
          string_builtins(), contour_builtins(), measure_builtins()})
      result.insert(result.end(), part.begin(), part.end());
    return result;
  }();
  return all;
}

}  // namespace crt::lang
