// Where a field is asked for, x, y and z are values of the type Field, and so is what is computed
// of them. A number counts as a field.
#pragma once

#include <optional>
#include <utility>

#include "crt/error.hpp"
#include "crt/field.hpp"
#include "lang/context.hpp"
#include "lang/value.hpp"

namespace crt::lang {

inline bool is_field(const Value& value) {
  return std::holds_alternative<Field>(value);
}

/// Returns a field or a finite number as a field, or nothing for any other value.
std::optional<Field> as_field(const Value& value);

/// Each operation of a field takes memory that stays, and costs as much as so many expressions.
constexpr std::size_t steps_per_field = 16;

/// Returns what make() makes. Its errors are at `span`.
template <class Make>
Value make_field(Context& context, Span span, const Make& make) {
  context.spend(span, steps_per_field);
  try {
    return make();
  } catch (const Error& error) {
    throw Failure{.span = span, .message = error.what(), .code = error.code()};
  }
}

}  // namespace crt::lang
