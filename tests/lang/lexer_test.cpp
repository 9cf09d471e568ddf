// These tests check the lexer alone: tokens, their places, and what it reports of text that is
// none.
#include "lang/lexer.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace {

using crt::lang::Grammar;
using crt::lang::Span;
using Kind = Grammar::symbol_kind;

struct Lexed {
  std::vector<Grammar::symbol_kind_type> kinds;
  std::vector<Span> spans;
  std::vector<std::string> errors;
};

Lexed lex(const std::string& text, int compat = 0) {
  crt::lang::SourceMap sources;
  crt::lang::SymbolTable symbols;
  crt::lang::Reporter reporter(sources, 100);
  crt::lang::Lexer lexer(sources.add("test", text), crt::lang::TextKind::script, compat, symbols,
                         reporter);
  Lexed result;
  CHECK(lexer.next().kind() == Kind::S_START_SCRIPT);
  for (;;) {
    const Grammar::symbol_type token = lexer.next();
    if (token.kind() == Kind::S_YYEOF) break;
    result.kinds.push_back(token.kind());
    result.spans.push_back(token.location);
  }
  for (const crt::Diagnostic& diagnostic : reporter.diagnostics())
    result.errors.push_back(diagnostic.message);
  return result;
}

std::vector<Grammar::symbol_kind_type> kinds(const std::string& text, int compat = 0) {
  return lex(text, compat).kinds;
}

using Kinds = std::vector<Grammar::symbol_kind_type>;

}  // namespace

TEST_CASE("in scripts of 2015 new keywords are names where they cannot be meant as keywords") {
  constexpr int compat = crt::compat_2015;
  for (const char* word : {"if", "while", "for", "else", "in", "import"}) {
    CAPTURE(word);
    const std::string name = word;
    CHECK(kinds(name, compat) == Kinds{Kind::S_IDENTIFIER});
    CHECK(kinds(name + " = 1", compat) ==
          Kinds{Kind::S_IDENTIFIER, Kind::S_ASSIGN, Kind::S_INTEGER});
    CHECK(kinds(name + "\n(", compat) == Kinds{Kind::S_IDENTIFIER, Kind::S_FIRST_PARENTHESIS});
    CHECK(kinds(name) != Kinds{Kind::S_IDENTIFIER});
  }
  CHECK(kinds("while(", compat) == Kinds{Kind::S_WHILE, Kind::S_LEFT_PARENTHESIS});
  CHECK(kinds("if (", compat) == Kinds{Kind::S_IF, Kind::S_LEFT_PARENTHESIS});
  CHECK(kinds("else {", compat) == Kinds{Kind::S_ELSE, Kind::S_LEFT_BRACE});
  CHECK(kinds("else if (", compat) == Kinds{Kind::S_ELSE, Kind::S_IF, Kind::S_LEFT_PARENTHESIS});
  CHECK(kinds("import \"a\"", compat) == Kinds{Kind::S_IMPORT, Kind::S_STRING});
  CHECK(kinds("for (in in in)", compat) == Kinds{Kind::S_FOR, Kind::S_LEFT_PARENTHESIS,
                                                 Kind::S_IDENTIFIER, Kind::S_IN, Kind::S_IDENTIFIER,
                                                 Kind::S_RIGHT_PARENTHESIS});
  // Keywords that 2015 had stay keywords.
  CHECK(kinds("true scale Macro", compat) == Kinds{Kind::S_TRUE, Kind::S_SCALE, Kind::S_MACRO});
}

TEST_CASE("signs are read as long as they go") {
  CHECK(kinds("< <= = == ! != && || -> - > >=") ==
        Kinds{Kind::S_LESS, Kind::S_LESS_EQUAL, Kind::S_ASSIGN, Kind::S_EQUAL, Kind::S_NOT,
              Kind::S_NOT_EQUAL, Kind::S_AND, Kind::S_OR, Kind::S_ARROW, Kind::S_MINUS,
              Kind::S_GREATER, Kind::S_GREATER_EQUAL});
  CHECK(kinds("a->b") == Kinds{Kind::S_IDENTIFIER, Kind::S_ARROW, Kind::S_IDENTIFIER});
}

TEST_CASE("two dashes begin a comment, whatever follows") {
  CHECK(kinds("1 --> 2\n3").size() == 2);
  CHECK(kinds("a--b").size() == 1);
  CHECK(kinds("--").empty());
  CHECK(kinds("----\n----").empty());
}

TEST_CASE("all three kinds of line ends end a comment and a line") {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    const Kinds found = kinds(std::string("a -- comment") + end + "(b");
    CHECK(found == Kinds{Kind::S_IDENTIFIER, Kind::S_FIRST_PARENTHESIS, Kind::S_IDENTIFIER});
  }
}

