// The first word of OFF files, for what reads them and for what recognises them.
#pragma once

#include <optional>
#include <string_view>

namespace crt::core {

/// Returns the length of the word that OFF files begin with, such as "OFF" or "COFF". Digits may
/// follow it at once. Returns nothing if the text begins otherwise.
std::optional<std::size_t> off_word_length(std::string_view text);

}  // namespace crt::core
