// This finds what each name in a tree means, without running it: which places name one variable,
// macro or parameter, and which names can be seen where. It follows the rules of the reference
// (docs/language.md, "Variables, scopes and macros") in the order of the text. What a macro reads
// is looked for when all around it is known, as it is called later.
#pragma once

#include <cstddef>
#include <functional>
#include <unordered_map>
#include <vector>

#include "lang/source_map.hpp"
#include "lang/symbol.hpp"
#include "lang/syntax.hpp"

namespace crt::lang {

enum class NameKind { variable, macro, parameter, loop_variable };

/// A DeclaredName is a variable with all places that name it.
struct DeclaredName {
  Symbol symbol{};
  NameKind kind = NameKind::variable;
  /// Where it is set first.
  Span span;
  /// What it is set to there. Parameters and variables of loops have none.
  const Expression* value = nullptr;
  /// Indexes NameMap::scopes.
  std::size_t scope = 0;
  /// That of the names of an import that has this name, or 0. It indexes NameMap::scopes, too.
  std::size_t members = 0;
};

/// A NameUse is a place where a name stands.
struct NameUse {
  Symbol symbol{};
  Span span;
  /// Indexes NameMap::declared, or is `nothing` for built-ins and names that are never set.
  std::size_t declared = nothing;

  static constexpr std::size_t nothing = static_cast<std::size_t>(-1);
};

struct NameScope {
  /// Where its names can be seen, from brace to brace. That of the top level is everywhere, and
  /// that of an import with a name nowhere.
  Span extent{};
  /// Indexes NameMap::scopes. The top level is its own parent.
  std::size_t parent = 0;
  /// Says that assignments do not look further out: the top level, or a macro.
  bool is_border = false;
  std::unordered_map<Symbol, std::size_t> names{};
};

struct NameMap {
  std::vector<DeclaredName> declared;
  /// Sorted by their places.
  std::vector<NameUse> uses;
  std::vector<NameScope> scopes;
};

/// Returns the tree of an imported script, or null if there is none.
using Importer = std::function<const Script*(const Import&)>;

/// Maps the names of a script and of what it imports.
NameMap map_names(const Script& script, const Importer& importer);

/// Returns the use at an offset, which may be just behind it, or null.
const NameUse* use_at(const NameMap& names, std::uint32_t offset);

/// Lists the names that can be seen at an offset, each once: those further in come first.
std::vector<const DeclaredName*> names_at(const NameMap& names, std::uint32_t offset);

}  // namespace crt::lang
