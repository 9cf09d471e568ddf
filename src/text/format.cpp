#include "text/format.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

namespace crt::text {

namespace {

/// A Writer appends arguments to a text.
class Writer {
 public:
  Writer(std::string& to, const Field& field) : to_(to), field_(field) {}

  void operator()(std::string_view text) { to_ += text; }
  void operator()(bool value) { to_ += value ? "true" : "false"; }

  void operator()(char letter) {
    if (field_.type == 0) {
      to_ += letter;
    } else {
      (*this)(static_cast<long long>(letter));
    }
  }

  template <std::integral Integer>
  void operator()(Integer value) {
    const int base = field_.type == 'o' ? 8 : field_.type == 'x' || field_.type == 'X' ? 16 : 10;
    std::string_view digits = written(value, base);
    if (digits.starts_with('-')) {
      to_ += '-';
      digits.remove_prefix(1);
    }
    const std::size_t sign = value < 0 ? 1 : 0;
    const auto width = static_cast<std::size_t>(field_.width);
    if (width > digits.size() + sign) to_.append(width - digits.size() - sign, '0');
    std::transform(digits.begin(), digits.end(), std::back_inserter(to_), [&](char digit) {
      return field_.type == 'X' && digit >= 'a' ? static_cast<char>(digit - 'a' + 'A') : digit;
    });
  }

  template <std::floating_point Real>
  void operator()(Real value) {
    constexpr int usual_precision = 6;
    const int precision = field_.precision < 0 ? usual_precision : field_.precision;
    if (field_.type == 'f') {
      to_ += written(value, std::chars_format::fixed, precision);
    } else if (field_.type == 'g') {
      to_ += written(value, std::chars_format::general, precision);
    } else if (!std::isfinite(value)) {
      to_ += written(value);
    } else {
      write_shortest(written(value, std::chars_format::scientific));
    }
  }

 private:
  template <class... Arguments>
  std::string_view written(Arguments... arguments) {
    const auto result = std::to_chars(room_.data(), room_.data() + room_.size(), arguments...);
    return {room_.data(), result.ptr};
  }

  /// Takes digits as in -1.25e+02, and leaves out the exponent of a number that is not too large or
  /// small.
  void write_shortest(std::string_view scientific) {
    constexpr int least_plain = -4;
    constexpr int max_plain = 15;
    const std::size_t mark = scientific.find('e');
    const std::size_t sign = mark + (scientific[mark + 1] == '+' ? 2 : 1);
    int exponent = 0;
    std::from_chars(scientific.data() + sign, scientific.data() + scientific.size(), exponent);
    if (exponent < least_plain || exponent > max_plain) {
      to_ += scientific;
      return;
    }
    if (scientific.starts_with('-')) to_ += '-';
    std::string digits(scientific.substr(0, mark));
    std::erase(digits, '-');
    std::erase(digits, '.');
    const auto before_point = static_cast<std::size_t>(std::max(exponent + 1, 0));
    if (exponent < 0) digits.insert(0, static_cast<std::size_t>(-exponent), '0');
    if (digits.size() < before_point) digits.append(before_point - digits.size(), '0');
    const std::size_t point = std::max(before_point, std::size_t{1});
    to_ += digits.substr(0, point);
    if (digits.size() > point) to_ += '.' + digits.substr(point);
  }

  /// The longest is a double with no exponent and 99 digits behind the point.
  std::array<char, 512> room_;
  std::string& to_;
  const Field& field_;
};

}  // namespace

std::string format_arguments(std::string_view form, std::span<const Argument> arguments) {
  std::string result;
  for (FormReader reader(form); !reader.at_end();) {
    result += reader.text();
    if (!reader.is_at_field()) continue;
    const Field field = reader.field();
    std::visit(Writer(result, field), arguments[field.argument]);
  }
  return result;
}

}  // namespace crt::text
