// No script hangs or exhausts its host. Every limit ends in an ordinary error that says where.
#include <doctest/doctest.h>

#include <string>

#include "run.hpp"
#include "support/small_stack.hpp"

namespace {

using crt::ErrorCode;
using crt::ScriptLimits;
using crt::ScriptOptions;
using crt::test::on_small_stack;
using crt::test::run;
using crt::test::run_statements;

const std::string ball = "ball = Sphere { center -> vec3(0, 0, 0) radius -> 1 }\n";

ScriptOptions with(ScriptLimits limits) {
  ScriptOptions options;
  options.limits = limits;
  return options;
}

/// Says whether the script ends in one error of a limit whose message holds `words`.
bool ends_in_limit(const std::string& text, const ScriptOptions& options,
                   const std::string& words) {
  const crt::test::Run result = run_statements(text, options);
  if (!result.failed_with(ErrorCode::limit)) return false;
  INFO(result.errors()[0].message);
  const bool found = result.errors()[0].message.find(words) != std::string::npos;
  CHECK(found);
  return found;
}

std::string repeated(const std::string& piece, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += piece;
  return text;
}

}  // namespace

TEST_CASE("listing 2.1's own loop, which counts the wrong way, ends in an error that names it") {
  const std::string listing = R"(sphere1 = Sphere {
    center -> vec3(0, 0.5, 0)
    radius -> 0.5
}
n = 18
max = (3 * n) / 4 + 5
myMacro = Macro (arg1) {
    i = 0
    while (i < max) {
        sphere1 <translate vec3(i*1.0, 0.0, 0.0)>
        i = i - 1
    }
}
Scene { myMacro(1) }
)";
  const crt::test::Run result = run(listing);
  REQUIRE(result.failed_with(ErrorCode::limit));
  const crt::Diagnostic& error = result.result.diagnostics[0];
  CHECK(error.message.find("in the loop 'while' at test.crt:9:5") != std::string::npos);
  REQUIRE(error.calls.size() == 1);
  CHECK(error.calls[0].first == "myMacro");
  CHECK(error.calls[0].second.line == 14);
}

