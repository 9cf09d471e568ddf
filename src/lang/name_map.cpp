#include "lang/name_map.hpp"

#include <algorithm>
#include <deque>
#include <set>
#include <span>
#include <utility>
#include <variant>

#include "lang/tree_walk.hpp"

namespace crt::lang {

namespace {

/// Visits a tree in the order in which it runs. Macros wait until the rest is done.
class NameMapper : public TreeWalk<NameMapper> {
 public:
  using TreeWalk::operator();
  using TreeWalk::visit;

  explicit NameMapper(const Importer& importer) : importer_(importer) {
    map_.scopes.push_back({.is_border = true});
  }

  NameMap map(const Script& script) {
    visit(script.statements);
    for (; !waiting_.empty(); waiting_.pop_front()) visit_macro(waiting_.front());
    for (const NamedArgument& argument : named_arguments_) use_parameter(argument);
    std::stable_sort(map_.uses.begin(), map_.uses.end(), [](const NameUse& a, const NameUse& b) {
      return a.span.begin < b.span.begin;
    });
    // What one place both reads and sets stands there once.
    const auto is_same = [](const NameUse& a, const NameUse& b) {
      return a.span == b.span && a.declared == b.declared;
    };
    map_.uses.erase(std::unique(map_.uses.begin(), map_.uses.end(), is_same), map_.uses.end());
    return std::move(map_);
  }

  void operator()(const MacroLiteral& macro) { waiting_.push_back({&macro, scope_}); }
  void operator()(const Assignment& assignment) {
    visit(assignment.value);
    assign(assignment.name, assignment.value);
  }

  void operator()(const Destructuring& assignment) {
    visit(assignment.value);
    for (const NamePlace& name : assignment.names) assign(name, nullptr);
  }
  void operator()(const Comprehension& list) {
    const std::size_t outside = scope_;
    for (const Clause& clause : list.clauses) {
      visit(clause.operand);
      if (clause.names.empty()) continue;
      open_scope(span_, false);
      declare(clause.names, NameKind::loop_variable);
    }
    visit(list.value);
    scope_ = outside;
  }
  void operator()(const Member& member) {
    visit(member.base);
    const std::size_t declared = member_of_import(member);
    if (declared != NameUse::nothing) use(member.name.symbol, member.name.span, declared);
  }
  void operator()(const Call& call) {
    TreeWalk::operator()(call);
    const auto* name = std::get_if<Name>(&call.callee->node);
    const auto* member = std::get_if<Member>(&call.callee->node);
    const std::size_t callee = name     ? find(name->symbol, false)
                               : member ? member_of_import(*member)
                                        : NameUse::nothing;
    // A macro further down may set it, too, but its parameters are not known here.
    if (callee == NameUse::nothing) return;
    for (const NamePlace& argument : call.names) named_arguments_.push_back({callee, argument});
  }

  void operator()(const While& loop) {
    visit(loop.condition);
    visit_inside(loop.body, {});
  }
  void operator()(const If& choice) {
    for (const If::Branch& branch : choice.branches) {
      visit(branch.condition);
      visit_inside(branch.body, {});
    }
  }
  void operator()(const For& loop) {
    visit(loop.list);
    visit_inside(loop.body, loop.variables, NameKind::loop_variable);
  }
  void operator()(const Return& result) {
    visit(result.value);
    if (result.name) visit_if_variable(*result.name);
  }
  void operator()(const Jump& jump) { visit_if_variable(*jump.name); }
  void operator()(const SceneBlock& scene) { visit_inside(scene.body, {}); }
  void operator()(const Import& import) {
    const Script* script = importer_(import);
    // Without a name its top-level names are those of the script that imports it.
    if (!import.name) {
      if (script) visit(script->statements);
      return;
    }
    const std::size_t outside = std::exchange(scope_, 0);
    const std::size_t members = map_.scopes.size();
    open_scope({}, true);
    if (script) visit(script->statements);
    scope_ = outside;
    assign(*import.name, nullptr);
    map_.declared[find(import.name->symbol, true)].members = members;
  }

  void visit(const Expression* expression) {
    if (!expression) return;
    if (const auto* name = std::get_if<Name>(&expression->node))
      return use(name->symbol, expression->span, find(name->symbol, false));
    const Span outside = std::exchange(span_, expression->span);
    TreeWalk::visit(expression);
    span_ = outside;
  }

 private:
  struct NamedArgument {
    std::size_t callee = 0;
    NamePlace name;
  };

  struct WaitingMacro {
    const MacroLiteral* macro = nullptr;
    std::size_t scope = 0;
  };

  /// Finds what a member means of an import that has a name.
  std::size_t member_of_import(const Member& member) const {
    const auto* base = std::get_if<Name>(&member.base->node);
    const std::size_t space = base ? find(base->symbol, false) : NameUse::nothing;
    if (space == NameUse::nothing || map_.declared[space].members == 0) return NameUse::nothing;
    const auto& names = map_.scopes[map_.declared[space].members].names;
    const auto found = names.find(member.name.symbol);
    return found == names.end() ? NameUse::nothing : found->second;
  }

