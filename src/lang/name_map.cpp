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
    visit_inside(loop.body, {&loop.variable, 1}, NameKind::loop_variable);
  }
  void operator()(const Return& result) {
    visit(result.value);
    // Alone it is the variable of that name if there is one.
    const auto* name = result.name ? std::get_if<Name>(&result.name->node) : nullptr;
    if (name && find(name->symbol, false) != NameUse::nothing) visit(result.name);
  }
  void operator()(const SceneBlock& scene) { visit_inside(scene.body, {}); }
  void operator()(const Import& import) {
    // Its top-level names are those of the script that imports it.
    if (const Script* script = importer_(import)) visit(script->statements);
  }

  void visit(const Expression* expression) {
    const auto* name = expression ? std::get_if<Name>(&expression->node) : nullptr;
    if (name) return use(name->symbol, expression->span, find(name->symbol, false));
    TreeWalk::visit(expression);
  }

 private:
  struct WaitingMacro {
    const MacroLiteral* macro = nullptr;
    std::size_t scope = 0;
  };

  /// Visits a body in a scope of its own, where some names are set at its beginning.
  void visit_inside(const Block& body, std::span<const NamePlace> names,
                    NameKind kind = NameKind::variable, bool is_border = false) {
    map_.scopes.push_back({.extent = body.span, .parent = scope_, .is_border = is_border});
    const std::size_t outside = std::exchange(scope_, map_.scopes.size() - 1);
    for (const NamePlace& name : names) declare(name, kind, nullptr);
    visit(body);
    scope_ = outside;
  }

  void visit_macro(const WaitingMacro& waiting) {
    scope_ = waiting.scope;
    visit_inside(waiting.macro->body, waiting.macro->parameters, NameKind::parameter, true);
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
  std::deque<WaitingMacro> waiting_;
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
