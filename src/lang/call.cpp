// This file has the interpreter's calls of built-ins and of macros, as statements and as values.
#include <algorithm>

#include "lang/builtins.hpp"
#include "lang/failure.hpp"
#include "lang/interpreter.hpp"
#include "lang/operators.hpp"
#include "lang/suggestion.hpp"
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

std::string parameter_list(const Context& context, const MacroValue& macro) {
  constexpr std::size_t longest_default = 20;
  const Parameters& parameters = macro.literal->parameters;
  std::string list;
  for (std::size_t i = 0; i < parameters.names.size(); ++i) {
    if (i > 0) list += ", ";
    list += context.symbols.name(parameters.names[i].symbol);
    const Expression* const value = parameters.defaults[i];
    if (!value) continue;
    const std::string_view text = context.sources.text(value->span);
    list += text::format(" -> {}", text.size() > longest_default ? "..." : text);
  }
  return text::format("({})", list);
}

std::string_view Interpreter::callee_name(const Call& call) const {
  if (const auto* name = std::get_if<Name>(&call.callee->node))
    return context_.symbols.name(name->symbol);
  const auto* member = std::get_if<Member>(&call.callee->node);
  return member ? context_.symbols.name(member->name.symbol) : "a macro";
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
  const CallSite site{callee_name(call), expression.span};
  return value_of_call(site, **macro, bind_arguments(site, call, **macro));
}

[[gnu::noinline]] Value Interpreter::call_builtin(const Expression& expression, const Call& call,
                                                  const Builtin& builtin) {
  const std::size_t count = call.arguments.size();
  if (count < builtin.least_arguments || count > builtin.max_arguments) {
    fail(expression.span, "wrong number of arguments, {}: {}", count, builtin.signature);
  }
  if (!call.names.empty()) {
    fail(call.names[0].span,
         "the arguments of a built-in have no names: give them in the order of {}",
         builtin.signature);
  }
  const ArgumentsGuard guard(arguments_);
  for (const Expression* argument : call.arguments) arguments_.push_back(evaluate_value(*argument));
  // What is called by a built-in has arguments, too, which may move those that are here.
  std::vector<Value> own;
  if (builtin.calls_others) own.assign(guard.values().begin(), guard.values().end());
  return builtin.function(Arguments(
      context_, builtin, expression.span,
      builtin.calls_others ? std::span<const Value>(own) : guard.values(), call.arguments));
}

/// Calls what a built-in was given, with values.
[[gnu::noinline]] Value Interpreter::call_value(const CallSite& site, const Value& callee,
                                                std::span<const Value> arguments) {
  check_stack(site.span);
  context_.step(site.span);
  if (const auto* builtin = std::get_if<const Builtin*>(&callee)) {
    const std::size_t count = arguments.size();
    if (count < (*builtin)->least_arguments || count > (*builtin)->max_arguments)
      fail(site.span, "wrong number of arguments, {}: {}", count, (*builtin)->signature);
    const Expression place{.span = site.span, .node = {}};
    const std::vector<const Expression*> places(count, &place);
    return (*builtin)->function(Arguments(context_, **builtin, site.span, arguments, places));
  }
  const auto* macro = std::get_if<Macro>(&callee);
  if (!macro) fail(site.span, "only a Macro can be called, not {}", callee);
  const std::vector<NamePlace>& names = (*macro)->literal->parameters.names;
  check_number(site, arguments.size(), **macro);
  auto scope = std::make_shared<Scope>(Scope::Kind::border, (*macro)->scope);
  for (std::size_t i = 0; i < arguments.size(); ++i) scope->set(names[i].symbol, arguments[i]);
  check_given(site, **macro, *scope);
  return value_of_call(site, **macro, std::move(scope));
}

/// Refuses arguments that are given by '=', as other languages have them: they would be taken for
/// assignments where the call stands, and their values for those of other parameters.
[[gnu::noinline]] void Interpreter::complain_of_name(const Assignment& assignment,
                                                     const MacroValue& macro) const {
  const std::vector<NamePlace>& parameters = macro.literal->parameters.names;
  const bool is_parameter = std::any_of(
      parameters.begin(), parameters.end(),
      [&](const NamePlace& parameter) { return parameter.symbol == assignment.name.symbol; });
  const Span span = assignment.name.span;
  const std::string_view name = context_.symbols.name(assignment.name.symbol);
  if (is_parameter) {
    const std::string message =
        text::format("an argument is named with '->', as in {} -> 1: the parameters are {}", name,
                     parameter_list(context_, macro));
    if (context_.compat != compat_2015) throw Failure{.span = span, .message = message};
    context_.reporter.warning(span, message);
  } else if (context_.compat != compat_2015) {
    context_.reporter.warning(
        span, text::format("an argument is named with '->': this sets the variable '{}' outside of "
                           "the call",
                           name));
  }
}

/// Complains of too many arguments, and where each parameter needs one, of too few.
void Interpreter::check_number(const CallSite& site, std::size_t arguments,
                               const MacroValue& macro) const {
  const auto& [names, defaults] = macro.literal->parameters;
  const std::size_t count = names.size();
  if (arguments == count) return;
  if (std::all_of(defaults.begin(), defaults.end(), [](const auto* value) { return !value; })) {
    fail(site.span, "'{}' takes {} argument{}, and this call has {}", site.name, count,
         count == 1 ? "" : "s", arguments);
  }
  if (arguments < count) return;
  fail(site.span, "'{}' takes at most {} argument{}, and this call has {}: {}", site.name, count,
       count == 1 ? "" : "s", arguments, parameter_list(context_, macro));
}

