// The words of an SVG path. Source: Scalable Vector Graphics (SVG) 2, section 9.3.9, the grammar.
// Tests: tests/contours/svg_path_test.cpp
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace crt::core {

class PathReader {
 public:
  explicit PathReader(std::string_view text) : text_(text) {}

  /// Goes over blanks, and returns whether the text is at its end.
  bool at_end();
  /// Reads the letter of a command. Throws Error if there is none.
  char command();
  /// Goes over blanks behind an argument, and returns whether another follows.
  bool has_more();
  /// Reads a number. Throws Error if there is none.
  double number();
  /// Reads a flag, which is 0 or 1, and needs no blank behind it.
  bool flag();

  /// Throws Error (invalid_argument) about the place where the reader is, or about an earlier one.
  [[noreturn]] void refuse(const std::string& wanted) const { refuse_at(place_, wanted); }
  [[noreturn]] void refuse_at(std::size_t place, const std::string& wanted) const;
  std::size_t place() const { return place_; }

 private:
  void skip_blanks();
  void begin_argument();
  bool begins_number() const;
  std::size_t skip_digits();
  char next() const { return place_ < text_.size() ? text_[place_] : '\0'; }

  std::string_view text_;
  std::size_t place_ = 0;
  bool is_behind_command_ = false;
};

}  // namespace crt::core
