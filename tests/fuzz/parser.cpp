// This fuzzer parses any bytes. Lexer and parser must come back with a tree or with errors, whose
// places lie in the text.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "crt/script.hpp"
#include "lang/parser.hpp"

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

void parse(const std::string& text, crt::lang::TextKind kind, int compat) {
  crt::lang::SourceMap sources;
  crt::lang::SymbolTable symbols;
  crt::lang::Reporter reporter(sources, 20);
  std::size_t memory = 64 << 20;
  try {
    crt::lang::parse(sources.add("fuzz", text), kind, compat, symbols, reporter, memory);
  } catch (const crt::lang::GiveUp&) {
    require(reporter.has_errors());
  }
  for (const crt::Diagnostic& diagnostic : reporter.diagnostics()) {
    require(diagnostic.place.line >= 1 && diagnostic.place.column >= 1 &&
            diagnostic.place.length >= 1);
    require(!diagnostic.message.empty() && diagnostic.message.find('\n') == std::string::npos);
    require(!crt::format_diagnostic(diagnostic).empty());
  }
  crt::diagnostics_to_json(reporter.diagnostics());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const int compat : {0, crt::compat_2015}) {
    parse(text, crt::lang::TextKind::script, compat);
    parse(text, crt::lang::TextKind::expression, compat);
  }
  return 0;
}
