// What the operators of table 2.1 do with values.
#pragma once

#include "lang/context.hpp"
#include "lang/syntax.hpp"
#include "lang/value.hpp"

namespace crt::lang {

/// left op right. Errors stand at the operator.
Value binary(Context& context, BinaryOperator op, Span op_span, const Value& left,
             const Value& right);

/// The operand's span is where errors stand.
Value unary(UnaryOperator op, Span span, const Value& operand);

/// base[index]: an item of a list, a component of a Vec3 or Color, a character of a string.
Value item(Context& context, Span index_span, const Value& base, const Value& index);

/// The value as `+` joins it to a string and `str` gives it.
std::string text_of(Context& context, Span span, const Value& value);

/// `==`. Values of different types are not equal, numbers aside.
bool equal(Context& context, Span span, const Value& left, const Value& right);

}  // namespace crt::lang
