#include "core/base/text_numbers.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace crt::core {

namespace {

/// Takes a plus sign away, which std::from_chars does not know.
std::string_view without_plus(std::string_view word) {
  const bool has_plus = word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+';
  return has_plus ? word.substr(1) : word;
}

/// Says whether a number that no double can hold is too small rather than too large. The word is a
/// number.
bool is_tiny(std::string_view word) {
  // The exponent of its first digit that is not 0, in powers of ten, decides.
  std::int64_t exponent = 0;
  const std::size_t mark = word.find_first_of("eE");
  if (mark != std::string_view::npos) {
    const std::string_view power = without_plus(word.substr(mark + 1));
    const auto read = std::from_chars(power.data(), power.data() + power.size(), exponent);
    // A power that does not fit is far from whatever digits can balance.
    if (read.ec != std::errc{}) return power.starts_with('-');
  }
  const std::string_view digits = word.substr(0, mark);
  const std::size_t first = digits.find_first_of("123456789");
  if (first == std::string_view::npos) return true;
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const auto places = static_cast<std::int64_t>(point) - static_cast<std::int64_t>(first);
  return exponent < -places;
}

}  // namespace

std::optional<double> number_of(std::string_view word) {
  word = without_plus(word);
  double value = 0;
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (failure == std::errc::invalid_argument || end != word.data() + word.size()) return {};
  if (failure != std::errc::result_out_of_range) return value;
  const double limit = is_tiny(word) ? 0 : std::numeric_limits<double>::infinity();
  return std::copysign(limit, word.starts_with('-') ? -1.0 : 1.0);
}

std::optional<std::int64_t> integer_of(std::string_view word) {
  word = without_plus(word);
  std::int64_t value = 0;
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (failure != std::errc{} || end != word.data() + word.size()) return {};
  return value;
}

}  // namespace crt::core
