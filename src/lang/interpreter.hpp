// The interpreter runs a syntax tree. Expressions give values, statements set variables and emit
// entities.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "crt/scene.hpp"
#include "lang/context.hpp"
#include "lang/objects.hpp"
#include "lang/scope.hpp"
#include "lang/syntax.hpp"
#include "lang/value.hpp"

namespace crt::lang {

struct NameUses;

class Interpreter {
 public:
  explicit Interpreter(Context& context);
  Interpreter(const Interpreter&) = delete;
  Interpreter& operator=(const Interpreter&) = delete;
  ~Interpreter();

  /// Sets a top-level variable that the script's own assignments are not to change.
  void override_variable(Symbol name, Value value);

  /// Runs a script's statements. Errors go to the reporter. Throws GiveUp when it makes no sense to
  /// continue. `script` must outlive the interpreter.
  void run(const Script& script, bool is_import);

  /// Runs an imported script in a top level of its own, and returns its variables as a dictionary.
  Value run_apart(const Script& script, Span span);

  /// Tells top levels apart: that of the main script, and those of imports with a name.
  int top_level() const { return top_level_; }

  /// Sets a variable of the script that runs now.
  void set_variable(Symbol name, const Value& value);

  /// Returns the value of an expression in the top-level scope. Throws a Failure.
  Value evaluate(const Expression& expression);

  /// Returns the value of an expression in which x, y and z are the coordinates of a field.
  Value evaluate_field(const Expression& expression);

  /// Sets what `import` does, which needs access to files.
  void set_importer(std::function<void(const Import&)> importer) {
    importer_ = std::move(importer);
  }

  /// Sets where the main script sets its names, which must outlive the interpreter's runs.
  void set_name_uses(const NameUses& uses) { name_uses_ = &uses; }

  /// Warns of each modifier that gave a material and never changed anything by it.
  void warn_of_idle_materials() const;

  bool has_scene() const { return has_scene_; }
  std::vector<Entity>& entities() { return entities_; }
  /// Returns the statement outside of macros and the one that gave the entity, of each of them.
  const std::vector<std::pair<Span, Span>>& entity_spans() const { return entity_spans_; }
  const std::optional<Span>& settings_span() const { return settings_span_; }
  std::vector<Given>& settings() { return settings_; }

 private:
  /// An Emission takes the entities of expression statements.
  struct Emission {
    std::vector<Entity>* entities = nullptr;
    bool into_scene = false;
  };

  /// Says up to where the statements are being left.
  enum class Leaving { nothing, round, loop, macro };

  /// A Result is what the macro that runs now returns.
  struct Result {
    Leaving leaving = Leaving::nothing;
    Value value = Nothing{};
    std::size_t entities_before = 0;  ///< those that were emitted before the call
  };

  /// Changes one of this object's variables until the end of a C++ scope.
  template <class Type>
  class Temporarily {
   public:
    Temporarily(Type& variable, Type value)
        : variable_(variable), before_(std::exchange(variable, std::move(value))) {}
    Temporarily(const Temporarily&) = delete;
    Temporarily& operator=(const Temporarily&) = delete;
    ~Temporarily() { variable_ = std::move(before_); }

   private:
    Type& variable_;
    Type before_;
  };

  // Statements: execute.cpp.
  void execute(const Block& block);
  void execute(const Statement& statement);
  void execute_in(const Block& block, std::shared_ptr<Scope> scope);
  void execute_node(const ExpressionStatement& statement);
  void execute_node(const While& loop);
  void execute_node(const If& choice);
  void execute_node(const For& loop);
  void execute_node(const Jump& jump);
  void execute_node(const Return& result);
  void execute_node(const SettingsBlock& settings);
  void execute_node(const SceneBlock& scene);
  void execute_node(const Import& import);
  void execute_call(const Expression& expression, const Call& call);
  void execute_top_level_call(const Expression& expression, const Call& call);
  void attempt(const Statement& statement);
  void mark_unknown(const Statement& statement);
  std::shared_ptr<Scope> fresh_scope(std::shared_ptr<Scope> used);
  void emit(const Value& value, Span span);
  std::string why_not_used(const Value& value, Span span) const;
  std::string how_to_call(const MacroValue& macro, Span span) const;
  void emit_entity(const Entity& entity, Span span);
  bool emit_items(const ListValue& list, Span span);
  bool condition(const Expression& expression, const char* what);
  bool leaves_loop();
  void bind_names(Scope& scope, const std::vector<NamePlace>& names, const Value& value, Span span);

