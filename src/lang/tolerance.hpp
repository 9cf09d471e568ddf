// An editor's text is rarely whole. The tolerance says how the front end takes such a text.
#pragma once

#include <vector>

#include "lang/source_map.hpp"

namespace crt::lang {

struct Tolerance {
  /// Says that the text was cut off at the cursor of an editor. The parser then finds out what it
  /// would take there, and `<` before the cursor begins modifiers.
  bool ends_at_cursor = false;
  /// Closes the brackets that are open at the end, so that the tree holds what is in them. Each is
  /// an error. What was closed by this ends behind the end of the text.
  bool closes_brackets = false;
  /// Gets the comments, in order, if it is not null.
  std::vector<Span>* comments = nullptr;
};

}  // namespace crt::lang
