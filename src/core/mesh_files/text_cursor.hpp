// The words of a text and their lines, for the mesh files that are text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "crt/vec.hpp"

namespace crt::core {

/// A TextSyntax says what stands between the words of a format.
struct TextSyntax {
  bool comments = false;       ///< from # to the end of the line
  bool continuations = false;  ///< a \ at the end of a line joins it with the next
};

/// A TextCursor goes through a text word by word. Nothing is copied, so lines and words may be of
/// any length. Lines end with \n, \r\n or \r.
class TextCursor {
 public:
  explicit TextCursor(std::string_view text, TextSyntax syntax = {}, std::size_t first_line = 1)
      : text_(text), syntax_(syntax), line_(first_line) {}

  /// Returns the next word of the line, or an empty one at its end.
  std::string_view word_of_line();
  /// Returns the next word of this line or a later one, or an empty one at the end of the text.
  std::string_view word();
  /// Goes to the next line.
  void next_line();
  /// Goes over some bytes that hold no end of a line.
  void skip(std::size_t bytes) { place_ += bytes; }
  /// Goes back to the begin of a word that was the last to be returned.
  void put_back(std::string_view word) {
    place_ = static_cast<std::size_t>(word.data() - text_.data());
  }
  /// Says whether nothing but blanks and comments is left.
  bool at_end();

  /// Returns the line of the next word, or of the one that was returned last if that ended it.
  std::size_t line() const { return line_; }
  std::size_t place() const { return place_; }
  std::string_view rest() const { return text_.substr(place_); }

  /// Returns the next word of any line as a number. Throws RefusedMesh, calling it `what`.
  double number(const char* what);
  /// Returns the next three words of the line as a position. Throws RefusedMesh.
  Vec3 position_of_line();
  /// Returns the next word of any line as an integer. Throws RefusedMesh, calling it `what`.
  std::int64_t integer(const char* what);

 private:
  void skip_blanks();
  /// Returns how many bytes the end of a line at `place` has, or 0.
  std::size_t line_end_at(std::size_t place) const;

  std::string_view text_;
  TextSyntax syntax_;
  std::size_t place_ = 0;
  std::size_t line_;
};

/// Returns what is wrong with a coordinate, or null.
const char* coordinate_fault(double value);

}  // namespace crt::core
