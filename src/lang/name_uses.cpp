#include "lang/name_uses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <variant>

#include "lang/objects.hpp"
#include "lang/tree_walk.hpp"

namespace crt::lang {

namespace {

using Kind = NameUses::Kind;

/// Finds what is set and what is read where, in the order of the text.
class Visitor : public TreeWalk<Visitor> {
 public:
  using TreeWalk::operator();

  Visitor(NameUses& uses, Reporter& reporter) : uses_(uses), reporter_(reporter) {}

  void visit_script(const Script& script) {
    open_region();
    visit(script.statements);
    visit(script.expression);
    close_region();
  }

  void operator()(const Name& name) { uses_.reads[name.symbol].push_back(next_read_++); }
  void operator()(const MacroLiteral& macro) {
    open_region();
    for (const NamePlace& parameter : macro.parameters) bind(parameter, Kind::parameter);
    visit(macro.body);
    close_region();
  }
  void operator()(const Assignment& assignment) {
    bind(assignment.name, kind_of(*assignment.value));
    visit(assignment.value);
  }

  void operator()(const Return& result) {
    const bool is_stray = result.value && regions_.size() < 2;
    if (is_stray) reporter_.error(result.keyword, "'return' stands in a macro only");
    TreeWalk::operator()(result);
  }

 private:
  /// A Region is a macro or the top level: no assignment reaches out of it.
  struct Region {
    std::uint32_t first_read = 0;
    std::unordered_map<Symbol, NameUses::Binding> bindings;
  };

  static Kind kind_of(const Expression& value) {
    if (std::holds_alternative<MacroLiteral>(value.node)) return Kind::macro;
    const auto* object = std::get_if<ObjectLiteral>(&value.node);
    // The check has set the type.
    const bool is_material = object && object->type && object->type->name == "Material";
    return is_material ? Kind::material : Kind::variable;
  }

  void open_region() { regions_.push_back({next_read_, {}}); }

  void close_region() {
    Region& region = regions_.back();
    for (auto& [symbol, binding] : region.bindings) {
      binding.is_of_macro = regions_.size() > 1;
      binding.first_read = region.first_read;
      binding.end_of_reads = next_read_;
      uses_.bindings.push_back(binding);
    }
    regions_.pop_back();
  }

  void bind(const NamePlace& name, Kind kind) {
    regions_.back().bindings.try_emplace(name.symbol,
                                         NameUses::Binding{.name = name, .kind = kind});
  }

  NameUses& uses_;
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

std::string_view word_of(Kind kind) {
  switch (kind) {
    case Kind::variable:
      return "variable";
    case Kind::material:
      return "material";
    case Kind::macro:
      return "macro";
    case Kind::parameter:
      return "parameter";
  }
  return "";
}

}  // namespace

NameUses find_name_uses(const Script& script, Reporter& reporter) {
  NameUses uses;
  Visitor(uses, reporter).visit_script(script);
  std::sort(uses.bindings.begin(), uses.bindings.end(),
            [](const auto& a, const auto& b) { return a.name.span.begin < b.name.span.begin; });
  return uses;
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
    const bool hides =
        binding.is_of_macro && binding.kind != Kind::parameter && top_level.contains(symbol);
    const char* hint = hides ? "; it is the macro's own, as macros never change variables outside"
                       : binding.kind == Kind::parameter
                           ? "; begin its name with '_' if that is meant"
                           : "";
    reporter.warning(binding.name.span,
                     fmt::format("the {} '{}' is never used{}", word_of(binding.kind), name, hint));
  }
}

}  // namespace crt::lang