  /// An argument with a name is a use of the parameter, when all macros have been visited.
  void use_parameter(const NamedArgument& argument) {
    const Expression* value = map_.declared[argument.callee].value;
    const auto* macro = value ? std::get_if<MacroLiteral>(&value->node) : nullptr;
    const auto scope = macro ? scope_of_macro_.find(macro) : scope_of_macro_.end();
    if (scope == scope_of_macro_.end()) return;
    const auto& names = map_.scopes[scope->second].names;
    const auto found = names.find(argument.name.symbol);
    const bool is_parameter =
        found != names.end() && map_.declared[found->second].kind == NameKind::parameter;
    if (is_parameter) use(argument.name.symbol, argument.name.span, found->second);
  }

  /// Opens a scope in the one that is open. Whoever calls this closes it, by setting scope_.
  void open_scope(Span extent, bool is_border) {
    map_.scopes.push_back({.extent = extent, .parent = scope_, .is_border = is_border});
    scope_ = map_.scopes.size() - 1;
  }

  /// Visits a body in a scope of its own, where some names are set at its beginning.
  void visit_inside(const Block& body, std::span<const NamePlace> names,
                    NameKind kind = NameKind::variable) {
    const std::size_t outside = scope_;
    open_scope(body.span, false);
    declare(names, kind);
    visit(body);
    scope_ = outside;
  }

  void visit_macro(const WaitingMacro& waiting) {
    scope_ = waiting.scope;
    open_scope(waiting.macro->body.span, true);
    scope_of_macro_[waiting.macro] = scope_;
    const Parameters& parameters = waiting.macro->parameters;
    for (std::size_t i = 0; i < parameters.names.size(); ++i) {
      visit(parameters.defaults[i]);
      declare(std::span(parameters.names).subspan(i, 1), NameKind::parameter);
    }
    visit(waiting.macro->body);
  }

  /// `return` and the like alone are the variables of that name if there are such.
  void visit_if_variable(const Expression& word) {
    if (find(std::get<Name>(word.node).symbol, false) != NameUse::nothing) visit(&word);
  }

  /// Finds what a name means here: what is set in a scope around this place, up to the border if
  /// that is where to end.
  std::size_t find(Symbol symbol, bool up_to_border) const {
    for (std::size_t scope = scope_;; scope = map_.scopes[scope].parent) {
      const NameScope& here = map_.scopes[scope];
      if (const auto found = here.names.find(symbol); found != here.names.end())
        return found->second;
      if (scope == 0 || (up_to_border && here.is_border)) return NameUse::nothing;
    }
  }

  void use(Symbol symbol, Span span, std::size_t declared) {
    map_.uses.push_back({symbol, span, declared});
  }

  void declare(std::span<const NamePlace> names, NameKind kind) {
    for (const NamePlace& name : names) declare(name, kind, nullptr);
  }

  void declare(const NamePlace& name, NameKind kind, const Expression* value) {
    map_.scopes[scope_].names[name.symbol] = map_.declared.size();
    use(name.symbol, name.span, map_.declared.size());
    map_.declared.push_back({name.symbol, kind, name.span, value, scope_});
  }

  void assign(const NamePlace& name, const Expression* value) {
    const std::size_t known = find(name.symbol, true);
    if (known != NameUse::nothing) return use(name.symbol, name.span, known);
    const bool is_macro = value && std::holds_alternative<MacroLiteral>(value->node);
    declare(name, is_macro ? NameKind::macro : NameKind::variable, value);
  }

  const Importer& importer_;
  NameMap map_;
  std::size_t scope_ = 0;
  Span span_{};  ///< of the expression that is visited
  std::deque<WaitingMacro> waiting_;
  std::vector<NamedArgument> named_arguments_;
  std::unordered_map<const MacroLiteral*, std::size_t> scope_of_macro_;
};

}  // namespace

NameMap map_names(const Script& script, const Importer& importer) {
  return NameMapper(importer).map(script);
}

const NameUse* use_at(const NameMap& names, std::uint32_t offset) {
  const auto behind = std::upper_bound(
      names.uses.begin(), names.uses.end(), offset,
      [](std::uint32_t place, const NameUse& use) { return place < use.span.begin; });
  if (behind == names.uses.begin()) return nullptr;
  const NameUse& use = *std::prev(behind);
  return offset <= use.span.end ? &use : nullptr;
}

std::vector<const DeclaredName*> names_at(const NameMap& names, std::uint32_t offset) {
  // A scope lies in its parent. Of those around the offset the one that begins last is innermost.
  std::size_t innermost = 0;
  for (std::size_t i = 1; i < names.scopes.size(); ++i) {
    const Span& extent = names.scopes[i].extent;
    const bool is_inside = extent.begin < offset && offset < extent.end;
    if (is_inside && (innermost == 0 || extent.begin > names.scopes[innermost].extent.begin))
      innermost = i;
  }
  std::vector<const DeclaredName*> result;
  std::set<Symbol> seen;
  for (std::size_t scope = innermost;; scope = names.scopes[scope].parent) {
    const std::size_t before = result.size();
    for (const auto& [symbol, declared] : names.scopes[scope].names) {
      if (seen.insert(symbol).second) result.push_back(&names.declared[declared]);
    }
    std::sort(
        result.begin() + static_cast<std::ptrdiff_t>(before), result.end(),
        [](const DeclaredName* a, const DeclaredName* b) { return a->span.begin < b->span.begin; });
    if (scope == 0) return result;
  }
}

}  // namespace crt::lang
