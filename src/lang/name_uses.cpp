#include "lang/name_uses.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <variant>

#include "lang/objects.hpp"
#include "lang/tree_walk.hpp"
#include "text/format.hpp"

namespace crt::lang {

namespace {

/// Finds what is set and what is read where, in the order of the text.
class Visitor : public TreeWalk<Visitor> {
 public:
  using TreeWalk::operator();

  Visitor(NameUses& uses, const SymbolTable& symbols, Reporter& reporter)
      : uses_(uses), symbols_(symbols), reporter_(reporter) {}

  void visit_script(const Script& script) {
    open_region({0, std::numeric_limits<std::uint32_t>::max()});
    visit(script.statements);
    visit(script.expression);
    close_region();
  }

  void operator()(const Name& name) {
    uses_.reads[name.symbol].push_back(next_read_++);
    if (is_known_here(name.symbol)) return;
    regions_.back().read_from_outside.insert(name.symbol);
    if (symbols_.name(name.symbol) == "t" && !is_bound(name.symbol)) uses_.reads_time = true;
  }
  void operator()(const MacroLiteral& macro) {
    open_region(macro.body.span);
    for (std::size_t i = 0; i < macro.parameters.names.size(); ++i) {
      visit(macro.parameters.defaults[i]);
      bind(macro.parameters.names[i], NameUses::Kind::parameter);
    }
    visit(macro.body);
    close_region();
  }
  void operator()(const Assignment& assignment) {
    // The value is computed before the variable is made.
    visit(assignment.value);
    assign(assignment.name, kind_of(*assignment.value));
  }
  void operator()(const Destructuring& assignment) {
    visit(assignment.value);
    for (const NamePlace& name : assignment.names) assign(name, NameUses::Kind::variable);
  }
  void operator()(const Comprehension& list) {
    for (const Clause& clause : list.clauses) {
      visit(clause.operand);
      bind_in_loop(clause.names);
    }
    visit(list.value);
  }
  void operator()(const While& loop) {
    visit(loop.condition);
    visit_loop(loop.body);
  }
  void operator()(const For& loop) {
    visit(loop.list);
    bind_in_loop(loop.variables);
    visit_loop(loop.body);
  }
  void operator()(const Jump& jump) {
    if (is_bound(std::get<Name>(jump.name->node).symbol)) return visit(jump.name);
    if (regions_.back().open_loops > 0) return;
    reporter_.error(jump.keyword, text::format("'{}' stands in a loop only",
                                               jump.is_break ? "break" : "continue"));
  }
  void operator()(const Import& import) {
    if (import.name) bind(*import.name, NameUses::Kind::variable);
  }

  void operator()(const Return& result) {
    const bool is_stray = result.value && regions_.size() < 2;
    if (is_stray) reporter_.error(result.keyword, "'return' stands in a macro only");
    TreeWalk::operator()(result);
  }

 private:
  /// A Region is a macro or the top level: no assignment reaches out of it.
  struct Region {
    Span span;
    std::uint32_t first_read = 0;
    std::unordered_map<Symbol, NameUses::Binding> bindings = {};
    std::set<Symbol> loop_variables = {};
    std::set<Symbol> read_from_outside = {};
    std::size_t first_shadowing = 0;
    int open_loops = 0;
  };

  static NameUses::Kind kind_of(const Expression& value) {
    if (std::holds_alternative<MacroLiteral>(value.node)) return NameUses::Kind::macro;
    if (std::holds_alternative<DerivedMaterial>(value.node)) return NameUses::Kind::material;
    const auto* object = std::get_if<ObjectLiteral>(&value.node);
    // The check has set the type.
    const bool is_material =
        object && object->type &&
        (object->type->name == "Material" || object->type->name == "PrincipledMaterial");
    return is_material ? NameUses::Kind::material : NameUses::Kind::variable;
  }

  void open_region(Span span) {
    regions_.push_back(
        {.span = span, .first_read = next_read_, .first_shadowing = uses_.shadowings.size()});
  }

  static bool knows(const Region& region, Symbol symbol) {
    return region.bindings.contains(symbol) || region.loop_variables.contains(symbol);
  }

  /// Says whether the innermost macro, or the top level, has set a name before.
  bool is_known_here(Symbol symbol) const { return knows(regions_.back(), symbol); }

  /// Says whether the innermost macro, or what is around it, has set a name before.
  bool is_bound(Symbol symbol) const {
    return std::any_of(regions_.begin(), regions_.end(),
                       [symbol](const Region& region) { return knows(region, symbol); });
  }

