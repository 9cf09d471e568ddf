// These tests check what the names of a script mean before it runs, and that texts which are not
// whole are understood as far as they go.
#include "lang/name_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "lang/partial_parse.hpp"

namespace {

using namespace crt::lang;

/// A Mapped is a text with its names.
struct Mapped {
  SourceMap sources;
  SymbolTable symbols;
  Reporter reporter{sources, 1000};
  const Source* source = nullptr;
  PartialScript parsed;
  NameMap names;

  explicit Mapped(const std::string& text, PartialEnd end = PartialEnd::text) {
    source = &sources.add("test", text);
    parsed = parse_partially(*source, end, 0, symbols, reporter);
    names = map_names(parsed.script, [](const Import&) { return nullptr; });
  }

  /// Returns the lines of all places of the name that stands at the n-th `word`.
  std::vector<std::size_t> lines_of(std::string_view word, int n = 0) const {
    std::size_t place = source->text.find(word);
    while (n-- > 0) place = source->text.find(word, place + 1);
    const NameUse* use = use_at(names, static_cast<std::uint32_t>(place));
    std::vector<std::size_t> lines;
    if (!use || use->declared == NameUse::nothing) return lines;
    for (const NameUse& other : names.uses) {
      if (other.declared != use->declared) continue;
      const auto text = source->text.substr(0, other.span.begin);
      lines.push_back(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1);
    }
    return lines;
  }

  std::vector<std::string> visible_at_end() const {
    std::vector<std::string> result;
    for (const DeclaredName* name :
         names_at(names, static_cast<std::uint32_t>(source->text.size())))
      result.emplace_back(symbols.name(name->symbol));
    return result;
  }
};

using Lines = std::vector<std::size_t>;
using Strings = std::vector<std::string>;

}  // namespace

TEST_CASE("a body in braces changes the variable around it, a macro makes its own") {
  const Mapped script("x = 1\nif (true) { x = 2 }\nf = Macro () { x = 3 }\nf()\nprint(x)\n");
  CHECK(script.lines_of("x") == Lines{1, 2, 5});
  CHECK(script.lines_of("x", 2) == Lines{3});
}

TEST_CASE("what is set in a body first is not seen behind it") {
  const Mapped script("if (true) {\n y = 1\n y\n}\ny = 2\n");
  CHECK(script.lines_of("y") == Lines{2, 3});
  CHECK(script.lines_of("y", 2) == Lines{5});
}

TEST_CASE("a macro reads what is set around it later") {
  const Mapped script("f = Macro () {\n g()\n}\ng = Macro () { }\n");
  CHECK(script.lines_of("g()") == Lines{2, 4});
}

TEST_CASE("parameters and variables of loops hide what is around them") {
  const Mapped script("i = 1\nfor (i in range(i)) {\n i\n}\nm = Macro (i) {\n i\n}\n");
  CHECK(script.lines_of("i") == Lines{1, 2});
  CHECK(script.lines_of("i in") == Lines{2, 3});
  CHECK(script.lines_of("i) {\n i\n}") == Lines{5, 6});
}

TEST_CASE("the value of an assignment is read before the name is set") {
  const Mapped script("n = 1\nf = Macro () {\n n = n + 1\n}\n");
  CHECK(script.lines_of("n") == Lines{1, 3});
  CHECK(script.lines_of("n = n") == Lines{3});
}

TEST_CASE("built-ins and names that are never set have no places") {
  const Mapped script("x = sin(pi) + nothing\n");
  CHECK(script.lines_of("sin").empty());
  CHECK(script.lines_of("nothing").empty());
}

TEST_CASE("in an unfinished text the names around its end are visible, the nearest first") {
  const Mapped script(
      "a = 1\nm = Macro (p) {\n b = 2\n for (c in [1]) {\n d = 3\n Sphere { radius ->");
  CHECK(script.visible_at_end() == Strings{"c", "d", "p", "b", "a", "m"});
}

TEST_CASE("a body that is closed before the end hides its names") {
  CHECK(Mapped("if (true) { x = 1 }").visible_at_end().empty());
  CHECK(Mapped("if (true) { x = 1 ").visible_at_end() == Strings{"x"});
}

TEST_CASE("the parser says what it would take at the cursor") {
  const auto expects = [](const std::string& text, const char* name) {
    const Mapped script(text, PartialEnd::cursor);
    const auto& expected = script.parsed.expected;
    return std::find(expected.begin(), expected.end(), name) != expected.end();
  };
  CHECK(expects("", "Settings"));
  CHECK_FALSE(expects("Scene { ", "Settings"));
  CHECK(expects("Scene { ", "while"));
  CHECK(expects("a = Sphere { ", "a name"));
  CHECK_FALSE(expects("a = Sphere { ", "a whole number"));
  CHECK(expects("a = Sphere { radius -> ", "a whole number"));
  CHECK(expects("a = b <", "scale"));
  CHECK(expects("a = b <scale 2, ", "rotate"));
  CHECK(expects("if (true) { } ", "else"));
  CHECK_FALSE(expects("a = ", "else"));
}

TEST_CASE("statements with errors are left out of the tree, and the others stay") {
  const Mapped script("a = 1\nb = )\nc = a\nScene {\n d = a\n e = (\n");
  CHECK(script.reporter.has_errors());
  CHECK(script.lines_of("a") == Lines{1, 3, 5});
}

TEST_CASE("comments and tokens have their places") {
  SourceMap sources;
  SymbolTable symbols;
  Reporter reporter(sources, 1);
  const Source& source = sources.add("test", "a -- b\n = 1--c");
  const TokenList list = read_tokens(source, 0, symbols, reporter);
  REQUIRE(list.tokens.size() == 3);
  CHECK(list.tokens[1].span == Span{8, 9});
  CHECK(list.comments == std::vector<Span>{{2, 6}, {11, 14}});
}
