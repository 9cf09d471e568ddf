// This file has the interpreter's calls of built-ins and of macros, as statements and as values.
#include <algorithm>

#include "lang/builtins.hpp"
#include "lang/failure.hpp"
#include "lang/interpreter.hpp"
#include "text/format.hpp"

namespace crt::lang {

namespace {

/// Removes what a call has put onto the stack of arguments.
class ArgumentsGuard {
 public:
  explicit ArgumentsGuard(std::vector<Value>& arguments)
      : arguments_(arguments), begin_(arguments.size()) {}
  ArgumentsGuard(const ArgumentsGuard&) = delete;
  ArgumentsGuard& operator=(const ArgumentsGuard&) = delete;
  ~ArgumentsGuard() { arguments_.resize(begin_); }

  std::span<const Value> values() const {
    return std::span<const Value>(arguments_).subspan(begin_);
  }

 private:
  std::vector<Value>& arguments_;
  std::size_t begin_;
};

class DepthGuard {
 public:
  explicit DepthGuard(std::size_t& depth) : depth_(depth) { ++depth; }
  DepthGuard(const DepthGuard&) = delete;
  DepthGuard& operator=(const DepthGuard&) = delete;
  ~DepthGuard() { --depth_; }

 private:
  std::size_t& depth_;
};

}  // namespace

std::string parameter_list(const SymbolTable& symbols, const MacroValue& macro) {
  std::string list;
  for (const NamePlace& parameter : macro.literal->parameters)
    list += text::format("{}{}", list.empty() ? "" : ", ", symbols.name(parameter.symbol));
  return text::format("({})", list);
}

std::string_view Interpreter::callee_name(const Call& call) const {
  const auto* name = std::get_if<Name>(&call.callee->node);
  return name ? context_.symbols.name(name->symbol) : "a macro";
}

void Interpreter::not_callable(const Call& call, const Value& callee) const {
  fail(call.callee->span, "only a Macro can be called, not {}", callee);
}

[[gnu::noinline]] Value Interpreter::evaluate_node(const Call& call, const Expression& expression) {
  const Value callee = evaluate(*call.callee);
  if (const auto* builtin = std::get_if<const Builtin*>(&callee))
    return call_builtin(expression, call, **builtin);
  const auto* macro = std::get_if<Macro>(&callee);
  if (!macro) not_callable(call, callee);
  return value_of_call(expression, call, **macro);
}

[[gnu::noinline]] Value Interpreter::call_builtin(const Expression& expression, const Call& call,
                                                  const Builtin& builtin) {
  const std::size_t count = call.arguments.size();
  if (count < builtin.least_arguments || count > builtin.max_arguments) {
    fail(expression.span, "wrong number of arguments, {}: {}", count, builtin.signature);
  }
  const ArgumentsGuard guard(arguments_);
  for (const Expression* argument : call.arguments) {
    arguments_.push_back(evaluate(*argument));
    if (std::holds_alternative<Nothing>(arguments_.back()))
      fail(argument->span, "this call has no value");
  }
  return builtin.function(
      Arguments(context_, builtin, expression.span, guard.values(), call.arguments));
}

/// Refuses arguments that are given by name, as other languages have them: they would be taken for
/// assignments where the call stands, and their values for those of other parameters.
[[gnu::noinline]] void Interpreter::complain_of_name(const Assignment& assignment,
                                                     const MacroValue& macro) const {
  const std::vector<NamePlace>& parameters = macro.literal->parameters;
  const bool is_parameter = std::any_of(
      parameters.begin(), parameters.end(),
      [&](const NamePlace& parameter) { return parameter.symbol == assignment.name.symbol; });
  const Span span = assignment.name.span;
  if (is_parameter) {
    const std::string message =
        text::format("arguments have no names: give them in the order of the parameters {}",
                     parameter_list(context_.symbols, macro));
    if (context_.compat != compat_2015) throw Failure{.span = span, .message = message};
    context_.reporter.warning(span, message);
  } else if (context_.compat != compat_2015) {
    context_.reporter.warning(
        span,
        text::format("arguments have no names: this sets the variable '{}' outside of the call",
                     context_.symbols.name(assignment.name.symbol)));
  }
}

/// Makes the scope of a call, with the parameters bound to the arguments.
[[gnu::noinline]] std::shared_ptr<Scope> Interpreter::bind_arguments(const Expression& expression,
                                                                     const Call& call,
                                                                     const MacroValue& macro) {
  const std::vector<NamePlace>& parameters = macro.literal->parameters;
  const std::size_t count = parameters.size();
  for (const Expression* argument : call.arguments) {
    const auto* assignment = std::get_if<Assignment>(&argument->node);
    if (assignment) complain_of_name(*assignment, macro);
  }
  if (call.arguments.size() != count) {
    fail(expression.span, "'{}' takes {} argument{}, and this call has {}", callee_name(call),
         count, count == 1 ? "" : "s", call.arguments.size());
  }
  auto scope = std::make_shared<Scope>(Scope::Kind::border, macro.scope);
  for (std::size_t i = 0; i < count; ++i) {
    Value argument = evaluate(*call.arguments[i]);
    if (std::holds_alternative<Nothing>(argument))
      fail(call.arguments[i]->span, "this call has no value");
    scope->set(parameters[i].symbol, std::move(argument));
  }
  return scope;
}

[[gnu::noinline]] void Interpreter::pass_call_depth(Span span) const {
  context_.pass_limit(
      span, text::format("macros call one another more than {} deep", context_.limits.call_depth));
}

/// Runs a macro. Returns what it returns, or nothing if it does not.
[[gnu::noinline]] Value Interpreter::call_macro(const Expression& expression, const Call& call,
                                                const MacroValue& macro) {
  const Temporarily inside(scope_, bind_arguments(expression, call, macro));
  const Context::Running running(context_, {.name = callee_name(call), .span = expression.span});
  if (call_depth_ >= context_.limits.call_depth) pass_call_depth(expression.span);
  const DepthGuard depth(call_depth_);
  const Temporarily result(result_, Result{.entities_before = emission_.entities->size()});
  try {
    execute(macro.literal->body);
    return std::move(result_.value);
  } catch (Failure& failure) {
    failure.add_call(callee_name(call), expression.span);
    throw;
  }
}

/// Evaluates a macro's call as a value: what it returns, or the group of what it emits.
[[gnu::noinline]] Value Interpreter::value_of_call(const Expression& expression, const Call& call,
                                                   const MacroValue& macro) {
  std::vector<Entity> parts;
  {
    const Temporarily emission(emission_, Emission{.entities = &parts});
    Value value = call_macro(expression, call, macro);
    if (!std::holds_alternative<Nothing>(value)) return value;
  }
  if (parts.empty()) {
    fail(expression.span, "'{}' emitted and returned nothing, so its call has no value",
         callee_name(call));
  }
  context_.count_made(expression.span);
  try {
    Entity whole = csg_union(parts);
    context_.check_size(expression.span, whole);
    return whole;
  } catch (const Error& error) {
    throw Failure{.span = expression.span, .message = error.what(), .code = error.code()};
  }
}

}  // namespace crt::lang