  void close_region() {
    Region& region = regions_.back();
    for (auto& [symbol, binding] : region.bindings) {
      binding.is_of_macro = regions_.size() > 1;
      binding.region = region.span;
      binding.first_read = region.first_read;
      binding.end_of_reads = next_read_;
      uses_.bindings.push_back(binding);
    }
    const std::size_t depth = regions_.size() - 1;
    for (std::size_t i = region.first_shadowing; i < uses_.shadowings.size(); ++i) {
      NameUses::Shadowing& inner = uses_.shadowings[i];
      const bool is_inside = inner.depth > depth && depth > 0;
      if (is_inside && knows(region, inner.name.symbol)) inner.is_bound_outside = true;
    }
    regions_.pop_back();
  }

  void assign(const NamePlace& name, NameUses::Kind kind) {
    const bool was_read = regions_.back().read_from_outside.contains(name.symbol);
    if (was_read && regions_.size() > 1 && !is_known_here(name.symbol))
      uses_.shadowings.push_back({.name = name, .depth = regions_.size() - 1});
    bind(name, kind);
  }

  void bind_in_loop(const std::vector<NamePlace>& names) {
    for (const NamePlace& name : names) regions_.back().loop_variables.insert(name.symbol);
  }

  void visit_loop(const Block& body) {
    ++regions_.back().open_loops;
    visit(body);
    --regions_.back().open_loops;
  }

  void bind(const NamePlace& name, NameUses::Kind kind) {
    regions_.back().bindings.try_emplace(name.symbol,
                                         NameUses::Binding{.name = name, .kind = kind});
  }

  NameUses& uses_;
  const SymbolTable& symbols_;
  Reporter& reporter_;
  std::vector<Region> regions_;
  std::uint32_t next_read_ = 0;
};

bool is_read(const NameUses& uses, const NameUses::Binding& binding) {
  const auto reads = uses.reads.find(binding.name.symbol);
  if (reads == uses.reads.end()) return false;
  const auto first =
      std::lower_bound(reads->second.begin(), reads->second.end(), binding.first_read);
  return first != reads->second.end() && *first < binding.end_of_reads;
}

std::string_view word_of(NameUses::Kind kind) {
  switch (kind) {
    case NameUses::Kind::variable:
      return "variable";
    case NameUses::Kind::material:
      return "material";
    case NameUses::Kind::macro:
      return "macro";
    case NameUses::Kind::parameter:
      return "parameter";
  }
  return "";
}

}  // namespace

NameUses find_name_uses(const Script& script, const SymbolTable& symbols, Reporter& reporter) {
  NameUses uses;
  Visitor(uses, symbols, reporter).visit_script(script);
  std::sort(uses.bindings.begin(), uses.bindings.end(),
            [](const auto& a, const auto& b) { return a.name.span.begin < b.name.span.begin; });
  return uses;
}

const NamePlace* set_further_down(const NameUses& uses, Symbol name, Span place) {
  // The bindings are in the order of the text.
  const auto found = std::find_if(
      uses.bindings.begin(), uses.bindings.end(), [&](const NameUses::Binding& binding) {
        const bool is_seen =
            binding.region.begin <= place.begin && place.begin < binding.region.end;
        return binding.name.symbol == name && is_seen && binding.kind != NameUses::Kind::parameter;
      });
  if (found == uses.bindings.end() || found->name.span.begin <= place.begin) return nullptr;
  return &found->name;
}

void warn_of_shadowed_names(const NameUses& uses, const std::set<Symbol>& top_level,
                            const SymbolTable& symbols, Reporter& reporter) {
  for (const NameUses::Shadowing& shadowing : uses.shadowings) {
    const Symbol symbol = shadowing.name.symbol;
    if (!shadowing.is_bound_outside && !top_level.contains(symbol)) continue;
    reporter.warning(
        shadowing.name.span,
        text::format("this sets a new '{0}' inside the macro; the '{0}' outside keeps its value",
                     symbols.name(symbol)));
  }
}

void warn_of_unused_names(const NameUses& uses, const std::set<Symbol>& read_elsewhere,
                          const SymbolTable& symbols, Reporter& reporter) {
  std::set<Symbol> top_level;
  for (const NameUses::Binding& binding : uses.bindings) {
    if (!binding.is_of_macro) top_level.insert(binding.name.symbol);
  }
  for (const NameUses::Binding& binding : uses.bindings) {
    const Symbol symbol = binding.name.symbol;
    const std::string_view name = symbols.name(symbol);
    const bool is_read_elsewhere = !binding.is_of_macro && read_elsewhere.contains(symbol);
    if (name.starts_with('_') || is_read_elsewhere || is_read(uses, binding)) continue;
    const bool hides = binding.is_of_macro && binding.kind != NameUses::Kind::parameter &&
                       top_level.contains(symbol);
    const char* hint = hides ? "; it is the macro's own, as macros never change variables outside"
                       : binding.kind == NameUses::Kind::parameter
                           ? "; begin its name with '_' if that is meant"
                           : "";
    reporter.warning(binding.name.span, text::format("the {} '{}' is never used{}",
                                                     word_of(binding.kind), name, hint));
  }
}

}  // namespace crt::lang
