#include "lang/reporter.hpp"

namespace crt::lang {

void Failure::add_call(std::string_view name, Span call) {
  calls.emplace_back(name, call);
}

Diagnostic Reporter::make(Severity severity, Span span, std::string message, ErrorCode code) const {
  Diagnostic diagnostic;
  diagnostic.severity = severity;
  diagnostic.code = code;
  diagnostic.message = std::move(message);
  diagnostic.place = sources_.place(span);
  diagnostic.source_line = sources_.line_text(span);
  return diagnostic;
}

void Reporter::error(const Failure& failure) {
  Diagnostic diagnostic = make(Severity::error, failure.span, failure.message, failure.code);
  for (const auto& [name, span] : failure.calls)
    diagnostic.calls.emplace_back(name, sources_.place(span));
  diagnostics_.push_back(std::move(diagnostic));
  if (++error_count_ >= max_errors_) throw GiveUp{};
}

void Reporter::error(Span span, std::string message, ErrorCode code) {
  error(Failure{.span = span, .message = std::move(message), .code = code});
}

void Reporter::warning(Span span, std::string message) {
  if (warned_.size() >= max_errors_ || !warned_.emplace(span.begin, message).second) return;
  diagnostics_.push_back(make(Severity::warning, span, std::move(message), ErrorCode::script));
}

}  // namespace crt::lang
