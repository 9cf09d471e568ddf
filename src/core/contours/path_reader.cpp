#include "core/contours/path_reader.hpp"

#include <cmath>
#include <limits>

#include "core/base/text_numbers.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_one_of(char c, std::string_view characters) {
  return characters.find(c) != std::string_view::npos;
}

}  // namespace

void PathReader::refuse_at(std::size_t place, const std::string& wanted) const {
  std::size_t characters = 1;
  for (std::size_t i = 0; i < place; ++i) {
    constexpr unsigned continuation_mask = 0xc0;
    constexpr unsigned continuation = 0x80;
    if ((static_cast<unsigned char>(text_[i]) & continuation_mask) != continuation) ++characters;
  }
  std::string found = "the end";
  if (place < text_.size()) {
    const auto byte = static_cast<unsigned char>(text_[place]);
    const bool is_shown = byte >= ' ' && byte <= '~';
    found = is_shown ? text::format("'{}'", text_[place]) : text::format("the byte 0x{:02x}", byte);
  }
  throw Error(ErrorCode::invalid_argument,
              text::format("path has {} at character {}, where {}", found, characters, wanted),
              "path");
}

void PathReader::skip_blanks() {
  while (place_ < text_.size() && is_one_of(text_[place_], " \t\n\f\r")) ++place_;
}

bool PathReader::at_end() {
  skip_blanks();
  return place_ == text_.size();
}

char PathReader::command() {
  skip_blanks();
  const char letter = next();
  if (place_ == text_.size() || !is_one_of(letter, "MmLlHhVvCcSsQqTtAaZz")) {
    refuse("a command of a path is expected: one of MLHVCSQTAZ, or a small one");
  }
  ++place_;
  is_behind_command_ = true;
  return letter;
}

bool PathReader::begins_number() const {
  std::size_t i = place_;
  const auto at = [&](std::size_t k) { return k < text_.size() ? text_[k] : '\0'; };
  if (at(i) == '+' || at(i) == '-') ++i;
  if (at(i) == '.') ++i;
  return is_digit(at(i));
}

bool PathReader::has_more() {
  skip_blanks();
  return next() == ',' || begins_number();
}

void PathReader::begin_argument() {
  skip_blanks();
  if (!is_behind_command_ && next() == ',') {
    ++place_;
    skip_blanks();
  }
  is_behind_command_ = false;
}

std::size_t PathReader::skip_digits() {
  const std::size_t before = place_;
  while (is_digit(next())) ++place_;
  return place_ - before;
}

double PathReader::number() {
  begin_argument();
  if (!begins_number()) refuse("a number is expected");
  const std::size_t begin = place_;
  if (next() == '+' || next() == '-') ++place_;
  skip_digits();
  if (next() == '.') {
    ++place_;
    skip_digits();
  }
  const std::size_t mantissa_end = place_;
  if (next() == 'e' || next() == 'E') {
    ++place_;
    if (next() == '+' || next() == '-') ++place_;
    if (skip_digits() == 0) place_ = mantissa_end;
  }
  const double value = number_of(text_.substr(begin, place_ - begin))
                           .value_or(std::numeric_limits<double>::infinity());
  constexpr double largest = 1e100;
  if (!(std::abs(value) <= largest)) {
    refuse_at(begin, "a number of at most 1e100 in magnitude is expected");
  }
  return value;
}

bool PathReader::flag() {
  begin_argument();
  if (next() != '0' && next() != '1') refuse("a flag is expected: 0 or 1");
  return text_[place_++] == '1';
}

}  // namespace crt::core