  // Expressions: evaluate.cpp.
  Value evaluate_node(const Literal& literal, const Expression& expression);
  Value evaluate_node(const Length& length, const Expression& expression);
  Value evaluate_node(const Interpolation& text, const Expression& expression);
  Value evaluate_node(const Name& name, const Expression& expression);
  Value evaluate_node(const ObjectLiteral& object, const Expression& expression);
  Value evaluate_node(const DerivedMaterial& derived, const Expression& expression);
  Value evaluate_node(const MacroLiteral& macro, const Expression& expression);
  Value evaluate_node(const ListLiteral& list, const Expression& expression);
  Value evaluate_node(const Comprehension& list, const Expression& expression);
  Value evaluate_node(const DictionaryLiteral& dictionary, const Expression& expression);
  Value evaluate_node(const Index& index, const Expression& expression);
  Value evaluate_node(const Slice& slice, const Expression& expression);
  Value evaluate_node(const Member& member, const Expression& expression);
  Value evaluate_node(const Call& call, const Expression& expression);
  Value evaluate_node(const Modified& modified, const Expression& expression);
  Value evaluate_node(const Unary& unary, const Expression& expression);
  Value evaluate_node(const Chain& chain, const Expression& expression);
  Value evaluate_node(const Logical& logical, const Expression& expression);
  Value evaluate_node(const Conditional& conditional, const Expression& expression);
  Value evaluate_node(const Assignment& assignment, const Expression& expression);
  Value evaluate_node(const Destructuring& assignment, const Expression& expression);
  Value evaluate_value(const Expression& expression);
  void run_clauses(const Comprehension& list, std::size_t next, ListMaker& items);
  Value watched_division(const Expression& chain, const ChainLink& link, Span left_span,
                         const Value& left, const Value& right);
  bool has_remainder_by(Span divisor);
  bool is_overridden(Symbol name) const;
  std::optional<Value> append_to_variable(const Assignment& assignment);
  std::vector<Given> evaluate_attributes(const ObjectType& type,
                                         const std::vector<AttributeSyntax>& attributes);
  Entity modify(const Entity& entity, const Modifier& modifier);  // modify.cpp
  std::optional<Vec3> vector_after(std::string_view word, const Expression* operand);
  void note_material(const Entity& entity, Span span);
  [[noreturn]] void unknown_name(Symbol name, Span span) const;
  std::string hint_of_library(std::string_view name) const;
  std::string hint_of_order(Symbol name, Span span) const;
  void check_stack(Span span) const;

  /// A CallSite is what messages say of a call.
  struct CallSite {
    std::string_view name;
    Span span;
  };

  // Calls: call.cpp.
  Value call_builtin(const Expression& expression, const Call& call, const Builtin& builtin);
  Value call_value(const CallSite& site, const Value& callee, std::span<const Value> arguments);
  std::shared_ptr<Scope> bind_arguments(const CallSite& site, const Call& call,
                                        const MacroValue& macro);
  void bind_defaults(const MacroValue& macro, Scope& scope);
  void check_given(const CallSite& site, const MacroValue& macro, const Scope& scope) const;
  std::size_t parameter_of(const CallSite& site, const NamePlace& argument,
                           const MacroValue& macro) const;
  void check_number(const CallSite& site, std::size_t arguments, const MacroValue& macro) const;
  void complain_of_name(const Assignment& assignment, const MacroValue& macro) const;
  [[noreturn]] void pass_call_depth(Span span) const;
  Value call_macro(const CallSite& site, const MacroValue& macro, std::shared_ptr<Scope> scope);
  Value value_of_call(const CallSite& site, const MacroValue& macro, std::shared_ptr<Scope> scope);
  [[noreturn]] void not_callable(const Call& call, const Value& callee) const;
  std::string_view callee_name(const Call& call) const;
  void capture_scopes(Span span);

  Context& context_;
  std::uintptr_t stack_end_;         ///< the lowest place that calls and expressions may reach
  std::shared_ptr<Scope> universe_;  ///< built-ins and constants
  std::shared_ptr<Scope> globals_;
  std::shared_ptr<Scope> scope_;  ///< the one that runs now
  /// These are the scopes that macros were made in. They stay until the end, when they are emptied
  /// one by one. So macros and scopes that hold one another are freed, and long chains of them
  /// without recursion.
  std::vector<std::pair<std::shared_ptr<Scope>, Charge>> captured_;
  Emission emission_;
  Result result_;
  std::vector<Value> arguments_;  ///< arguments of the built-ins that are being called
  std::size_t call_depth_ = 0;
  std::set<Symbol> overridden_;

  /// These are the scripts that have run, and the divisors of their remainders once they are asked.
  std::vector<const Script*> scripts_;
  std::size_t scripts_searched_ = 0;
  std::set<std::string_view> remainders_;

  const NameUses* name_uses_ = nullptr;
  /// Says of each modifier that gave a material whether some part took it.
  std::map<std::uint32_t, std::pair<Span, bool>> materials_given_;

  int top_level_ = 0;       ///< the one that runs now
  int top_levels_ = 1;      ///< so many have run
  bool has_begun_ = false;  ///< with a script, and not only with values from outside
  bool is_import_ = false;
  bool has_scene_ = false;
  std::vector<Entity> entities_;
  std::vector<std::pair<Span, Span>> entity_spans_;
  Span statement_{};  ///< the last one that ran outside of macros
  std::optional<Span> settings_span_;
  std::vector<Given> settings_;
  std::function<void(const Import&)> importer_;
};

/// Returns the parameters of a macro as they are written: "(r, h -> 1)".
std::string parameter_list(const Context& context, const MacroValue& macro);

}  // namespace crt::lang
