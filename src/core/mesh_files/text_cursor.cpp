#include "core/mesh_files/text_cursor.hpp"

#include <cmath>
#include <optional>
#include <string>

#include "core/base/text_numbers.hpp"
#include "core/mesh_files/refused_mesh.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

bool is_line_end(char c) {
  return c == '\n' || c == '\r';
}

}  // namespace

const char* coordinate_fault(double value) {
  constexpr double largest_coordinate = 1e100;
  if (!std::isfinite(value)) return "is not finite";
  return std::abs(value) > largest_coordinate ? "is beyond 1e100" : nullptr;
}

std::size_t TextCursor::line_end_at(std::size_t place) const {
  if (place >= text_.size() || !is_line_end(text_[place])) return 0;
  return text_.substr(place).starts_with("\r\n") ? 2 : 1;
}

void TextCursor::skip_blanks() {
  while (place_ < text_.size()) {
    const char c = text_[place_];
    if (is_blank(c)) {
      ++place_;
    } else if (c == '\\' && syntax_.continuations && line_end_at(place_ + 1) > 0) {
      place_ += 1 + line_end_at(place_ + 1);
      ++line_;
    } else if (c == '#' && syntax_.comments) {
      while (place_ < text_.size() && !is_line_end(text_[place_])) ++place_;
    } else {
      return;
    }
  }
}

std::string_view TextCursor::word_of_line() {
  skip_blanks();
  const std::size_t begin = place_;
  while (place_ < text_.size()) {
    const char c = text_[place_];
    if (is_blank(c) || is_line_end(c) || (c == '#' && syntax_.comments)) break;
    if (c == '\\' && syntax_.continuations && line_end_at(place_ + 1) > 0) break;
    ++place_;
  }
  return text_.substr(begin, place_ - begin);
}

std::string_view TextCursor::word() {
  return at_end() ? std::string_view() : word_of_line();
}

void TextCursor::next_line() {
  while (place_ < text_.size() && !is_line_end(text_[place_])) {
    const bool joins = syntax_.continuations && text_[place_] == '\\';
    ++place_;
    if (!joins || line_end_at(place_) == 0) continue;
    place_ += line_end_at(place_);
    ++line_;
  }
  if (place_ == text_.size()) return;
  place_ += line_end_at(place_);
  ++line_;
}

bool TextCursor::at_end() {
  for (skip_blanks(); line_end_at(place_) > 0; skip_blanks()) next_line();
  return place_ >= text_.size();
}

double TextCursor::number(const char* what) {
  const std::string_view text = word();
  if (text.empty()) refuse_line(line_, text::format("the file ends where {} should be", what));
  const std::optional<double> value = number_of(text);
  if (!value)
    refuse_line(line_, text::format("{} is {}, which is no number", what, in_quotes(text)));
  return *value;
}

std::int64_t TextCursor::integer(const char* what) {
  const std::string_view text = word();
  if (text.empty()) refuse_line(line_, text::format("the file ends where {} should be", what));
  const std::optional<std::int64_t> value = integer_of(text);
  if (!value)
    refuse_line(line_, text::format("{} is {}, which is no integer", what, in_quotes(text)));
  return *value;
}

Vec3 TextCursor::position_of_line() {
  Vec3 position{};
  for (int axis = 0; axis < 3; ++axis) {
    const std::string_view text = word_of_line();
    if (text.empty()) {
      refuse_line(line_, text::format("a vertex needs three coordinates, and here are {}", axis));
    }
    const std::optional<double> value = number_of(text);
    const char* const fault = value ? coordinate_fault(*value) : "is no number";
    if (fault != nullptr)
      refuse_line(line_, text::format("the coordinate {} {}", in_quotes(text), fault));
    position[axis] = *value;
  }
  return position;
}

}  // namespace crt::core
