// The formatter changes how a script looks, and never what it means.
#include "format/format.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "lang/parser.hpp"
#include "lang/partial_parse.hpp"

namespace {

namespace fs = std::filesystem;

std::string formatted(const std::string& text) {
  const crt::format::Formatted result = crt::format::format_script(text, "test.crt");
  REQUIRE(result.text.has_value());
  return *result.text;
}

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<fs::path> scripts_in(const fs::path& folder) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(fs::path(CRT_SOURCE_DIR) / folder)) {
    if (entry.path().extension() == ".crt") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// A Shape is a tree without its layout: the texts of all tokens and comments, and of each
/// expression what it is and which tokens it has.
struct Shape {
  std::vector<std::string> tokens;
  std::vector<std::string> comments;
  std::vector<std::tuple<std::size_t, std::ptrdiff_t, std::ptrdiff_t>> expressions;

  friend bool operator==(const Shape&, const Shape&) = default;
};

std::string trimmed(std::string_view text) {
  return std::string(text.substr(0, text.find_last_not_of(" \t\r\n") + 1));
}

Shape shape_of(const std::string& text) {
  crt::lang::SourceMap sources;
  crt::lang::SymbolTable symbols;
  crt::lang::Reporter reporter(sources, 1);
  std::size_t memory = std::numeric_limits<std::size_t>::max();
  const crt::lang::Source& source = sources.add("test", text);
  const crt::lang::Script script =
      crt::lang::parse(source, crt::lang::TextKind::script, 0, symbols, reporter, memory);
  const auto [tokens, comments, open] = crt::lang::read_tokens(source, 0, symbols, reporter);
  const auto text_of = [&](crt::lang::Span span) {
    return trimmed(std::string_view(text).substr(span.begin, span.end - span.begin));
  };
  Shape shape;
  for (const crt::lang::Token& token : tokens) shape.tokens.push_back(text_of(token.span));
  for (const crt::lang::Span& comment : comments) shape.comments.push_back(text_of(comment));
  const auto first_at = [&, &list = tokens](std::uint32_t offset) {
    return std::lower_bound(list.begin(), list.end(), offset,
                            [](const crt::lang::Token& token, std::uint32_t o) {
                              return token.span.begin < o;
                            }) -
           list.begin();
  };
  for (const crt::lang::Expression& expression : script.expressions)
    shape.expressions.emplace_back(expression.node.index(), first_at(expression.span.begin),
                                   first_at(expression.span.end));
  return shape;
}

/// Takes the indentation away where that moves no comment, and doubles the blank lines.
std::string disordered(const std::string& text) {
  std::string result;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line = std::string_view(text).substr(begin, end - begin);
    const std::size_t code = std::min(line.find_first_not_of(' '), line.size());
    const std::size_t comment = line.find("--", code);
    if (comment == std::string_view::npos || comment == code) line.remove_prefix(code);
    result += line;
    result += line.empty() ? "\n\n\n" : "  \n";
    begin = end + 1;
  }
  return result;
}

}  // namespace

TEST_CASE("formatting leaves the tree and the comments of every example as they are") {
  const std::vector<fs::path> paths = scripts_in("examples/scenes");
  REQUIRE(paths.size() > 20);
  for (const fs::path& path : paths) {
    CAPTURE(path.string());
    const std::string text = read(path);
    const std::string once = formatted(text);
    CHECK(shape_of(once) == shape_of(text));
    CHECK(formatted(once) == once);
  }
}

TEST_CASE(
    "formatting a good script of the corpus keeps its tree, and twice gives what once gives") {
  const std::vector<fs::path> paths = scripts_in("tests/lang/corpus/good");
  REQUIRE(paths.size() > 5);
  for (const fs::path& path : paths) {
    CAPTURE(path.string());
    const auto once = crt::format::format_script(read(path), "test.crt");
    REQUIRE(once.text.has_value());
    CHECK(shape_of(*once.text) == shape_of(read(path)));
    CHECK(formatted(*once.text) == *once.text);
  }
}

TEST_CASE("lost indentation and superfluous blanks are restored") {
  for (const fs::path& path : scripts_in("examples/scenes")) {
    CAPTURE(path.string());
    const std::string text = read(path);
    const std::string broken = disordered(text);
    CHECK(broken != text);
    CHECK(formatted(broken) == formatted(text));
  }
}

