// These tests check the warnings of names that are never used.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "run.hpp"

namespace {

using crt::test::run;
using crt::test::run_statements;

using Messages = std::vector<std::string>;

Messages warnings(const std::string& text, crt::ScriptOptions options = {}) {
  return run_statements(text, std::move(options)).messages();
}

}  // namespace

TEST_CASE("a name is used if anything can read it, however late or deep") {
  CHECK(warnings("f = Macro () { print(x) } x = 1 f()").empty());
  CHECK(
      warnings("f = Macro (a) { return Macro () { return Macro () { return a } } } f(1)").empty());
  CHECK(warnings("x = 1 Settings { width -> x }").empty());
  CHECK(warnings("if (false) { x = 1 print(x) }").empty());
  CHECK(warnings("x = 1 x = x + 1").empty());
  CHECK(warnings("x = 1 x += 1").empty());
}

TEST_CASE("a name in a macro is not that of the top level") {
  CHECK(warnings("x = 1 print(x) f = Macro () { x = 2 } f()") ==
        Messages{"the variable 'x' is never used; it is the macro's own, as macros never change "
                 "variables outside"});
  CHECK(warnings("f = Macro (x) { } x = 1 print(x) f(2)") ==
        Messages{"the parameter 'x' is never used; begin its name with '_' if that is meant"});
  CHECK(warnings("f = Macro () { y = 1 } g = Macro () { y = 2 print(y) } f() g()") ==
        Messages{"the variable 'y' is never used"});
}

TEST_CASE("names of loops, names that begin with '_' and scripts of 2015 are exempt") {
  CHECK(warnings("for (i in range(3)) { print(1) }").empty());
  CHECK(warnings("_x = 1 f = Macro (_a) { _b = 2 } f(1)").empty());
  crt::ScriptOptions options;
  options.compat = crt::compat_2015;
  CHECK(warnings("x = 1", options).empty());
}

TEST_CASE("of imports nothing is said, and what they read is used") {
  crt::ScriptOptions options;
  options.open_file = [](const std::filesystem::path&) {
    const std::string text = "unused = 1 f = Macro (a) { return size }";
    const auto* begin = reinterpret_cast<const std::byte*>(text.data());
    return std::vector<std::byte>(begin, begin + text.size());
  };
  CHECK(warnings("size = 3 import \"part.crt\"", options).empty());
  CHECK(warnings("sise = 3 import \"part.crt\"", options) ==
        Messages{"the variable 'sise' is never used"});
}

TEST_CASE("a script with an error gets no such warnings") {
  CHECK(warnings("x = 1 print(y)") == Messages{"unknown name 'y'"});
}

TEST_CASE("a script of very many names is done at once, with a few warnings") {
  std::string text;
  for (int i = 0; i < 50'000; ++i) text += "x" + std::to_string(i) + " = x\n";
  const crt::test::Run result = run_statements("x = 1\n" + text);
  CHECK(result.ok());
  CHECK(result.result.diagnostics.size() == 20);
}

TEST_CASE("what macros return is bounded as all else") {
  CHECK(
      run_statements("f = Macro (n) { return f(n + 1) } f(0)").failed_with(crt::ErrorCode::limit));
  CHECK(run_statements("f = Macro () { while (true) { return 1 } } while (true) { f() }")
            .failed_with(crt::ErrorCode::limit));
  CHECK(run_statements("l = [] f = Macro (l) { return l + l + [1] } "
                       "for (i in range(99)) { l = f(l) }")
            .failed_with(crt::ErrorCode::limit));
}
