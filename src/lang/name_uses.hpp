// This finds which names a script sets and which it reads, before it runs.
#pragma once

#include <cstddef>
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
    /// Is the macro or the text that sets it.
    Span region{};
    // The names that are read where it is seen have these places in the order of reading.
    std::uint32_t first_read = 0;
    std::uint32_t end_of_reads = 0;
  };

  /// A Shadowing is a macro's first assignment to a name that it has read before, from outside.
  struct Shadowing {
    NamePlace name;
    std::size_t depth = 0;          ///< counts the macros around the assignment
    bool is_bound_outside = false;  ///< in one of them: the top level of any script may do it, too
  };

  std::vector<Binding> bindings;
  std::vector<Shadowing> shadowings;
  /// Says whether the text reads `t` where that is the number of the frame.
  bool reads_time = false;
  /// The places of each name in the order in which names are read, ascending.
  std::unordered_map<Symbol, std::vector<std::uint32_t>> reads;
};

/// Goes through a script. Reports a `return` that is in no macro.
NameUses find_name_uses(const Script& script, const SymbolTable& symbols, Reporter& reporter);

/// Returns where a name is set that is read at `place`, if that is only further down. Returns null
/// if it is not.
const NamePlace* set_further_down(const NameUses& uses, Symbol name, Span place);

/// Warns of macros that read a variable from outside and then make one of their own with its name.
/// `top_level` has the names that are set at the top level of any script.
void warn_of_shadowed_names(const NameUses& uses, const std::set<Symbol>& top_level,
                            const SymbolTable& symbols, Reporter& reporter);

/// Warns of names that nobody reads. `read_elsewhere` has those that other scripts read.
void warn_of_unused_names(const NameUses& uses, const std::set<Symbol>& read_elsewhere,
                          const SymbolTable& symbols, Reporter& reporter);

}  // namespace crt::lang
