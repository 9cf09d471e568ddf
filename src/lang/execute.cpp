// This file has the interpreter's statements.
#include <algorithm>
#include <string_view>

#include "lang/check.hpp"
#include "lang/failure.hpp"
#include "lang/interpreter.hpp"
#include "lang/settings.hpp"
#include "lang/word_byte.hpp"
#include "text/format.hpp"

namespace crt::lang {

namespace {

/// Says whether what follows a number is a '--' that was hardly meant as a comment: it touches the
/// number, or no words are in the comment. `crt format` moves it away from the number.
bool is_decrement(std::string_view behind) {
  constexpr std::string_view sign = "--";
  if (behind.starts_with(sign)) return true;
  const std::size_t comment = behind.find_first_not_of(" \t");
  if (comment == std::string_view::npos || !behind.substr(comment).starts_with(sign)) return false;
  const std::string_view text = behind.substr(comment + sign.size());
  return text.empty() || std::string_view("\r\n;,)]}").find(text.front()) != std::string_view::npos;
}

}  // namespace

void Interpreter::run(const Script& script, bool is_import) {
  has_begun_ = true;
  scripts_.push_back(&script);
  const Temporarily imports(is_import_, is_import);
  for (const Statement& statement : script.statements.statements) attempt(statement);
}

Value Interpreter::run_apart(const Script& script, Span span) {
  auto scope = std::make_shared<Scope>(Scope::Kind::border, universe_);
  const Temporarily inside(scope_, scope);
  const Temporarily level(top_level_, top_levels_++);
  run(script, true);
  Variables entries;
  for (const auto& [name, value] : scope->variables()) entries.set(name, value);
  return context_.make_dictionary(span, std::move(entries));
}

void Interpreter::set_variable(Symbol name, const Value& value) {
  scope_->target_of(name).set(name, value);
}

/// Runs a statement whose failure leaves the next ones worth running, so that a run reports several
/// errors.
void Interpreter::attempt(const Statement& statement) {
  try {
    execute(statement);
    return;
  } catch (const Failure& failure) {
    context_.reporter.error(failure);
    if (ends_script(failure)) throw GiveUp{};
  } catch (const Abandoned&) {
    // The error is reported already.
  }
  mark_unknown(statement);
}

/// Names that the failed statement should have set are not to be called unknown later.
void Interpreter::mark_unknown(const Statement& statement) {
  std::set<Symbol> names;
  collect_assigned(statement, names);
  for (const Symbol name : names) {
    Scope& target = scope_->target_of(name);
    if (!target.has(name)) target.set(name, Unknown{});
  }
}

void Interpreter::execute(const Block& block) {
  for (const Statement& statement : block.statements) {
    execute(statement);
    if (result_.leaving != Leaving::nothing) return;
  }
}

void Interpreter::execute(const Statement& statement) {
  check_stack(statement.span);
  if (call_depth_ == 0) statement_ = statement.span;
  std::visit([this](const auto& node) { execute_node(node); }, statement.node);
}

void Interpreter::execute_in(const Block& block, std::shared_ptr<Scope> scope) {
  const Temporarily inside(scope_, std::move(scope));
  execute(block);
}

/// Returns a scope for a body: the one of the round before, unless a macro captured it.
std::shared_ptr<Scope> Interpreter::fresh_scope(std::shared_ptr<Scope> used) {
  if (!used || used->is_captured()) return std::make_shared<Scope>(Scope::Kind::block, scope_);
  used->clear();
  return used;
}

bool Interpreter::condition(const Expression& expression, const char* what) {
  const Value value = evaluate(expression);
  if (const auto* boolean = std::get_if<bool>(&value)) return *boolean;
  const bool assigns = std::holds_alternative<Assignment>(expression.node);
  fail(expression.span, "the condition of {} must be a Boolean, not {}{}", what, value,
       assigns ? "; to compare, write '=='" : "");
}

/// Says, behind a round of a loop, whether it was the last one.
bool Interpreter::leaves_loop() {
  if (result_.leaving == Leaving::nothing) return false;
  const bool ends_round = result_.leaving == Leaving::round;
  if (result_.leaving != Leaving::macro) result_.leaving = Leaving::nothing;
  return !ends_round;
}

/// Binds a name to a value, or several names to its items.
void Interpreter::bind_names(Scope& scope, const std::vector<NamePlace>& names, const Value& value,
                             Span span) {
  if (names.size() == 1) return scope.set(names[0].symbol, value);
  const List* list = std::get_if<List>(&value);
  const auto* vector = std::get_if<Vec3>(&value);
  constexpr std::size_t axes = 3;
  if (!list && !vector)
    fail(span, "{} names take the items of a List or a Vec3, not {}", names.size(), value);
  const std::size_t size = list ? (*list)->items.size() : axes;
  if (size != names.size())
    fail(span, "{} names take as many items, not those of a {} of {}", names.size(),
         list ? "List" : "Vec3", size);
  for (std::size_t i = 0; i < size; ++i)
    scope.set(names[i].symbol, list ? (*list)->items[i] : Value((*vector)[static_cast<int>(i)]));
}

[[gnu::noinline]] void Interpreter::execute_node(const Jump& jump) {
  if (scope_->find(std::get<Name>(jump.name->node).symbol))
    return emit(evaluate(*jump.name), jump.keyword);
  result_.leaving = jump.is_break ? Leaving::loop : Leaving::round;
}

[[gnu::noinline]] void Interpreter::execute_node(const While& loop) {
  const Context::Running running(context_,
                                 {.name = "while", .span = loop.keyword, .is_loop = true});
  std::shared_ptr<Scope> scope;
  while (condition(*loop.condition, "'while'")) {
    context_.count_round();
    scope = fresh_scope(std::move(scope));
    execute_in(loop.body, scope);
    if (leaves_loop()) return;
  }
}

[[gnu::noinline]] void Interpreter::execute_node(const For& loop) {
  const Value value = evaluate(*loop.list);
  const List* list = std::get_if<List>(&value);
  if (!list) fail(loop.list->span, "'for' goes through a List, not {}", value);
  const Context::Running running(context_, {.name = "for", .span = loop.keyword, .is_loop = true});
  std::shared_ptr<Scope> scope;
  for (const Value& item : (*list)->items) {
    context_.step(loop.keyword);
    context_.count_round();
    scope = fresh_scope(std::move(scope));
    bind_names(*scope, loop.variables, item, loop.list->span);
    execute_in(loop.body, scope);
    if (leaves_loop()) return;
  }
}

[[gnu::noinline]] void Interpreter::execute_node(const If& choice) {
  for (const If::Branch& branch : choice.branches) {
    if (!branch.condition || condition(*branch.condition, "'if'"))
      return execute_in(branch.body, fresh_scope(nullptr));
  }
}

[[gnu::noinline]] void Interpreter::execute_node(const Return& result) {
  if (!result.value) {
    const auto& name = std::get<Name>(result.name->node);
    if (context_.compat == compat_2015 || scope_->find(name.symbol))
      return emit(evaluate(*result.name), result.keyword);
  }
  // The check lets no `return` stand outside of a macro.
  if (result.value) {
    if (emission_.entities->size() > result_.entities_before)
      fail(result.keyword,
           "this macro has emitted entities, so it cannot return a value, too; a List can hold "
           "both");
    Value value = evaluate(*result.value);
    if (std::holds_alternative<Nothing>(value)) fail(result.value->span, "this call has no value");
    result_.value = std::move(value);
  }
  result_.leaving = Leaving::macro;
}

[[gnu::noinline]] void Interpreter::execute_node(const SettingsBlock& settings) {
  if (is_import_) return;
  settings_span_ = settings.keyword;
  settings_ = evaluate_attributes(settings_type(), settings.attributes);
}

[[gnu::noinline]] void Interpreter::execute_node(const SceneBlock& scene) {
  if (is_import_) return;
  const Temporarily emission(emission_, Emission{.entities = &entities_, .into_scene = true});
  const Temporarily inside(scope_, fresh_scope(nullptr));
  for (const Statement& statement : scene.body.statements) attempt(statement);
}

void Interpreter::execute_node(const Import& import) {
  importer_(import);
}

[[gnu::noinline]] void Interpreter::execute_node(const ExpressionStatement& statement) {
  const Expression& expression = *statement.expression;
  if (const auto* call = std::get_if<Call>(&expression.node)) {
    if (emission_.entities) return execute_call(expression, *call);
    return execute_top_level_call(expression, *call);
  }
  const Value value = evaluate(expression);
  const bool assigns = std::holds_alternative<Assignment>(expression.node) ||
                       std::holds_alternative<Destructuring>(expression.node);
  if (!assigns) emit(value, expression.span);
}

/// What a macro emits when it is called as a statement goes where the caller's own entities go.
[[gnu::noinline]] void Interpreter::execute_call(const Expression& expression, const Call& call) {
  context_.step(expression.span);
  const Value callee = evaluate(*call.callee);
  if (const auto* macro = std::get_if<Macro>(&callee)) {
    const CallSite site{callee_name(call), expression.span};
    const Value value = call_macro(site, **macro, bind_arguments(site, call, **macro));
    const bool may_be_emitted =
        std::holds_alternative<Entity>(value) || std::holds_alternative<List>(value);
    if (may_be_emitted) emit(value, expression.span);
    return;
  }
  const auto* builtin = std::get_if<const Builtin*>(&callee);
  if (!builtin) not_callable(call, callee);
  call_builtin(expression, call, **builtin);
}

[[gnu::noinline]] void Interpreter::execute_top_level_call(const Expression& expression,
                                                           const Call& call) {
  std::vector<Entity> unused;
  const Temporarily emission(emission_, Emission{.entities = &unused});
  execute_call(expression, call);
  if (!unused.empty())
    context_.reporter.warning(
        expression.span, "the entities that this emits are not used: it is not in the Scene block");
}

[[gnu::noinline]] void Interpreter::emit(const Value& value, Span span) {
  bool used = false;
  if (emission_.entities) {
    if (const auto* entity = std::get_if<Entity>(&value)) {
      emit_entity(*entity, span);
      used = true;
    } else if (const List* list = std::get_if<List>(&value)) {
      used = emit_items(**list, span);
    }
  }
  if (!used) context_.reporter.warning(span, "value is not used" + why_not_used(value, span));
}

/// Says how to call a macro of which only the name stands there.
std::string Interpreter::how_to_call(const MacroValue& macro, Span span) const {
  const std::string_view text = context_.sources.text(span);
  const bool is_name =
      std::all_of(text.begin(), text.end(), [](char c) { return is_word_byte(c); });
  const std::string_view name = is_name ? text : "m";
  return text::format("; {} is a macro: call it with {}{}", is_name ? name : "this", name,
                      parameter_list(context_, macro));
}

/// Says where a value that is not used belongs, or what was meant.
[[gnu::noinline]] std::string Interpreter::why_not_used(const Value& value, Span span) const {
  const Value* first = &value;
  if (const List* list = std::get_if<List>(&value); list && !(*list)->items.empty())
    first = &(*list)->items.front();
  if (std::holds_alternative<std::shared_ptr<const Light>>(*first))
    return ": a Light belongs into the List 'lights' of Settings";
  if (std::holds_alternative<std::shared_ptr<const Camera>>(*first))
    return ": a Camera belongs into Settings, as 'camera -> Camera { ... }'";
  if (std::holds_alternative<std::shared_ptr<const Background>>(*first))
    return ": a Background belongs into Settings, as 'background -> Background { ... }'";
  if (std::holds_alternative<SharedMaterial>(*first))
    return ": a Material belongs to an entity, as 'material -> m' or <material m>";
  if (std::holds_alternative<std::shared_ptr<const Pattern>>(*first))
    return ": a Pattern belongs into a Material, as its 'color' or 'bump'";
  if (const auto* macro = std::get_if<Macro>(&value)) return how_to_call(**macro, span);
  const bool stands_outside = !emission_.entities && std::holds_alternative<Entity>(*first);
  if (stands_outside && !is_import_) return ": an Entity belongs into the Scene";
  const Source& source = context_.sources.source_of(span);
  const std::string_view behind = std::string_view(source.text).substr(span.end - source.base);
  const bool is_number =
      std::holds_alternative<std::int64_t>(value) || std::holds_alternative<double>(value);
  if (is_number && is_decrement(behind))
    return ", as '--' begins a comment; to subtract 1, write '-= 1'";
  return {};
}

void Interpreter::emit_entity(const Entity& entity, Span span) {
  if (emission_.into_scene) {
    context_.count_emitted(span, std::max<std::uint64_t>(entity.primitive_count(), 1));
    entity_spans_.emplace_back(statement_, span);
  } else {
    context_.count_made(span);
  }
  emission_.entities->push_back(entity);
}

/// Emits the items, and says whether there was an entity among them or in the lists among them.
bool Interpreter::emit_items(const ListValue& list, Span span) {
  bool used = list.items.empty();
  for (const Value& item : list.items) {
    context_.step(span);
    if (const auto* entity = std::get_if<Entity>(&item)) {
      emit_entity(*entity, span);
      used = true;
    } else if (const List* inner = std::get_if<List>(&item)) {
      used = emit_items(**inner, span) || used;
    }
  }
  return used;
}

}  // namespace crt::lang
