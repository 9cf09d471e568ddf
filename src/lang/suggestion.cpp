#include "lang/suggestion.hpp"

#include <algorithm>

#include "text/letters.hpp"

namespace crt::lang {

namespace {

constexpr std::size_t longest_word = 64;
/// A script may have millions of names, of which only the first so many are tried.
constexpr std::size_t max_candidates = 10'000;

}  // namespace

std::string_view nearest(std::string_view word, const std::vector<std::string_view>& candidates) {
  if (word.size() > longest_word) return {};
  const std::string wanted = text::in_small_letters(word);
  std::string_view best;
  // A third of the letters may be wrong. In words of one or two letters only the case may be.
  std::size_t best_distance = word.size() / 3 + 1;
  for (std::size_t i = 0; i < std::min(candidates.size(), max_candidates); ++i) {
    const std::string_view candidate = candidates[i];
    if (candidate == word || candidate.size() > longest_word) continue;
    const std::size_t edits = text::edit_distance(wanted, text::in_small_letters(candidate));
    if (edits < best_distance) {
      best = candidate;
      best_distance = edits;
    }
  }
  return best;
}

std::string_view hint_of(std::string_view word, std::span<const Hint> hints) {
  const auto found = std::find_if(hints.begin(), hints.end(),
                                  [word](const Hint& hint) { return hint.word == word; });
  return found == hints.end() ? std::string_view() : found->text;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates) {
  const std::string_view meant = nearest(word, candidates);
  return meant.empty() ? std::string() : "; did you mean '" + std::string(meant) + "'?";
}

}  // namespace crt::lang
