// This file puts into words that a name is unknown, and guesses what was meant.
#include <algorithm>
#include <array>
#include <string_view>

#include "lang/failure.hpp"
#include "lang/interpreter.hpp"
#include "lang/library.hpp"
#include "lang/name_uses.hpp"
#include "lang/suggestion.hpp"
#include "text/format.hpp"

namespace crt::lang {

namespace {

constexpr std::string_view how_to_set = "; a variable is set by its name alone: x = 1";
constexpr std::string_view no_null =
    "; there is no value for nothing; leave the attribute out, or use an empty List";

/// Says how CRT writes what a word means in other languages. Any of them may be a variable's name.
constexpr std::array foreign_hints = {
    Hint{"let", how_to_set},
    Hint{"var", how_to_set},
    Hint{"const", how_to_set},
    Hint{"local", how_to_set},
    Hint{"declare", how_to_set},
    Hint{"def", how_to_write_macros},
    Hint{"function", how_to_write_macros},
    Hint{"func", how_to_write_macros},
    Hint{"fn", how_to_write_macros},
    Hint{"and", "; 'and' is written '&&'"},
    Hint{"or", "; 'or' is written '||'"},
    Hint{"not", "; 'not' is written '!'"},
    Hint{"null", no_null},
    Hint{"nil", no_null},
    Hint{"none", no_null},
    Hint{"undefined", no_null},
    Hint{"new", "; objects are written without 'new': Sphere { ... }"},
    Hint{"mix", "; that is lerp(a, b, t)"},
    Hint{"radians", "; that is rad(x), or 45deg"},
    Hint{"degrees", "; that is deg(x)"},
    Hint{"module", how_to_write_macros},
    Hint{"union", "; the union of two entities is a + b"},
    Hint{"difference", "; the difference of two entities is a - b"},
    Hint{"intersection", "; the intersection of two entities is a ^ b"},
};

/// Says how an object is written whose name begins with a small letter.
std::string hint_of_object(std::string_view word) {
  for (const ObjectType& type : object_types()) {
    const bool is_same = std::equal(
        word.begin(), word.end(), type.name.begin(), type.name.end(),
        [](char a, char b) { return a == b || (b >= 'A' && b <= 'Z' && a == b - 'A' + 'a'); });
    if (is_same) return text::format("; an object is written {} {{ ... }}", type.name);
  }
  return {};
}

}  // namespace

void Interpreter::unknown_name(Symbol name, Span span) const {
  const std::string_view text = context_.symbols.name(name);
  std::string hint(hint_of(text, foreign_hints));
  if (hint.empty()) hint = hint_of_order(name, span);
  if (hint.empty()) hint = hint_of_library(text);
  if (hint.empty()) hint = hint_of_object(text);
  if (hint.empty()) {
    std::vector<std::string_view> names;
    for (const Scope* scope = scope_.get(); scope; scope = scope->parent()) {
      for (const auto& [symbol, value] : scope->variables())
        names.push_back(context_.symbols.name(symbol));
    }
    hint = did_you_mean(text, names);
  }
  fail(span, "unknown name '{}'{}", text, hint);
}

/// Says that a name is one of the library, if it is.
std::string Interpreter::hint_of_library(std::string_view name) const {
  const std::string path = library_path_of(name);
  if (path.empty()) return {};
  // Values from outside are computed before anything is imported.
  return text::format("; '{}' is in \"{}\"{}", name, path,
                      has_begun_ ? ": import it" : ", which is not imported yet: write its value");
}

/// Says that a name is set further down, if it is.
std::string Interpreter::hint_of_order(Symbol name, Span span) const {
  const NamePlace* later = name_uses_ ? set_further_down(*name_uses_, name, span) : nullptr;
  if (!later) return {};
  return text::format("; it is set only in line {}", context_.sources.place(later->span).line);
}

}  // namespace crt::lang
