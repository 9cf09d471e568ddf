// The check finds what is wrong with a tree before it runs: objects and attributes that do not
// exist, blocks that are there twice.
#pragma once

#include <set>

#include "lang/reporter.hpp"
#include "lang/symbol.hpp"
#include "lang/syntax.hpp"

namespace crt::lang {

/// Finds the rows of all objects in the table, and reports each error. Throws GiveUp when the
/// reporter has enough. `compat` is that of ScriptOptions. Scripts of 2015 may give attributes that
/// do not exist, whose index is then the number of those that do.
void check(Script& script, int compat, const SymbolTable& symbols, Reporter& reporter);

/// Collects the names that a statement can assign in its scope or one around it. Those in the
/// bodies of macros are left out.
void collect_assigned(const Statement& statement, std::set<Symbol>& names);
void collect_assigned(const Block& block, std::set<Symbol>& names);

}  // namespace crt::lang