TEST_CASE("an endless loop is the one that goes round most, not what runs within it") {
  const ScriptOptions options = with({.steps = 10'000});
  CHECK(ends_in_limit("i = 0\nwhile (true) { for (j in range(3)) { i = i + j } }", options,
                      "'while' at test.crt:2:1"));
  CHECK(ends_in_limit("for (i in range(5)) { while (true) { i } }", options,
                      "'while' at test.crt:1:23"));
  CHECK(ends_in_limit("f = Macro () { while (true) { g() } }\ng = Macro () { 1 + 1 }\nf()", options,
                      "'while' at test.crt:1:16"));
}

TEST_CASE("steps are counted to the one") {
  // There are four expressions: the assignment's sum and its operands, and the assignment itself.
  const std::string text = "x = 1 + 2";
  CHECK(run_statements(text, with({.steps = 4})).ok());
  CHECK(ends_in_limit(text, with({.steps = 3}), "more than 3 steps"));
}

TEST_CASE("work within a step is paid for in steps") {
  const ScriptOptions options = with({.steps = 100'000});
  CHECK(ends_in_limit("s = \"x\" * 1000000\nwhile (true) { t2 = s + \"y\" }", options, "steps"));
  CHECK(ends_in_limit("l = range(100000)\nwhile (true) { m = l + l }", options, "steps"));
  CHECK(ends_in_limit("l = range(100000)\nwhile (true) { l == l }", options, "steps"));
  CHECK(ends_in_limit("l = range(1000)\nwhile (true) { x = str(l) }", options, "steps"));
  CHECK(ends_in_limit("s = \"x\" * 1000000\nwhile (true) { len(s) }", options, "steps"));
  CHECK(ends_in_limit("l = range(100000)\nfor (i in l) { }", with({.steps = 50'000}), "'for'"));
}

TEST_CASE("comprehensions, slices and what calls macros are paid for in steps") {
  const ScriptOptions options = with({.steps = 100'000});
  const std::string list = "l = range(10000)\n";
  CHECK(ends_in_limit("x = [i for i in range(1000) for j in range(1000)]", options,
                      "'for' at test.crt:1:29"));
  CHECK(ends_in_limit("x = [i for i in range(1000000) if false]", options, "'for'"));
  CHECK(ends_in_limit(list + "while (true) { m = l[1:] }", options, "steps"));
  CHECK(ends_in_limit("s = \"x\" * 1000000\nwhile (true) { t2 = s[0:1] }", options, "steps"));
  CHECK(ends_in_limit(list + "while (true) { m = map(l, sqrt) }", options, "'map'"));
  CHECK(ends_in_limit("x = filter(range(1000000), Macro (i) { return false })", options,
                      "'filter' at test.crt:1:5"));
  CHECK(ends_in_limit("x = sort(range(1000000), Macro (i) { return -i })", options, "'sort'"));
  CHECK(ends_in_limit(list + "while (true) { x = sort(l) }", options, "steps"));
  CHECK(ends_in_limit("l = [\"x\" * 100000, \"x\" * 100000]\nwhile (true) { x = sort(l) }", options,
                      "steps"));
  CHECK(ends_in_limit(list + "while (true) { x = zip(l, l) }", options, "'zip'"));
  CHECK(ends_in_limit(list + "while (true) { x = sum(l) }", options, "steps"));
  CHECK(ends_in_limit("l = [\"x\" for i in range(10000)]\nx = sum(l + l)", options, "steps"));
  CHECK(ends_in_limit("s = \"x\" * 1000000\nwhile (true) { x = has({}, s) }", options, "steps"));
  CHECK(ends_in_limit("s = \"x\" * 1000000\nwhile (true) { x = \"\\{s}\" }", options, "steps"));
  CHECK(ends_in_limit("d = { a -> 1 }\nwhile (true) { x = d + d }", options, "'while'"));
  // Dictionaries that share their parts are as large as a tree of them.
  const std::string tree = "d = { a -> 1 }\nfor (i in range(60)) { d = { a -> d, b -> d } }\n";
  CHECK(ends_in_limit(tree + "e = { a -> d.a, b -> d.b }\nx = d == e", options, "steps"));
  CHECK(ends_in_limit(tree + "print(d)", {}, "a string of more than"));
}

TEST_CASE("finding the parameters that arguments name is paid for in steps") {
  std::string parameters = "a0";
  std::string arguments = "a0 -> 0";
  for (int i = 1; i < 5000; ++i) {
    parameters += ", a" + std::to_string(i);
    arguments += ", a" + std::to_string(i) + " -> 0";
  }
  const std::string macro = "f = Macro (" + parameters + ") { return a7 }\n";
  CHECK(ends_in_limit(macro + "x = f(" + arguments + ")", with({.steps = 100'000}), "steps"));
}

TEST_CASE("macros call one another to a depth") {
  const std::string recursion = "f = Macro (n) { if (n > 0) { f(n - 1) } }\n";
  CHECK(run_statements(recursion + "f(99)", with({.call_depth = 100})).ok());
  CHECK(ends_in_limit(recursion + "f(100)", with({.call_depth = 100}),
                      "more than 100 deep, in the call 'f'"));
  CHECK(run_statements(recursion + "f(255)").ok());
  CHECK(ends_in_limit(recursion + "f(256)", {}, "more than 256 deep"));
  CHECK(ends_in_limit("f = Macro () { g() }\ng = Macro () { x = f() }\nf()", {},
                      "more than 256 deep"));
}

TEST_CASE("at all limits a script needs no more than about a megabyte of stack") {
  // The stack is half as large again, for what calls run_script() and for the standard library.
  constexpr std::size_t stack_bytes = 3 << 19;
  const std::string brackets = repeated("[", 90);
  const std::string closed = repeated("]", 90);
  const std::string deep_call =
      "f = Macro (n) { x = " + brackets + "f(n + 1)" + closed + " }\nf(0)";
  const std::string deep_blocks = "f = Macro (n) { " + repeated("if (true) { ", 90) + "f(n + 1)" +
                                  repeated("}", 90) + " }\nf(0)";
  const std::string deep_text = "l = []\nfor (i in range(98)) { l = [l] }\nprint(l, l == l)";
  const std::string deep_expression = "x = " + repeated("- ", 190) + "1";
  on_small_stack(stack_bytes, [&] {
    CHECK(run_statements(deep_call, with({.call_depth = 1000})).failed_with(ErrorCode::limit));
    CHECK(run_statements(deep_blocks, with({.call_depth = 1000})).failed_with(ErrorCode::limit));
    CHECK(run_statements("f = Macro (n) { f(n + 1) }\nf(0)", with({.call_depth = 1'000'000}))
              .failed_with(ErrorCode::limit));
    CHECK(run_statements(deep_text).ok());
    CHECK(run_statements(deep_expression).ok());
  });
}

TEST_CASE("a thread with 256 kB of stack runs scripts, and ends those that nest too deeply") {
  constexpr std::size_t stack_bytes = 256 << 10;
  const std::string nested_calls = "f = Macro (n) { max(0, min(1, abs(f(n + 1)))) + 1 }\nf(0)";
  const std::string in_objects =
      "f = Macro (n) { Sphere { center -> vec3(0, 0, f(n + 1)) radius -> 1 } }\nf(0)";
  const std::string in_modifiers = ball +
                                   "f = Macro (n) { ball <translate vec3(0, 0, f(n + 1))> }\n"
                                   "x = f(0)";
  const std::string in_loops =
      "f = Macro (n) { for (i in [1]) { while (true) { if (true) { x = [f(n + 1)] } } } }\nf(0)";
  const std::string in_comprehensions =
      "f = Macro (n) { return [f(n + 1) for i in [1] if true] }\n"
      "x = f(0)";
  const std::string in_builtins = "f = Macro (n) { return sort(map([n + 1], f), f) }\nx = f(0)";
  const std::string in_defaults = "f = Macro (n, m -> f(n + 1)) { return \"\\{m}\" }\nx = f(0)";
  const std::string in_parts = "f = Macro (n) { [a, b] = { c -> f(n + 1) }.c[0:1] }\nx = f(0)";
  const std::string in_brackets =
      "f = Macro (n) { x = " + repeated("[", 90) + "f(n + 1)" + repeated("]", 90) + " }\nf(0)";
  on_small_stack(stack_bytes, [&] {
    for (const std::string& endless :
         {nested_calls, in_objects, in_modifiers, in_loops, in_comprehensions, in_builtins,
          in_defaults, in_parts, in_brackets}) {
      CAPTURE(endless);
      CHECK(run_statements(endless, with({.call_depth = 1000})).failed_with(ErrorCode::limit));
    }
    CHECK(run_statements("f = Macro (n) { if (n > 0) { f(n - 1) } }\nf(30)").ok());
    CHECK(run_statements("x = " + repeated("- ", 190) + "1").ok());
    CHECK(run_statements("x = " + repeated("(", 190) + "1" + repeated(")", 190)).ok());
    CHECK(run_statements("x = " + repeated("[", 95) + "1" + repeated("]", 95) +
                         "\nprint(x, x == x)\ny = str(x)")
              .ok());
    CHECK(run_statements("x = " + repeated("{ a -> ", 95) + "1" + repeated("}", 95) +
                         "\nprint(x, x == x)\ny = \"\\{x}\"")
              .ok());
    CHECK(run_statements("x = " + repeated("\"\\{", 95) + "1" + repeated("}\"", 95)).ok());
    CHECK_FALSE(run_statements("x = " + repeated("\"\\{", 300) + "1" + repeated("}\"", 300)).ok());
    CHECK(run_statements("x = [1" + repeated(" for i in [1]", 190) + "]").ok());
    CHECK(run_statements(repeated("if (true) { ", 190) + "x = 1" + repeated("}", 190)).ok());
    CHECK_FALSE(run_statements("x = " + repeated("(", 300) + "1" + repeated(")", 300)).ok());
    CHECK_FALSE(run_statements("x = " + repeated("(", 190) + "y" + repeated(")", 190)).ok());
  });
}

TEST_CASE("a list that is made item by item takes steps in proportion to its length") {
  const ScriptOptions options = with({.steps = 3'000'000});
  const std::string loop = "p = []\nfor (i in range(100000)) { ";
  CHECK(run_statements(loop + "p = p + [[i, i]] }\nprint(len(p), p[99999])", options).printed ==
        std::vector<std::string>{"100000 [99999, 99999]"});
  CHECK(run_statements(loop + "p += [[i, i]] }\nprint(len(p))", options).printed ==
        std::vector<std::string>{"100000"});
  // What shares the list, or is made in another way, is paid for.
  CHECK(ends_in_limit(loop + "q = p\n p = p + [[i, i]] }", options, "steps"));
  CHECK(ends_in_limit(loop + "p = [[i, i]] + p }", options, "steps"));
}

TEST_CASE("a list that grows in place changes no other") {
  const auto prints = [](const std::string& text) { return run_statements(text).printed; };
  using Lines = std::vector<std::string>;
  CHECK(prints("p = [1]\nq = p\np = p + [2]\nprint(p, q)") == Lines{"[1, 2] [1]"});
  CHECK(prints("p = [1]\np = p + p\np = p + p\nprint(p)") == Lines{"[1, 1, 1, 1]"});
  CHECK(prints("p = [1]\np = p + [p]\nprint(p)") == Lines{"[1, [1]]"});
  CHECK(prints("p = [1]\nfor (x in p) { p = p + [x, 2] }\nprint(p)") == Lines{"[1, 1, 2]"});
  CHECK(prints("p = [1]\nm = Macro () { p = p + [2]\n p }\nx = m()\nprint(p, x)").empty());
  CHECK(prints("p = [1]\nm = Macro () { p = p + [2]\n return p }\nx = m()\nprint(p, x)") ==
        Lines{"[1] [1, 2]"});
  CHECK(prints("p = [1]\nq = (p = p + [2])\np = p + [3]\nprint(p, q)") ==
        Lines{"[1, 2, 3] [1, 2]"});
  CHECK(prints("p = [1]\np = p + (p = p + [2])\nprint(p)") == Lines{"[1, 1, 2]"});
  CHECK(prints("p = [[1]]\nq = p[0]\np = p + [q]\nq = q + [2]\nprint(p, q)") ==
        Lines{"[[1], [1]] [1, 2]"});
  CHECK_FALSE(run_statements("p = [1]\np = p + 1").ok());
  CHECK(ends_in_limit("p = [1]\np = p + [2, 3]", with({.list_length = 2}), "more than 2 items"));
  CHECK(ends_in_limit("p = []\nwhile (true) { p = p + [\"x\" * 1000] }",
                      with({.memory_bytes = 1'000'000}), "need more than 1000000 bytes"));
}

TEST_CASE("long chains are worked off and freed without deep recursion") {
  constexpr int many = 100'000;
  constexpr std::size_t stack_bytes = 1 << 20;
  std::string sum = "x = 1";
  std::string both = "x = true";
  std::string solid = ball + "x = ball";
  for (int i = 0; i < many; ++i) {
    sum += " + 1";
    both += " && true";
    solid += " + ball";
  }
  on_small_stack(stack_bytes, [&] {
    CHECK(run_statements(sum + "\nprint(x)").printed == std::vector<std::string>{"100001"});
    CHECK(run_statements(both).ok());
    CHECK(run_statements(solid).ok());
    // These chains are made while it runs: macros that hold the scope of the last, entities of
    // entities.
    CHECK(run_statements("m = 0\nfor (i in range(100000)) { last = m\n m = Macro () { last } }")
              .ok());
    CHECK(run_statements("m = {}\nfor (i in range(100000)) { last = m\n"
                         "m = { a -> Macro () { return last } } }")
              .ok());
    CHECK(run_statements(ball + "sum = ball\nfor (i in range(100000)) { sum = sum + ball }").ok());
    CHECK(run_statements(ball + "sum = ball\nfor (i in range(100000)) { sum = sum - ball }").ok());
    CHECK(run_statements(ball +
                         "for (i in range(100000)) { ball = ball <translate vec3(0, 0.5, 0)> }")
              .ok());
  });
}

TEST_CASE("strings and lists have a greatest size") {
  CHECK(run_statements("x = \"ab\" * 50", with({.string_bytes = 100})).ok());
  CHECK(ends_in_limit("x = \"ab\" * 51", with({.string_bytes = 100}),
                      "a string of more than 100 bytes"));
  CHECK(ends_in_limit("x = \"abc\" * 9223372036854775807", {}, "a string of more than"));
  CHECK(ends_in_limit("s = \"x\"\nwhile (true) { s = s + s }", {}, "in the loop 'while'"));
  CHECK(run_statements("x = range(10)", with({.list_length = 10})).ok());
  CHECK(ends_in_limit("x = range(11)", with({.list_length = 10}), "a list of more than 10 items"));
  CHECK(ends_in_limit("x = [1, 2, 3]", with({.list_length = 2}), "a list of more than 2 items"));
  CHECK(ends_in_limit("x = [1] + [2, 3]", with({.list_length = 2}), "a list of more than 2 items"));
  CHECK(ends_in_limit("x = range(-9223372036854775807, 9223372036854775807)", {},
                      "a list of more than"));
  CHECK(ends_in_limit("x = range(0, 1, 1e-300)", {}, "a list of more than"));
  CHECK(ends_in_limit("s = \"x\"\nwhile (true) { s = \"\\{s}\\{s}\" }", {}, "in the loop 'while'"));
  CHECK(run_statements("x = [1 for i in range(10)]", with({.list_length = 10})).ok());
  CHECK(ends_in_limit("x = [1 for i in range(4) for j in range(4)]", with({.list_length = 10}),
                      "a list of more than 10 items"));
  CHECK(ends_in_limit("d = {}\nwhile (true) { d = { a -> d } }", {}, "nested more than 100 deep"));
  CHECK(
      ends_in_limit("d = {}\nwhile (true) { d = [{ a -> d }] }", {}, "nested more than 100 deep"));
}

TEST_CASE("strings and lists share a memory, and give it back") {
  const ScriptOptions options = with({.memory_bytes = 1'000'000});
  CHECK(ends_in_limit("l = []\nwhile (true) { l = l + [\"x\" * 1000] }", options,
                      "need more than 1000000 bytes"));
  CHECK(ends_in_limit("x = [\"x\" * 1000 for i in range(10000)]", options,
                      "need more than 1000000 bytes"));
  CHECK(ends_in_limit("l = []\nwhile (true) { l = l + [{ a -> 1, b -> 2 }] }", options,
                      "need more than 1000000 bytes"));
  CHECK(run_statements("for (i in range(5000)) { d = { a -> [i for j in range(9)] } }", options)
            .ok());
  CHECK(run_statements("for (i in range(5000)) { s = \"x\" * 10000 }", options).ok());
  CHECK(run_statements("for (i in range(1000)) { l = range(1000) }", options).ok());
  CHECK(ends_in_limit("for (i in range(100000)) { m = Macro () { } }", options,
                      "need more than 1000000 bytes"));
  CHECK(ends_in_limit("", with({.memory_bytes = 50}), "too long for the memory"));
}

TEST_CASE("entities are counted when they are made and when they are emitted") {
  CHECK(ends_in_limit(ball + "for (i in range(100)) { ball <scale 2> }", with({.entities = 50}),
                      "makes more than 50 entities, in the loop 'for'"));
  const std::string eight = ball + "for (i in range(3)) { ball = ball + ball }\n";
  CHECK(ends_in_limit(eight, with({.entities = 7}), "an entity of more than 7 primitives"));
  CHECK(run(eight + "Scene { ball ball }", with({.entities = 16})).ok());
  CHECK(run(eight + "Scene { ball ball }", with({.entities = 15})).failed_with(ErrorCode::limit));
  CHECK(ends_in_limit(ball + "while (true) { ball = ball + ball }", {}, "in the loop 'while'"));
  CHECK(ends_in_limit(ball + "f = Macro (b) { b b }\nwhile (true) { ball = f(ball) }", {},
                      "in the loop 'while'"));
}

TEST_CASE("what is printed is bounded, too") {
  CHECK(ends_in_limit("while (true) { print(\"0123456789\") }", with({.string_bytes = 1000}),
                      "prints more than 1000 bytes"));
}

TEST_CASE("a script and its imports have a greatest size together") {
  ScriptOptions options = with({.source_bytes = 100});
  CHECK(run("Scene { }" + std::string(91, ' '), options).ok());
  CHECK(run("Scene { }" + std::string(92, ' '), options).failed_with(ErrorCode::limit));
  options.open_file = [](const std::filesystem::path&) {
    return std::vector<std::byte>(60, std::byte{' '});
  };
  CHECK(run_statements("import \"a\"", options).ok());
  CHECK(run_statements("import \"a\"\nimport \"b\"", options).failed_with(ErrorCode::limit));
}

TEST_CASE("errors and warnings are reported up to a number") {
  std::string text;
  for (int i = 0; i < 50; ++i) text += "x" + std::to_string(i) + " = 1 / 0\n";
  CHECK(run_statements(text, with({.errors = 7})).result.diagnostics.size() == 7);
  CHECK(run_statements(text, with({.errors = 0})).result.diagnostics.size() == 1);
  std::string warnings;
  for (int i = 0; i < 50; ++i) warnings += "\"" + std::to_string(i) + "\"\n";
  CHECK(run_statements(warnings, with({.errors = 7})).result.diagnostics.size() == 7);
}

TEST_CASE("a scope with many variables is searched in no time") {
  std::string text = "f = Macro () {\n";
  for (int i = 0; i < 5000; ++i) text += "v" + std::to_string(i) + " = " + std::to_string(i) + "\n";
  text += "sum = 0\nfor (i in range(20000)) { sum = sum + v4999 }\nprint(sum)\n}\nf()";
  CHECK(run_statements(text).printed == std::vector<std::string>{"99980000"});
}