/// Finds the parameter that an argument names.
std::size_t Interpreter::parameter_of(const CallSite& site, const NamePlace& argument,
                                      const MacroValue& macro) const {
  const std::vector<NamePlace>& parameters = macro.literal->parameters.names;
  const auto found =
      std::find_if(parameters.begin(), parameters.end(),
                   [&](const NamePlace& parameter) { return parameter.symbol == argument.symbol; });
  const auto index = static_cast<std::size_t>(found - parameters.begin());
  context_.spend(argument.span, index / items_per_step);
  if (index < parameters.size()) return index;
  std::vector<std::string_view> names;
  names.reserve(parameters.size());
  for (const NamePlace& parameter : parameters)
    names.push_back(context_.symbols.name(parameter.symbol));
  const std::string_view name = context_.symbols.name(argument.symbol);
  const std::string hint = did_you_mean(name, names);
  fail(argument.span, "'{}' has no parameter '{}'{}", site.name, name,
       hint.empty() ? text::format("; it has {}", parameter_list(context_, macro)) : hint);
}

/// Makes the scope of a call, with parameters bound to the arguments that are given.
[[gnu::noinline]] std::shared_ptr<Scope> Interpreter::bind_arguments(const CallSite& site,
                                                                     const Call& call,
                                                                     const MacroValue& macro) {
  const std::vector<NamePlace>& parameters = macro.literal->parameters.names;
  for (const Expression* argument : call.arguments) {
    const auto* assignment = std::get_if<Assignment>(&argument->node);
    if (assignment) complain_of_name(*assignment, macro);
  }
  const std::size_t unnamed = call.unnamed();
  check_number(site, call.arguments.size(), macro);
  auto scope = std::make_shared<Scope>(Scope::Kind::border, macro.scope);
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    std::size_t parameter = i;
    if (i >= unnamed) {
      const NamePlace& name = call.names[i - unnamed];
      parameter = parameter_of(site, name, macro);
      if (parameter < unnamed)
        fail(name.span, "the argument '{}' is given twice", context_.symbols.name(name.symbol));
    }
    const Symbol symbol = parameters[parameter].symbol;
    scope->set(symbol, evaluate_value(*call.arguments[i]));
    context_.note_variable(symbol, call.arguments[i]->span);
  }
  if (scope->variables().size() < parameters.size()) check_given(site, macro, *scope);
  return scope;
}

/// Complains of a parameter that has neither an argument nor a default.
void Interpreter::check_given(const CallSite& site, const MacroValue& macro,
                              const Scope& scope) const {
  const auto& [names, defaults] = macro.literal->parameters;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (defaults[i] || scope.has(names[i].symbol)) continue;
    fail(site.span, "'{}' needs the argument '{}': {}", site.name,
         context_.symbols.name(names[i].symbol), parameter_list(context_, macro));
  }
}

/// Binds the parameters that no argument is given for to their defaults.
[[gnu::noinline]] void Interpreter::bind_defaults(const MacroValue& macro, Scope& scope) {
  const auto& [names, defaults] = macro.literal->parameters;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!scope.has(names[i].symbol)) scope.set(names[i].symbol, evaluate_value(*defaults[i]));
  }
}

[[gnu::noinline]] void Interpreter::pass_call_depth(Span span) const {
  context_.pass_limit(
      span, text::format("macros call one another more than {} deep", context_.limits.call_depth));
}

/// Runs a macro in the scope of its arguments. Returns what it returns, or nothing if it does not.
[[gnu::noinline]] Value Interpreter::call_macro(const CallSite& site, const MacroValue& macro,
                                                std::shared_ptr<Scope> scope) {
  const Temporarily inside(scope_, std::move(scope));
  const Context::Running running(context_, {.name = site.name, .span = site.span});
  if (call_depth_ >= context_.limits.call_depth) pass_call_depth(site.span);
  const DepthGuard depth(call_depth_);
  const Temporarily result(result_, Result{.entities_before = emission_.entities->size()});
  try {
    if (scope_->variables().size() < macro.literal->parameters.names.size())
      bind_defaults(macro, *scope_);
    execute(macro.literal->body);
    return std::move(result_.value);
  } catch (Failure& failure) {
    failure.add_call(site.name, site.span);
    throw;
  }
}

/// Evaluates a macro's call as a value: what it returns, or the group of what it emits.
[[gnu::noinline]] Value Interpreter::value_of_call(const CallSite& site, const MacroValue& macro,
                                                   std::shared_ptr<Scope> scope) {
  std::vector<Entity> parts;
  {
    const Temporarily emission(emission_, Emission{.entities = &parts});
    Value value = call_macro(site, macro, std::move(scope));
    if (!std::holds_alternative<Nothing>(value)) return value;
  }
  if (parts.empty()) {
    fail(site.span, "'{}' emitted and returned nothing, so its call has no value", site.name);
  }
  return union_of(context_, site.span, parts);
}

}  // namespace crt::lang
