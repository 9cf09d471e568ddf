// This part of the lexer reads numbers and strings.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string_view>
#include <system_error>

#include "lang/lexer.hpp"
#include "lang/utf8.hpp"

namespace crt::lang {

namespace {

bool is_high_surrogate(std::uint32_t unit) {
  return unit >= 0xD800 && unit <= 0xDBFF;
}

bool is_low_surrogate(std::uint32_t unit) {
  return unit >= 0xDC00 && unit <= 0xDFFF;
}

bool is_letter(unsigned char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// A NumberUnit is one of lengths, or one of angles, of which so many are half a turn.
struct NumberUnit {
  std::string_view name;
  std::optional<Unit> length{};
  double half_turn = 0;
};

constexpr std::array number_units = {NumberUnit{"mm", Unit::mm},
                                     NumberUnit{"cm", Unit::cm},
                                     NumberUnit{"m", Unit::m},
                                     NumberUnit{"in", Unit::in},
                                     NumberUnit{.name = "deg", .half_turn = 180},
                                     NumberUnit{.name = "rad", .half_turn = std::numbers::pi}};

bool is_digit(unsigned char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

/// Reads a unit that a number is followed by directly, and returns the number with it. Other
/// letters there are an error.
std::optional<Number> Lexer::unit_after_number(double value) {
  if (!is_letter(*cursor_)) return {};
  const Byte* const begin = cursor_;
  while (is_letter(*cursor_) || is_digit(*cursor_)) ++cursor_;
  const std::string_view letters = text({offset(begin), offset(cursor_)});
  const auto unit = std::ranges::find(number_units, letters, &NumberUnit::name);
  if (unit != number_units.end() && compat_ != compat_2015) {
    if (unit->length) return Number{value, unit->length};
    return Number{.value = value * std::numbers::pi / unit->half_turn, .is_angle = true};
  }
  reporter_.error(token_span(), "'" + std::string(token_text()) +
                                    "' is neither a number nor a name; a number such as 10mm has "
                                    "one of the units mm, cm, m, in, deg and rad");
  return {};
}

Grammar::symbol_type Lexer::whole_number() {
  const std::string_view digits = token_text();
  std::int64_t value = 0;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (result.ec != std::errc{})
    reporter_.error(token_span(),
                    "this whole number does not fit into 64 bits; write it as a Float (1e30)");
  double number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const std::optional<Number> with_unit = unit_after_number(number);
  first_on_line_ = false;
  if (with_unit) return Grammar::make_FLOAT(*with_unit, token_span());
  return Grammar::make_INTEGER(value, token_span());
}

Grammar::symbol_type Lexer::decimal_number() {
  const std::string_view digits = token_text();
  double value = 0;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (result.ec != std::errc{})
    reporter_.error(token_span(),
                    "this number is out of the range of Floats, about 1e-308 to 1e308");
  const std::optional<Number> with_unit = unit_after_number(value);
  first_on_line_ = false;
  return Grammar::make_FLOAT(with_unit.value_or(Number{value}), token_span());
}

/// Reads a string, or what is behind a value in it. It is a token of the kind `whole`, or one
/// `up_to_value` if it has another value in it.
Grammar::symbol_type Lexer::string(Grammar::token::token_kind_type whole,
                                   Grammar::token::token_kind_type up_to_value) {
  std::string value;
  for (;;) {
    if (cursor_ == limit_ || *cursor_ == '\n' || *cursor_ == '\r') {
      // This may have been meant as the end of a string around it.
      if (!open_values_.empty()) return unclosed_value();
      reporter_.error(token_span(), "this string is not closed: it needs a '\"' on the same line");
      break;
    }
    if (*cursor_ == '"') {
      ++cursor_;
      break;
    }
    if (cursor_[0] == '\\' && cursor_[1] == '{' && compat_ != compat_2015) {
      cursor_ += 2;
      open_brackets_.push_back({offset(cursor_) - 1, offset(cursor_)});
      open_values_.push_back(offset(cursor_) - 1);
      first_on_line_ = false;
      return string_token(up_to_value, std::move(value));
    }
    if (*cursor_ == '\\') {
      escape(value);
      continue;
    }
    const Byte* const start = cursor_;
    std::size_t position = offset(cursor_) - source_.base;
    const std::size_t before = position;
    const bool is_utf8 = decode_utf8(source_.text, position).has_value();
    cursor_ += position - before;
    if (is_utf8) {
      value.append(source_.text, before, position - before);
    } else {
      reporter_.error({offset(start), offset(cursor_)},
                      "this byte is not UTF-8, the encoding of scripts");
    }
  }
  first_on_line_ = false;
  return string_token(whole, std::move(value));
}

/// Says whether a '}' closes a value in a string, and forgets what is open within the value if so.
bool Lexer::closes_value() {
  if (open_values_.empty()) return false;
  const auto brace = std::find_if(open_brackets_.rbegin(), open_brackets_.rend(),
                                  [this](Span open) { return text(open) == "{"; });
  if (brace == open_brackets_.rend() || brace->begin != open_values_.back()) return false;
  open_brackets_.erase(brace.base() - 1, open_brackets_.end());
  open_values_.pop_back();
  forget_closed_modifiers();
  return true;
}

/// Says whether a value in a string is still open at a token, which then is read again behind it.
bool Lexer::value_is_open() {
  if (!open_values_.empty()) cursor_ = token_;
  return !open_values_.empty();
}

/// Ends a string in which a value is still open where its line ends.
Grammar::symbol_type Lexer::unclosed_value() {
  const std::uint32_t brace = open_values_.back();
  reporter_.error({brace - 1, brace + 1},
                  "this value in a string is not closed: it needs a '}' on the same line");
  while (open_brackets_.back().begin != brace) open_brackets_.pop_back();
  open_brackets_.pop_back();
  open_values_.pop_back();
  forget_closed_modifiers();
  return string_token(Grammar::token::STRING_END, {});
}

Grammar::symbol_type Lexer::string_token(Grammar::token::token_kind_type kind, std::string value) {
  return Grammar::symbol_type(kind, std::move(value), token_span());
}

void Lexer::escape(std::string& value) {
  const Byte* const start = cursor_++;  // the backslash
  const Byte letter = *cursor_;
  const bool line_ends = cursor_ == limit_ || letter == '\n' || letter == '\r';
  // A character of several bytes stays, and is read as any other.
  if (!line_ends && letter < 0x80) ++cursor_;
  switch (letter) {
    case '"':
    case '\'':
    case '\\':
      value += static_cast<char>(letter);
      return;
    case 'n':
      value += '\n';
      return;
    case 't':
      value += '\t';
      return;
    case 'u':
      unicode_escape(value, start);
      return;
    default:
      break;
  }
  if (line_ends) return;  // the string is not closed, which is reported later
  reporter_.error({offset(start), offset(cursor_)},
                  R"(unknown escape; there are \" \' \\ \n \t \uXXXX and \{value})");
}

/// Reads four hexadecimal digits, if they are there.
std::optional<std::uint32_t> Lexer::hexadecimal_unit() {
  constexpr int unit_digits = 4;
  if (limit_ - cursor_ < unit_digits) return std::nullopt;
  const char* const begin = reinterpret_cast<const char*>(cursor_);
  std::uint32_t unit = 0;
  const auto result = std::from_chars(begin, begin + unit_digits, unit, 16);
  if (result.ec != std::errc{} || result.ptr != begin + unit_digits) return std::nullopt;
  cursor_ += unit_digits;
  return unit;
}

/// Reads \uXXXX, or two of them for a code point beyond U+FFFF (a surrogate pair, as in JSON).
void Lexer::unicode_escape(std::string& value, const Byte* start) {
  const auto refuse = [&](const char* reason) {
    reporter_.error({offset(start), offset(cursor_)}, reason);
  };
  const std::optional<std::uint32_t> unit = hexadecimal_unit();
  if (!unit) return refuse("\\u needs four hexadecimal digits, as in \\u00e9");
  if (!is_high_surrogate(*unit) && !is_low_surrogate(*unit)) return append_utf8(value, *unit);
  if (is_high_surrogate(*unit) && cursor_[0] == '\\' && cursor_[1] == 'u') {
    cursor_ += 2;
    const std::optional<std::uint32_t> low = hexadecimal_unit();
    if (low && is_low_surrogate(*low))
      return append_utf8(value, 0x10000 + ((*unit - 0xD800) << 10) + (*low - 0xDC00));
  }
  refuse("half of a surrogate pair is no character");
}

}  // namespace crt::lang
