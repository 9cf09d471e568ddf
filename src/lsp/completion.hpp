// Completion offers what the grammar takes at the cursor: the parser itself is asked. Names are
// those that can be seen there, attributes those that the object has and that are not set yet.
#pragma once

#include <crt/script.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "lsp/program.hpp"
#include "lsp/reference.hpp"

namespace crt::lsp {

enum class CompletionKind { attribute, object, variable, macro, function, constant, keyword };

struct Completion {
  CompletionKind kind = CompletionKind::variable;
  std::string label;
  std::string detail;
  std::string documentation;
  std::string text;     ///< what is put in
  std::string snippet;  ///< the same with places to fill in, or empty
  /// Lower ones are shown first.
  int rank = 0;
};

struct CompletionList {
  std::vector<Completion> items;
  /// The bytes of the main script that an item replaces.
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

/// Returns what may come at a byte of the main script.
CompletionList complete(const Program& program, std::uint32_t byte, const ScriptOptions& options,
                        const Reference& reference);

}  // namespace crt::lsp
