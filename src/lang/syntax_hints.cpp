// This file guesses what a user of another language meant by what is no CRT, and says how CRT
// writes it.
#include <algorithm>
#include <array>
#include <string_view>

#include "lang/suggestion.hpp"
#include "lang/tree_builder.hpp"
#include "text/format.hpp"

namespace crt::lang {

namespace {

// These words stand before what is unexpected.
constexpr std::array hints_before = {
    Hint{"not", "; 'not' is written '!'"},
    Hint{"union", "; the union of two entities is a + b"},
    Hint{"merge", "; the union of two entities is a + b"},
    Hint{"difference", "; the difference of two entities is a - b"},
    Hint{"intersection", "; the intersection of two entities is a ^ b"},
    Hint{"light_source",
         "; lights are objects such as PointLight { ... }, in 'lights' of Settings"},
    Hint{"texture", "; what a surface looks like is a Material { ... }"},
    Hint{"pigment", "; what a surface looks like is a Material { ... }"},
    Hint{"finish", "; what a surface looks like is a Material { ... }"},
};

// These words are unexpected themselves.
constexpr std::array hints_at = {
    Hint{"and", "; 'and' is written '&&'"},
    Hint{"or", "; 'or' is written '||'"},
};

constexpr std::array<std::string_view, 7> macro_words = {"def", "function", "func",  "fn",
                                                         "sub", "proc",     "module"};

bool is_number(std::string_view found) {
  return found == "a whole number" || found == "a number";
}

constexpr std::array<std::string_view, 5> looks = {"color", "colour", "texture", "pigment",
                                                   "finish"};

std::string_view modifier_hint(std::string_view word) {
  const auto begins = [word](std::string_view small, std::string_view capital) {
    return word.starts_with(small) || word.starts_with(capital);
  };
  if (begins("rotate", "Rotate") || word == "turn" || word == "spin")
    return "; 'rotate' takes the angles about x, y and z: <rotate vec3(0, 45, 0)>";
  if (begins("scale", "Scale") || word == "resize")
    return "; 'scale' takes all three factors: <scale vec3(1, 2, 1)>";
  if (begins("translate", "Translate") || word == "move" || word == "shift")
    return "; 'translate' takes all three offsets: <translate vec3(1, 0, 0)>";
  if (word == "flip") return "; 'mirror' takes the normal of a plane: <mirror vec3(1, 0, 0)>";
  if (word == "shear" || word == "skew")
    return "; 'matrix' does that: <matrix [[1, 0.5, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]>";
  if (std::find(looks.begin(), looks.end(), word) != looks.end())
    return "; 'material' takes a Material: <material Material { color -> rgb(1, 0, 0) }>";
  if (word == "no_shadow") return "; 'shadow' takes a Boolean: <shadow false>";
  if (word == "hidden" || word == "invisible")
    return "; 'visible' takes a Boolean: <visible false>";
  return "; there are 'scale', 'translate', 'rotate', 'mirror', 'matrix', 'material', 'id', "
         "'shadow' and 'visible'";
}

}  // namespace

void TreeBuilder::unknown_modifier(Span name) {
  const std::string_view word = lexer_.text(name);
  reporter_.error(name, text::format("there is no modifier '{}'{}", word, modifier_hint(word)));
}

Modifier TreeBuilder::modifier_with(const Modifier& modifier, Span name,
                                    const Expression* operand) {
  const std::string_view word = lexer_.text(name);
  const bool is_axis = word == "axis";
  if (!is_axis && word != "about") {
    reporter_.error(name,
                    text::format("'{}' takes nothing that is called '{}'; there are 'axis', of "
                                 "'rotate', and 'about'",
                                 word_of(modifier.kind), word));
    return modifier;
  }
  const bool may_have_it =
      is_axis ? modifier.kind == ModifierKind::rotate
              : modifier.kind == ModifierKind::rotate || modifier.kind == ModifierKind::scale ||
                    modifier.kind == ModifierKind::mirror || modifier.kind == ModifierKind::matrix;
  Modifier result = modifier;
  const Expression*& place = is_axis ? result.axis : result.about;
  if (!may_have_it) {
    reporter_.error(name, text::format("'{}' takes no '{}'", word_of(modifier.kind), word));
  } else if (place) {
    reporter_.error(name, text::format("'{}' is said twice", word));
  } else {
    place = operand;
  }
  return result;
}

void TreeBuilder::refuse_default(Span equals) {
  reporter_.error(equals, "the default of a parameter is written with '->', as in Macro (h -> 1)");
}

std::string TreeBuilder::hint(Span place, const std::string& found,
                              const std::vector<std::string>& expected) const {
  const std::string_view text = lexer_.text(place);
  const std::string_view before = lexer_.text(lexer_.before_last());
  const bool wants_value = contains(expected, "a whole number");
  std::string_view result;
  if (wants_value && found == "<") {
    result = "; a Vec3 is written vec3(x, y, z), and a Color rgb(r, g, b)";
  } else if (found == "scale" || found == "translate" || found == "rotate") {
    result = "; modifiers stand behind an entity: ball <translate vec3(1, 0, 0)>";
  } else if (is_number(found) && contains(expected, "rotate") && !wants_value) {
    result = "; three numbers are one Vec3: <scale vec3(1, 2, 1)>";
  } else if (contains(expected, "in") && found == "=") {
    result = "; a loop that counts is written for (i in range(10)) { ... }";
  } else if (text == "{" || text == ":") {
    const std::string_view first = lexer_.first_word_of_line(place);
    if (std::find(macro_words.begin(), macro_words.end(), first) != macro_words.end()) {
      result = how_to_write_macros;
    } else {
      const std::string_view called = lexer_.word_before_brackets(place);
      result = hint_of(called, hints_before);
    }
  }
  if (result.empty()) result = hint_of(text, hints_at);
  if (result.empty()) result = hint_of(before, hints_before);
  return std::string(result);
}

}  // namespace crt::lang
