#include "cli/suggestion.hpp"

#include <algorithm>
#include <cstddef>

#include "text/words.hpp"

namespace crt::cli {

std::string nearest_word(std::string_view word, const std::vector<std::string>& known) {
  constexpr std::size_t letters_for_a_mistake = 3;
  constexpr std::size_t longest_word = 64;  // no command and no option is longer
  if (word.size() > longest_word) return "";
  std::size_t least = 1 + std::max<std::size_t>(1, word.size() / letters_for_a_mistake);
  std::string nearest;
  for (const std::string& candidate : known) {
    const std::size_t mistakes = text::edit_distance(word, candidate);
    if (mistakes >= least) continue;
    least = mistakes;
    nearest = candidate;
  }
  return nearest;
}

}  // namespace crt::cli
