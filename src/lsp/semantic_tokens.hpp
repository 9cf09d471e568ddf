// Semantic tokens colour a script: each token with what it is, as the front end knows it.
#pragma once

#include <array>
#include <crt/language_service.hpp>
#include <crt/text_places.hpp>
#include <cstdint>
#include <string_view>
#include <vector>

namespace crt::lsp {

/// These are the protocol's names of the types, in the order of TokenKind.
constexpr std::array<std::string_view, 9> token_types = {"comment",  "string",    "number",
                                                         "keyword",  "class",     "property",
                                                         "variable", "parameter", "function"};

/// Returns the tokens of a text as the protocol has them: five numbers each, of which the first two
/// are the distance from the token before.
std::vector<std::uint32_t> semantic_tokens(const std::vector<ScriptToken>& tokens,
                                           const TextPlaces& places, ColumnUnit unit);

}  // namespace crt::lsp