TEST_CASE("only a bracket that is first on its line is another token") {
  CHECK(kinds("( (") == Kinds{Kind::S_FIRST_PARENTHESIS, Kind::S_LEFT_PARENTHESIS});
  CHECK(kinds("a( [") == Kinds{Kind::S_IDENTIFIER, Kind::S_LEFT_PARENTHESIS, Kind::S_LEFT_BRACKET});
  CHECK(kinds("a\n \t [") == Kinds{Kind::S_IDENTIFIER, Kind::S_FIRST_BRACKET});
  CHECK(kinds("3\n(")[1] == Kind::S_FIRST_PARENTHESIS);
  CHECK(kinds("\"s\" [")[1] == Kind::S_LEFT_BRACKET);
  CHECK(kinds("1.5 [")[1] == Kind::S_LEFT_BRACKET);
}

TEST_CASE("a '<' before scale, translate or rotate begins modifiers") {
  for (const char* word : {"scale", "translate", "rotate"}) {
    CHECK(kinds(std::string("<") + word)[0] == Kind::S_MODIFIER_START);
    CHECK(kinds(std::string("< -- comment\n\t") + word)[0] == Kind::S_MODIFIER_START);
    CHECK(kinds(std::string("<") + word + "d")[0] == Kind::S_LESS);
    CHECK(kinds(std::string("<") + word + "_2")[0] == Kind::S_LESS);
    CHECK(kinds(std::string("<=") + word)[0] == Kind::S_LESS_EQUAL);
  }
  CHECK(kinds("<")[0] == Kind::S_LESS);
}

TEST_CASE("a '<' before material, id and others begins modifiers if a value follows there") {
  const auto first = [](const std::string& text) { return kinds(text)[0]; };
  for (const std::string word : {"material", "id", "matrix", "shadow", "visible"}) {
    CAPTURE(word);
    for (const char* value : {" m", " 3", " .5", " [1]", " (m)", " \"s\"", " Material", " true"})
      CHECK(first("<" + word + value) == Kind::S_MODIFIER_START);
    for (const char* rest : {"", ")", "(m)", "[1]", " + 1", " - 1", " -1", "\nm", " && a", " == b",
                             " ? 1", " -- m", " }", " ]", ", 1", "2 m", " .a", " = 3", " > 3"})
      CHECK(first("<" + word + rest) == Kind::S_LESS);
    // Such a word is a name wherever it begins no modifier.
    CHECK(kinds(word + " = 1")[0] == Kind::S_IDENTIFIER);
    CHECK(kinds(word + " -> m")[0] == Kind::S_IDENTIFIER);
    CHECK(kinds("(a, " + word + " 3)")[3] == Kind::S_IDENTIFIER);
    CHECK(kinds("<scale f(2, " + word + ")>")[6] == Kind::S_IDENTIFIER);
    CHECK(kinds("<scale 2> , " + word)[5] == Kind::S_IDENTIFIER);
    CHECK(kinds("<scale 2, " + word + " [1]>")[4] != Kind::S_IDENTIFIER);
    // Scripts of 2015 do not know these modifiers.
    CHECK(kinds("<" + word + " m", crt::compat_2015)[0] == Kind::S_LESS);
  }
}

TEST_CASE("return is a keyword where a statement can begin and a value follows on the line") {
  const auto second = [](const std::string& text, int compat = 0) {
    return kinds(text, compat).at(1);
  };
  for (const char* value : {" x", " 3", " \"s\"", " (a)", " [1]", " -x", " +1", " !a", " .5"})
    CHECK(second("{ return" + std::string(value)) == Kind::S_RETURN);
  for (const char* rest :
       {" = 3", "(a)", "[1]", " - x", " + 1", " != a", "\n3", " }", " -> 3", ", a", ".x"})
    CHECK(second("{ return" + std::string(rest)) == Kind::S_IDENTIFIER);
  CHECK(second("= return x") == Kind::S_IDENTIFIER);
  CHECK(second("x return 3") == Kind::S_RETURN);
  CHECK(second("{ return 3", crt::compat_2015) == Kind::S_IDENTIFIER);
}

TEST_CASE("elif is a keyword between a brace and a parenthesis") {
  CHECK(kinds("} elif (a)")[1] == Kind::S_ELIF);
  CHECK(kinds("}\nelif(a)")[1] == Kind::S_ELIF);
  CHECK(kinds("} elif = a")[1] == Kind::S_IDENTIFIER);
  CHECK(kinds("x elif (a)")[1] == Kind::S_IDENTIFIER);
  CHECK(kinds("} elif (a)", crt::compat_2015)[1] == Kind::S_IDENTIFIER);
}

