// This finds which names a script sets and which it reads, before it runs.
#pragma once

#include <cstdint>
#include <set>
#include <unordered_map>
#include <vector>

#include "lang/reporter.hpp"
#include "lang/symbol.hpp"
#include "lang/syntax.hpp"

namespace crt::lang {

/// NameUses says where names are set, and where they may be read.
struct NameUses {
  enum class Kind { variable, material, macro, parameter };

  /// A Binding is a name that a macro, or the top level, sets, at the first place where it does.
  struct Binding {
    NamePlace name;
    Kind kind = Kind::variable;
    bool is_of_macro = false;
    // The names that are read where it is seen have these places in the order of reading.
    std::uint32_t first_read = 0;
    std::uint32_t end_of_reads = 0;
  };

  std::vector<Binding> bindings;
  /// The places of each name in the order in which names are read, ascending.
  std::unordered_map<Symbol, std::vector<std::uint32_t>> reads;
};

/// Goes through a script. Reports a `return` that is in no macro.
NameUses find_name_uses(const Script& script, Reporter& reporter);

/// Warns of names that nobody reads. `read_elsewhere` has those that other scripts read.
void warn_of_unused_names(const NameUses& uses, const std::set<Symbol>& read_elsewhere,
                          const SymbolTable& symbols, Reporter& reporter);

}  // namespace crt::lang
