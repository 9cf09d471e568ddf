#include "lang/interpreter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <string_view>
#include <utility>

#include "lang/builtins.hpp"
#include "lang/failure.hpp"
#include "lang/suggestion.hpp"

namespace crt::lang {

namespace {

/// A script may take so much of the C++ stack, so that it fits on any thread's.
constexpr std::uintptr_t stack_budget_bytes = 1 << 20;

using Hint = std::pair<std::string_view, std::string_view>;

constexpr std::string_view how_to_set = "; a variable is set by its name alone: x = 1";
constexpr std::string_view how_to_write_macros = "; a macro is written f = Macro (x) { ... }";
constexpr std::string_view no_null =
    "; there is no value for nothing; leave the attribute out, or use an empty List";

/// Says how CRT writes what a word means in other languages. Any of them may be a variable's name.
constexpr std::array foreign_hints = {
    Hint{"let", how_to_set},
    Hint{"var", how_to_set},
    Hint{"const", how_to_set},
    Hint{"local", how_to_set},
    Hint{"declare", how_to_set},
    Hint{"def", how_to_write_macros},
    Hint{"function", how_to_write_macros},
    Hint{"func", how_to_write_macros},
    Hint{"fn", how_to_write_macros},
    Hint{"and", "; 'and' is written '&&'"},
    Hint{"or", "; 'or' is written '||'"},
    Hint{"not", "; 'not' is written '!'"},
    Hint{"null", no_null},
    Hint{"nil", no_null},
    Hint{"none", no_null},
    Hint{"undefined", no_null},
    Hint{"new", "; objects are written without 'new': Sphere { ... }"},
    Hint{"break", "; a loop ends when its condition is false or its List is at its end"},
    Hint{"continue", "; put the rest of the loop's body into an 'if'"},
    Hint{"union", "; the union of two entities is a + b"},
    Hint{"difference", "; the difference of two entities is a - b"},
    Hint{"intersection", "; the intersection of two entities is a ^ b"},
};

std::string_view foreign_hint(std::string_view word) {
  const auto* found = std::find_if(foreign_hints.begin(), foreign_hints.end(),
                                   [word](const Hint& hint) { return hint.first == word; });
  return found == foreign_hints.end() ? std::string_view() : found->second;
}

std::uintptr_t stack_position() {
  return reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
}

}  // namespace

Interpreter::Interpreter(Context& context)
    : context_(context),
      stack_start_(stack_position()),
      universe_(std::make_shared<Scope>(Scope::Kind::border, nullptr)),
      globals_(std::make_shared<Scope>(Scope::Kind::border, universe_)),
      scope_(globals_) {
  for (const Builtin& builtin : builtins())
    universe_->set(context.symbols.intern(builtin.name), &builtin);
  universe_->set(context.symbols.intern("pi"), std::numbers::pi);
  universe_->set(context.symbols.intern("t"), context.options.t);
}

Interpreter::~Interpreter() {
  globals_->clear();
  for (auto& [scope, charge] : captured_) scope->clear();
}

void Interpreter::override_variable(Symbol name, Value value) {
  globals_->set(name, std::move(value));
  overridden_.insert(name);
}

void Interpreter::check_stack(Span span) const {
  const std::uintptr_t here = stack_position();
  const std::uintptr_t used = here < stack_start_ ? stack_start_ - here : here - stack_start_;
  if (used > stack_budget_bytes) [[unlikely]]
    context_.pass_limit(span, "calls and expressions are nested too deeply");
}

void Interpreter::unknown_name(Symbol name, Span span) const {
  std::vector<std::string_view> names;
  for (const Scope* scope = scope_.get(); scope; scope = scope->parent()) {
    for (const auto& [symbol, value] : scope->variables())
      names.push_back(context_.symbols.name(symbol));
  }
  const std::string_view text = context_.symbols.name(name);
  const std::string_view hint = foreign_hint(text);
  fail(span, "unknown name '{}'{}", text,
       hint.empty() ? did_you_mean(text, names) : std::string(hint));
}

/// Keeps all scopes that a macro can see, where it is made.
void Interpreter::capture_scopes(Span span) {
  constexpr std::size_t about_a_scope = 256;
  for (std::shared_ptr<Scope> scope = scope_; scope && !scope->is_captured();
       scope = scope->shared_parent()) {
    scope->set_captured();
    captured_.emplace_back(scope, context_.charge_memory(span, about_a_scope));
  }
}

}  // namespace crt::lang
