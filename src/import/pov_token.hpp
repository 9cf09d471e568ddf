// The words of POV-Ray's scene description language.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "import/notes.hpp"

namespace crt::importing {

struct PovToken {
  enum class Kind { end, number, text, word, directive, sign };
  Kind kind = Kind::end;
  std::string text{};  ///< a directive has it without the '#'
  double number = 0;
  Place place{};

  bool is_sign(std::string_view sign) const { return kind == Kind::sign && text == sign; }
  bool is_word(std::string_view word) const { return kind == Kind::word && text == word; }
  bool is_directive(std::string_view word) const { return kind == Kind::directive && text == word; }
};

/// Cuts the text of a file into tokens. Throws Failure for what is none.
std::vector<PovToken> pov_tokens(std::string_view text, int file);

}  // namespace crt::importing
