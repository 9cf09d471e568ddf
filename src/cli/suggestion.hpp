// This finds the word that someone who misspelt it may have meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace crt::cli {

/// Returns the word among `known` that is most like `word`: few letters are wrong, missing, in
/// excess or swapped with the next. It is empty if none is near.
std::string nearest_word(std::string_view word, const std::vector<std::string>& known);

}  // namespace crt::cli
