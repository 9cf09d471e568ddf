// This runs a script that was parsed before, so that editors need not parse each text twice.
#pragma once

#include <string>
#include <string_view>

#include "crt/script.hpp"
#include "lang/symbol.hpp"
#include "lang/syntax.hpp"

namespace crt::lang {

/// A ParsedScript is the tree of a text in which the parser found nothing wrong.
struct ParsedScript {
  /// Its places are those of the first source of a SourceMap. The check sets its types.
  Script& script;
  const SymbolTable& symbols;
  int compat = 0;
};

/// Does what run_script() does with the text that was parsed. It is parsed again if the options
/// make another year's script of it.
ScriptResult run_parsed(std::string_view text, const std::string& name,
                        const ScriptOptions& options, const ParsedScript& parsed);

}  // namespace crt::lang
