#include "lang/interpreter.hpp"

#include <pthread.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "lang/builtins.hpp"
#include "lang/failure.hpp"
#include "text/format.hpp"

namespace crt::lang {

namespace {

std::uintptr_t stack_position() {
  return reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
}

/// Returns how much of this thread's stack is below a place. It grows downwards.
std::uintptr_t stack_below(std::uintptr_t place) {
  constexpr std::uintptr_t of_unknown = std::uintptr_t{256} << 10;  // a fiber's, for example
  pthread_attr_t attributes;
  if (pthread_getattr_np(pthread_self(), &attributes) != 0) return of_unknown;
  void* lowest = nullptr;
  std::size_t size = 0;
  const bool is_known = pthread_attr_getstack(&attributes, &lowest, &size) == 0;
  pthread_attr_destroy(&attributes);
  const auto begin = reinterpret_cast<std::uintptr_t>(lowest);
  return is_known && place >= begin && place - begin < size ? place - begin : of_unknown;
}

/// Returns the place on the stack that a script may reach which starts here. It may take a
/// megabyte, or what the thread has but for what the deepest call of the library takes.
std::uintptr_t end_of_stack() {
  constexpr std::uintptr_t most_bytes = 1 << 20;
  constexpr std::uintptr_t for_calls = std::uintptr_t{64} << 10;
  const std::uintptr_t here = stack_position();
  const std::uintptr_t below = stack_below(here);
  return here - std::min(most_bytes, below - std::min(below, for_calls));
}

}  // namespace

Interpreter::Interpreter(Context& context)
    : context_(context),
      stack_end_(end_of_stack()),
      universe_(std::make_shared<Scope>(Scope::Kind::border, nullptr)),
      globals_(std::make_shared<Scope>(Scope::Kind::border, universe_)),
      scope_(globals_) {
  context.call = [this](std::string_view name, Span call, const Value& callee,
                        std::span<const Value> arguments) {
    Value value = call_value({.name = name, .span = call}, callee, arguments);
    if (std::holds_alternative<Nothing>(value)) fail(call, "this call has no value");
    return value;
  };
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
  if (stack_position() < stack_end_) [[unlikely]]
    context_.pass_limit(span,
                        "calls and expressions are nested too deeply for this thread's stack");
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
