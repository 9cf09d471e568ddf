#include "cli/suggestion.hpp"

#include <algorithm>
#include <cstddef>

namespace crt::cli {

namespace {

/// Returns how many letters must be changed, added, removed or swapped with their neighbour (the
/// distance of optimal string alignment).
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> steps(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        steps[i][j] = i + j;
        continue;
      }
      const std::size_t wrong = a[i - 1] == b[j - 1] ? 0 : 1;
      steps[i][j] =
          std::min({steps[i - 1][j] + 1, steps[i][j - 1] + 1, steps[i - 1][j - 1] + wrong});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) steps[i][j] = std::min(steps[i][j], steps[i - 2][j - 2] + 1);
    }
  }
  return steps[a.size()][b.size()];
}

}  // namespace

std::string nearest_word(std::string_view word, const std::vector<std::string>& known) {
  constexpr std::size_t letters_for_a_mistake = 3;
  constexpr std::size_t longest_word = 64;  // no command and no option is longer
  if (word.size() > longest_word) return "";
  std::size_t least = 1 + std::max<std::size_t>(1, word.size() / letters_for_a_mistake);
  std::string nearest;
  for (const std::string& candidate : known) {
    const std::size_t mistakes = distance(word, candidate);
    if (mistakes >= least) continue;
    least = mistakes;
    nearest = candidate;
  }
  return nearest;
}

}  // namespace crt::cli
