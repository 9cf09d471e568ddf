// The parser turns text into a tree.
#pragma once

#include <cstddef>

#include "lang/reporter.hpp"
#include "lang/source_map.hpp"
#include "lang/symbol.hpp"
#include "lang/syntax.hpp"

namespace crt::lang {

/// Parses a source. Errors go to the reporter, and after one the tree must not be used. Throws
/// GiveUp when the reporter has enough or a limit is passed. `memory_left` is the number of bytes
/// that the tree may hold, and `compat` is that of ScriptOptions.
Script parse(const Source& source, TextKind kind, int compat, SymbolTable& symbols,
             Reporter& reporter, std::size_t& memory_left);

}  // namespace crt::lang
