#include "lang/fields.hpp"

#include <cmath>
#include <string>
#include <string_view>

#include "lang/check.hpp"
#include "lang/failure.hpp"
#include "lang/interpreter.hpp"
#include "lang/parser.hpp"
#include "text/format.hpp"

namespace crt {

namespace lang {

std::optional<Field> as_field(const Value& value) {
  if (const auto* field = std::get_if<Field>(&value)) return *field;
  double storage = 0;
  const double* number = as_float(value, storage);
  if (number == nullptr || !std::isfinite(*number)) return std::nullopt;
  return Field(*number);
}

namespace {

/// Evaluates the expression in a source. Returns nothing after an error.
std::optional<Field> field_of(const Source& source, Context& context) {
  std::size_t memory_left = context.limits.memory_bytes;
  Script script =
      parse(source, TextKind::expression, 0, context.symbols, context.reporter, memory_left);
  if (context.reporter.has_errors()) return std::nullopt;
  check(script, 0, context.symbols, context.reporter);
  if (context.reporter.has_errors()) return std::nullopt;
  Interpreter interpreter(context);
  const Value value = interpreter.evaluate_field(*script.expression);
  std::optional<Field> field = as_field(value);
  if (!field) fail(script.expression->span, "a field is a Field or a finite number, not {}", value);
  return field;
}

}  // namespace

}  // namespace lang

Field parse_field(std::string_view text) {
  const ScriptOptions options;
  lang::SourceMap sources;
  lang::SymbolTable symbols;
  lang::Reporter reporter(sources, 1);
  lang::Context context(options, symbols, sources, reporter);
  if (text.size() > context.limits.source_bytes) {
    throw Error(ErrorCode::limit,
                text::format("field is longer than {} bytes", context.limits.source_bytes),
                "field");
  }
  try {
    const lang::Source& source = sources.add("field", std::string(text));
    try {
      if (const std::optional<Field> field = lang::field_of(source, context)) return *field;
    } catch (const lang::Failure& failure) {
      reporter.error(failure);
    }
  } catch (const lang::GiveUp&) {
    // It was reported.
  }
  for (const Diagnostic& diagnostic : reporter.diagnostics()) {
    if (diagnostic.severity != Severity::error) continue;
    throw Error(diagnostic.code,
                text::format("field:{}:{}: {}", diagnostic.place.line, diagnostic.place.column,
                             diagnostic.message),
                "field");
  }
  throw Error(ErrorCode::script, "field cannot be read", "field");
}

}  // namespace crt
