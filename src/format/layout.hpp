// A layout is a script as lines of pieces: tokens and comments in the order of the text, each with
// what decides about the blanks around it.
#pragma once

#include <string_view>
#include <vector>

#include "lang/partial_parse.hpp"
#include "lang/source_map.hpp"
#include "lang/syntax.hpp"

namespace crt::format {

/// A Role is how a piece stands among others.
enum class Role {
  word,    ///< a name, a literal or a keyword
  sign,    ///< an operator between two operands, or any other sign with blanks around it
  prefix,  ///< an operator before its operand
  comma,
  joint,           ///< a sign without blanks around it: that of a part or a slice
  opening,         ///< ( or [ that begins an expression, or a string up to a value
  suffix_opening,  ///< ( or [ of a call or an index
  opening_brace,
  opening_modifiers,
  closing,  ///< ) or ], or a string behind a value
  closing_brace,
  closing_modifiers,
  comment,
};

struct Piece {
  Role role = Role::word;
  std::string_view text{};
  /// Counts the line ends between the piece before and this one.
  std::size_t lines_before = 0;
  /// Is where the piece begins on its line, in characters from 0.
  std::size_t column = 0;
  /// Says that the piece continues an expression that began on an earlier line.
  bool continues = false;
};

/// Returns the pieces of a script that has no syntax errors.
std::vector<Piece> lay_out(const lang::Source& source, const lang::TokenList& list,
                           const lang::Script& script);

}  // namespace crt::format