TEST_CASE("blanks between tokens are one or none, as the tokens want it") {
  CHECK(formatted("a=1+2*-3") == "a = 1 + 2 * -3\n");
  CHECK(formatted("b = f( a ,b )[ 0 ]") == "b = f(a, b)[0]\n");
  CHECK(formatted("c=- -a") == "c = - -a\n");
  CHECK(formatted("d=a<b?[1,2]:! c") == "d = a < b ? [1, 2] : !c\n");
  CHECK(formatted("e=a<scale 2,rotate v>-b<translate(v)>") ==
        "e = a <scale 2, rotate v> - b <translate (v)>\n");
  CHECK(formatted("m=Macro(a,b){}") == "m = Macro (a, b) { }\n");
  CHECK(formatted("x = g <scale [1>2][0]>") == "x = g <scale [1 > 2][0]>\n");
}

TEST_CASE("slices, parts, dictionaries and values in strings have their blanks") {
  CHECK(formatted("a=[i*2 for i in range( 9 )if i%2==0]") ==
        "a = [i * 2 for i in range(9) if i % 2 == 0]\n");
  CHECK(formatted("b=a[ 1 : ]+a[:-2]+a[i+1 : j]+a[ : ]") ==
        "b = a[1:] + a[:-2] + a[i + 1:j] + a[:]\n");
  CHECK(formatted("c=a?b[x?1:2 : 3]:v.x") == "c = a ? b[x ? 1 : 2:3] : v.x\n");
  CHECK(formatted("d={a->1,\"b c\"->{}}") == "d = { a -> 1, \"b c\" -> { } }\n");
  CHECK(formatted("[a,b]=[b ,a]") == "[a, b] = [b, a]\n");
  CHECK(formatted("e=\"x \\{ a+1 } y \\{\"z\"}\"+f( 1,b->2 )") ==
        "e = \"x \\{a + 1} y \\{\"z\"}\" + f(1, b -> 2)\n");
  CHECK(formatted("m=Macro(a,b->-1){break}") == "m = Macro (a, b -> -1) { break }\n");
  CHECK(formatted("import\"x\"as y\nfor(a,b in c){continue}") ==
        "import \"x\" as y\nfor (a, b in c) { continue }\n");
  CHECK(formatted(
            "a = [\nball <translate v>\nfor v in list\nif v.x > 0\n]\nd = {\na -> 1\nb -> 2\n}") ==
        "a = [\n    ball <translate v>\n    for v in list\n    if v.x > 0\n]\nd = {\n    a -> 1\n"
        "    b -> 2\n}\n");
}

TEST_CASE("a line that continues an expression is indented once more") {
  CHECK(formatted("a = b\n- c\n^ Sphere {\nradius -> 1\n}\nd = 1") ==
        "a = b\n    - c\n    ^ Sphere {\n        radius -> 1\n    }\nd = 1\n");
  CHECK(formatted("a =\n1") == "a =\n    1\n");
  CHECK(formatted("Scene {\na\n<scale 2>\n(b)\n}") ==
        "Scene {\n    a\n        <scale 2>\n    (b)\n}\n");
}

TEST_CASE("brackets that open on one line indent once") {
  CHECK(formatted("f([\n1,\n2\n])\n") == "f([\n    1,\n    2\n])\n");
}

TEST_CASE("comments keep their text, their line and their column") {
  CHECK(formatted("  -- one  \n\n\n\n--two\nx = 1    -- three\n") ==
        "-- one\n\n--two\nx = 1    -- three\n");
  CHECK(formatted("x=1 -- a\nlonger=2 -- b\n") == "x = 1       -- a\nlonger = 2  -- b\n");
  CHECK(formatted("f(a, -- first\n  b)\n") == "f(a,  -- first\n    b)\n");
  CHECK(formatted("if (a) {\n-- last\n}\n") == "if (a) {\n    -- last\n}\n");
}

TEST_CASE("two hundred thousand comments in a row take no longer than as many lines of code") {
  std::string text = "if (a) {\n";
  std::string expected = text;
  for (int i = 0; i < 200'000; ++i) {
    text += "--\n";
    expected += "    --\n";
  }
  CHECK(formatted(text + "}\n") == expected + "}\n");
}

TEST_CASE("line ends stay what they are, and the last line has one") {
  CHECK(formatted("a=1\r\nb=2") == "a = 1\r\nb = 2\r\n");
  CHECK(formatted("").empty());
  CHECK(formatted("\n\n").empty());
}

TEST_CASE("a script with a syntax error is not formatted, and the error is reported") {
  const auto result = crt::format::format_script("a = (1\n", "test.crt");
  CHECK_FALSE(result.text.has_value());
  REQUIRE(result.diagnostics.size() == 1);
  CHECK(result.diagnostics[0].place.line == 1);
}

TEST_CASE("a script of 2015 may have names that are keywords today") {
  const std::string text = "Settings { compat -> 2015 }\nif=1\n";
  CHECK(formatted(text) == "Settings { compat -> 2015 }\nif = 1\n");
}
