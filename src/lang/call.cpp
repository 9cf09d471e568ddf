// The interpreter's calls: of built-ins and of macros, as statements and as values.
#include <fmt/format.h>

#include "lang/builtins.hpp"
#include "lang/interpreter.hpp"

namespace crt::lang {

namespace {

/// "1 argument", "2 arguments"
std::string count_of_arguments(std::size_t count) {
  return fmt::format("{} argument{}", count, count == 1 ? "" : "s");
}

/// Takes what a call has put onto the stack of arguments off again.
class ArgumentsGuard {
 public:
  explicit ArgumentsGuard(std::vector<Value>& arguments) : arguments_(arguments), begin_(arguments.size()) {}
  ArgumentsGuard(const ArgumentsGuard&) = delete;
  ArgumentsGuard& operator=(const ArgumentsGuard&) = delete;
  ~ArgumentsGuard() { arguments_.resize(begin_); }

  std::span<const Value> values() const { return std::span<const Value>(arguments_).subspan(begin_); }

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

std::string_view Interpreter::callee_name(const Call& call) const {
  const auto* name = std::get_if<Name>(&call.callee->node);
  return name ? context_.symbols.name(name->symbol) : "a macro";
}

void Interpreter::not_callable(const Call& call, const Value& callee) const {
  throw Failure{.span = call.callee->span,
                .message = fmt::format("only a Macro can be called, not {}", type_with_article(callee))};
}

[[gnu::noinline]] Value Interpreter::evaluate_node(const Call& call, const Expression& expression) {
  const Value callee = evaluate(*call.callee);
  if (const auto* builtin = std::get_if<const Builtin*>(&callee))
    return call_builtin(expression, call, **builtin);
  const auto* macro = std::get_if<Macro>(&callee);
  if (!macro) not_callable(call, callee);
  return group(expression, call, **macro);
}

[[gnu::noinline]] Value Interpreter::call_builtin(const Expression& expression, const Call& call,
                                                  const Builtin& builtin) {
  const std::size_t count = call.arguments.size();
  if (count < builtin.least_arguments || count > builtin.most_arguments) {
    throw Failure{.span = expression.span,
                  .message = fmt::format("wrong number of arguments, {}: {}", count, builtin.signature)};
  }
  const ArgumentsGuard guard(arguments_);
  for (const Expression* argument : call.arguments) arguments_.push_back(evaluate(*argument));
  return builtin.function(Arguments(context_, builtin, expression.span, guard.values(), call.arguments));
}

[[gnu::noinline]] void Interpreter::call_macro(const Expression& expression, const Call& call,
                                               const MacroValue& macro) {
  const std::vector<NamePlace>& parameters = macro.literal->parameters;
  const std::string_view name = callee_name(call);
  if (call.arguments.size() != parameters.size()) {
    throw Failure{.span = expression.span,
                  .message = fmt::format("'{}' takes {}, and this call has {}", name,
                                         count_of_arguments(parameters.size()), call.arguments.size())};
  }
  auto scope = std::make_shared<Scope>(Scope::Kind::border, macro.scope);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    Value argument = evaluate(*call.arguments[i]);
    if (std::holds_alternative<Nothing>(argument))
      throw Failure{.span = call.arguments[i]->span, .message = "this call has no value"};
    scope->set(parameters[i].symbol, std::move(argument));
  }
  run_macro(expression.span, name, macro, std::move(scope));
}

[[gnu::noinline]] void Interpreter::run_macro(Span span, std::string_view name, const MacroValue& macro,
                                              std::shared_ptr<Scope> scope) {
  const Context::Running running(context_, {.name = name, .span = span});
  if (call_depth_ >= context_.limits.call_depth)
    context_.pass_limit(span,
                        fmt::format("macros call one another more than {} deep", context_.limits.call_depth));
  const DepthGuard depth(call_depth_);
  try {
    execute_in(macro.literal->body, std::move(scope));
  } catch (Failure& failure) {
    failure.calls.emplace_back(name, span);
    throw;
  }
}

/// A macro's call as a value: the group of what it emits.
[[gnu::noinline]] Value Interpreter::group(const Expression& expression, const Call& call,
                                           const MacroValue& macro) {
  std::vector<Entity> parts;
  {
    const Temporarily emission(emission_, Emission{.entities = &parts});
    call_macro(expression, call, macro);
  }
  if (parts.empty()) {
    throw Failure{
        .span = expression.span,
        .message = fmt::format("'{}' emitted nothing, so its call has no value", callee_name(call))};
  }
  context_.count_made(expression.span);
  Entity whole = csg_union(parts);
  context_.check_size(expression.span, whole);
  return whole;
}

}  // namespace crt::lang
