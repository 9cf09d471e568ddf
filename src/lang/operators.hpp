// These functions are the operators of table 2.1.
#pragma once

#include "lang/context.hpp"
#include "lang/syntax.hpp"
#include "lang/value.hpp"

namespace crt::lang {

/// Computes left op right. Errors stand at the operator.
Value binary(Context& context, BinaryOperator op, Span op_span, const Value& left,
             const Value& right);

/// Appends to a list that nobody else has, in time that depends on `more` alone but for what
/// growing takes. A list that is made item by item so takes time in proportion to its length. It
/// throws, and leaves the list as it is, where the sum would throw.
void append(Context& context, Span op_span, const List& list, const ListValue& more);

/// Computes op operand. Errors stand at the operand's span.
Value unary(UnaryOperator op, Span span, const Value& operand);

/// Returns base[index]: an item of a list, a component of a Vec3 or Color, a character of a string.
Value item(Context& context, Span index_span, const Value& base, const Value& index);

/// Returns base[first:end], of a list or a string. A bound that is left out is that end of it, and
/// one below 0 counts from the end.
Value slice(Context& context, Span span, const Value& base, std::optional<std::int64_t> first,
            std::optional<std::int64_t> end);

/// Returns the entry of a dictionary that is called so.
Value entry(Context& context, Span span, const DictionaryValue& dictionary, std::string_view name);

/// Returns the union of some entities, as one that was made at `span`.
Entity union_of(Context& context, Span span, const std::vector<Entity>& parts);

/// Returns the text of a value, as `+` joins it to a string and `str` gives it.
std::string text_of(Context& context, Span span, const Value& value);

/// Computes `==`. Values of different types are not equal, except numbers.
bool equal(Context& context, Span span, const Value& left, const Value& right);

}  // namespace crt::lang
