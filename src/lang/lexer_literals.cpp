// This part of the lexer reads numbers and strings.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
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

struct LengthUnit {
  std::string_view name;
  Unit unit;
};

constexpr std::array length_units = {LengthUnit{"mm", Unit::mm}, LengthUnit{"cm", Unit::cm},
                                     LengthUnit{"m", Unit::m}, LengthUnit{"in", Unit::in}};

bool is_digit(unsigned char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

/// Reads a unit that a number is followed by directly. Other letters there are an error.
std::optional<Unit> Lexer::unit_after_number() {
  if (!is_letter(*cursor_)) return {};
  const Byte* const begin = cursor_;
  while (is_letter(*cursor_) || is_digit(*cursor_)) ++cursor_;
  const std::string_view letters = text({offset(begin), offset(cursor_)});
  const auto unit = std::ranges::find(length_units, letters, &LengthUnit::name);
  if (unit != length_units.end() && compat_ != compat_2015) return unit->unit;
  reporter_.error(token_span(), "'" + std::string(token_text()) +
                                    "' is neither a number nor a name; a length such as 10mm has "
                                    "one of the units mm, cm, m and in");
  return {};
}

Grammar::symbol_type Lexer::whole_number() {
  const std::string_view digits = token_text();
  std::int64_t value = 0;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (result.ec != std::errc{})
    reporter_.error(token_span(),
                    "this whole number does not fit into 64 bits; write it as a Float (1e30)");
  const std::size_t length = digits.size();
  const std::optional<Unit> unit = unit_after_number();
  first_on_line_ = false;
  if (unit) {
    double number = 0;
    std::from_chars(token_text().data(), token_text().data() + length, number);
    return Grammar::make_FLOAT(Number{number, unit}, token_span());
  }
  return Grammar::make_INTEGER(value, token_span());
}

Grammar::symbol_type Lexer::decimal_number() {
  const std::string_view digits = token_text();
  double value = 0;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (result.ec != std::errc{})
    reporter_.error(token_span(),
                    "this number is out of the range of Floats, about 1e-308 to 1e308");
  const std::optional<Unit> unit = unit_after_number();
  first_on_line_ = false;
  return Grammar::make_FLOAT(Number{value, unit}, token_span());
}

Grammar::symbol_type Lexer::string() {
  std::string value;
  for (;;) {
    if (cursor_ == limit_ || *cursor_ == '\n' || *cursor_ == '\r') {
      reporter_.error(token_span(), "this string is not closed: it needs a '\"' on the same line");
      break;
    }
    if (*cursor_ == '"') {
      ++cursor_;
      break;
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
  return Grammar::make_STRING(std::move(value), token_span());
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
                  R"(unknown escape; there are \" \' \\ \n \t \uXXXX)");
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