TEST_CASE("two plus signs are two signs unless they can only be an increment") {
  CHECK(kinds("a ++b") ==
        Kinds{Kind::S_IDENTIFIER, Kind::S_PLUS, Kind::S_PLUS, Kind::S_IDENTIFIER});
  CHECK(kinds("a++b").size() == 4);
  CHECK(kinds("a ++\nb").size() == 4);
  CHECK(lex("a+++b").errors.empty());
  for (const char* end : {"", "\nb", ")", " }", " -- c"})
    CHECK(lex("i++" + std::string(end)).errors ==
          std::vector<std::string>{"there is no '++'; write 'i += 1'"});
}

TEST_CASE("a comment of another language is one error, and what follows it is read") {
  CHECK(kinds("1 // 2 ( \n3") == Kinds{Kind::S_INTEGER, Kind::S_INTEGER});
  CHECK(kinds("1 /* 2 \n ( */ (3").size() == 3);
  CHECK(kinds("1 /* 2 \n ( */ (3")[1] == Kind::S_FIRST_PARENTHESIS);
  CHECK(lex("1 /* 2 \n 3").errors.size() == 1);
  CHECK(kinds("1 /* 2 \n 3").size() == 2);
  CHECK(lex("1 # don't\n").errors.size() == 1);
}

TEST_CASE("before an arrow every keyword is the name of an attribute") {
  for (const char* word : {"Settings", "Scene", "Macro", "scale", "translate", "rotate", "true",
                           "false", "while", "if", "else", "for", "in", "import"}) {
    CHECK(kinds(std::string(word) + "->")[0] == Kind::S_IDENTIFIER);
    CHECK(kinds(std::string(word) + " -- comment\n ->")[0] == Kind::S_IDENTIFIER);
    CHECK(kinds(word)[0] != Kind::S_IDENTIFIER);
    CHECK(kinds(std::string(word) + " - >")[0] != Kind::S_IDENTIFIER);
  }
}

TEST_CASE("names of objects begin with a capital") {
  CHECK(kinds("Sphere sphere sceneX Scenery") ==
        Kinds{Kind::S_OBJECT_NAME, Kind::S_IDENTIFIER, Kind::S_IDENTIFIER, Kind::S_OBJECT_NAME});
}

TEST_CASE("numbers are Integers or Floats by how they are written") {
  CHECK(kinds("0 7 1. .5 1.5 1e3 1.e-3 .5E+2 007") ==
        Kinds{Kind::S_INTEGER, Kind::S_INTEGER, Kind::S_FLOAT, Kind::S_FLOAT, Kind::S_FLOAT,
              Kind::S_FLOAT, Kind::S_FLOAT, Kind::S_FLOAT, Kind::S_INTEGER});
  CHECK(kinds("1.2.3").size() == 2);
  CHECK(lex("9223372036854775807").errors.empty());
  CHECK(lex("9223372036854775808").errors.size() == 1);
  CHECK(lex("1e308").errors.empty());
  CHECK(lex("1e309").errors.size() == 1);
  CHECK(lex("1e").errors.size() == 1);
}

TEST_CASE("spans are bytes of the text") {
  const Lexed result = lex("ab = \"é\"\n>=");
  REQUIRE(result.spans.size() == 4);
  CHECK(result.spans[0] == Span{0, 2});
  CHECK(result.spans[1] == Span{3, 4});
  CHECK(result.spans[2] == Span{5, 9});
  CHECK(result.spans[3] == Span{10, 12});
}

TEST_CASE("bytes that are no token are reported and skipped") {
  CHECK(lex("a ; b").kinds.size() == 2);
  CHECK(lex("a ; b").errors.size() == 1);
  CHECK(lex("a \xff b").kinds.size() == 2);
  CHECK(lex("a \xff b").errors ==
        std::vector<std::string>{"this byte is not UTF-8, the encoding of scripts"});
  CHECK(lex(std::string("a \0 b", 5)).errors ==
        std::vector<std::string>{"unexpected character U+0000"});
  CHECK(lex(std::string("a \0 b", 5)).kinds.size() == 2);
}

TEST_CASE("what is no UTF-8 is reported in strings, but not in comments") {
  // These are a lone continuation, an overlong slash, a surrogate, a number beyond U+10FFFF, and a
  // character cut short.
  for (const char* wrong : {"\x80", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe2\x82"}) {
    CHECK_FALSE(lex(std::string("\"") + wrong + "\"").errors.empty());
    CHECK(lex(std::string("-- ") + wrong + "\n").errors.empty());
  }
  CHECK(lex("\"\xf4\x8f\xbf\xbf\xe2\x82\xac\"").errors.empty());
}

TEST_CASE("strings end on their line") {
  CHECK(lex("\"abc").errors.size() == 1);
  CHECK(lex("\"abc\ndef\"").errors.size() == 2);
  CHECK(lex("\"abc\\").errors.size() == 1);
  CHECK(lex("\"\\").errors.size() == 1);
  CHECK(lex("\"\\u12\"").errors.size() == 1);
  CHECK(lex("\"\\ud83d\\u0041\"").errors.size() == 1);
}
