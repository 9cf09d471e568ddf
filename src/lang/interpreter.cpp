#include "lang/interpreter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "lang/builtins.hpp"
#include "lang/failure.hpp"

namespace crt::lang {

namespace {

/// A script may take so much of the C++ stack, so that it fits on any thread's.
constexpr std::uintptr_t stack_budget_bytes = 1 << 20;

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
