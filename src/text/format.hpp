// Texts are made by forms such as "{} of {}", in the notation of std::format, which not all of our
// compilers have yet. A form is checked when it is compiled. No locale changes what comes out.
//
//   {}       the next argument; numbers have the fewest digits that say which number it is
//   {1}      the second argument
//   {:06}    an integer, zeros before it make it six letters
//   {:04x}   the same in base 16; X has capitals, o is base 8, d is base 10
//   {:.3f}   a number with three digits behind the point
//   {:.6g}   a number with six digits; {:g} has as many
//   {{ }}    a brace
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

namespace crt::text {

/// An Argument is what a form writes.
using Argument =
    std::variant<long long, unsigned long long, float, double, bool, char, std::string_view>;

template <class Value>
constexpr auto as_argument(const Value& value) {
  if constexpr (std::same_as<Value, bool> || std::same_as<Value, char> ||
                std::floating_point<Value>) {
    return value;
  } else if constexpr (std::signed_integral<Value>) {
    return static_cast<long long>(value);
  } else if constexpr (std::unsigned_integral<Value>) {
    return static_cast<unsigned long long>(value);
  } else {
    return std::string_view(value);
  }
}

/// A Field says which argument is written, and how.
struct Field {
  std::size_t argument = 0;
  int width = 0;
  int precision = -1;
  char type = 0;
};

/// A FormReader takes a form apart: a text, a field, a text, ...
class FormReader {
 public:
  constexpr explicit FormReader(std::string_view form) : rest_(form) {}

  constexpr bool at_end() const { return rest_.empty(); }

  /// Returns the text up to the next field or brace that stands for itself.
  constexpr std::string_view text() {
    std::size_t length = rest_.find_first_of("{}");
    if (length > rest_.size()) length = rest_.size();
    const bool is_brace = length + 1 < rest_.size() && rest_[length] == rest_[length + 1];
    const std::string_view result = rest_.substr(0, is_brace ? ++length : length);
    rest_.remove_prefix(is_brace ? length + 1 : length);
    is_at_field_ = !is_brace && !rest_.empty();
    return result;
  }

  constexpr bool is_at_field() const { return is_at_field_; }

  constexpr Field field() {
    Field field;
    expect('{');
    field.argument = is_digit() ? static_cast<std::size_t>(number()) : next_++;
    if (take(':')) {
      if (take('0')) field.width = number();
      if (take('.')) field.precision = number();
      if (!rest_.empty() && rest_.front() != '}') {
        field.type = rest_.front();
        rest_.remove_prefix(1);
      }
    }
    expect('}');
    return field;
  }

 private:
  constexpr bool is_digit() const {
    return !rest_.empty() && rest_.front() >= '0' && rest_.front() <= '9';
  }
  constexpr bool take(char letter) {
    if (rest_.empty() || rest_.front() != letter) return false;
    rest_.remove_prefix(1);
    return true;
  }
  constexpr void expect(char letter) {
    if (!take(letter)) throw std::logic_error("a brace is missing in a form");
  }
  constexpr int number() {
    if (!is_digit()) throw std::logic_error("a number is missing in a form");
    int result = 0;
    for (; is_digit() && result < 100; rest_.remove_prefix(1)) {
      result = 10 * result + (rest_.front() - '0');
    }
    return result;
  }

  std::string_view rest_;
  std::size_t next_ = 0;
  bool is_at_field_ = false;
};

/// A Form is the form for arguments of these types. Others do not compile.
template <class... Values>
class Form {
 public:
  template <std::convertible_to<std::string_view> Text>
  consteval Form(const Text& text)  // NOLINT(google-explicit-constructor): a literal is a form
      : text_(text) {
    constexpr std::array<bool, sizeof...(Values)> is_real = {std::floating_point<Values>...};
    constexpr std::array<bool, sizeof...(Values)> is_whole = {
        (std::integral<Values> && !std::same_as<Values, bool>)...};
    for (FormReader reader(text_); !reader.at_end();) {
      reader.text();
      if (!reader.is_at_field()) continue;
      const Field field = reader.field();
      if (field.argument >= sizeof...(Values)) throw std::logic_error("too few arguments");
      const bool is_integer = field.type == 0 && field.width > 0 && field.precision < 0;
      const std::string_view types = is_real[field.argument]    ? "fg"
                                     : is_whole[field.argument] ? "xXod"
                                                                : "";
      if (field.type == 0 && field.width == 0 && field.precision < 0) continue;
      if (is_integer && is_whole[field.argument]) continue;
      if (types.find(field.type) == std::string_view::npos) {
        throw std::logic_error("this argument cannot be written so");
      }
    }
  }

  constexpr std::string_view text() const { return text_; }

 private:
  std::string_view text_;
};

/// Writes arguments by a form that fits them.
std::string format_arguments(std::string_view form, std::span<const Argument> arguments);

template <class... Values>
std::string format(std::type_identity_t<Form<Values...>> form, const Values&... values) {
  const std::array<Argument, sizeof...(Values)> arguments = {Argument(as_argument(values))...};
  return format_arguments(form.text(), arguments);
}

}  // namespace crt::text
