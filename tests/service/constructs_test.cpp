// What editors may ask about named arguments, dictionaries, imports with names, comprehensions and
// values in strings.
#include <doctest/doctest.h>

#include <algorithm>
#include <crt/language_service.hpp>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace crt;

const std::string script = R"(gear = Macro (teeth, module -> 1) { return "\{teeth} of \{module}" }
bolt = { name -> "M3", "outer width" -> 5.5 }
import "part.crt" as part
teeth = 2
for (i in [n * 2 for n, m in [[1, 2]] if n > 1]) { if (i > 2) { break } print(i) }
print(gear(3, module -> teeth), bolt.name, part.size, part.size)
Scene { }
)";

ScriptOptions with_part() {
  ScriptOptions options;
  options.open_file = [](const std::filesystem::path&) {
    static const std::string text = "size = 1\nhidden = Macro () { inside = size }\n";
    const auto* begin = reinterpret_cast<const std::byte*>(text.data());
    return std::optional<std::vector<std::byte>>({begin, begin + text.size()});
  };
  return options;
}

std::uint32_t place_of(const std::string& text, const std::string& piece) {
  const std::size_t place = text.find(piece);
  REQUIRE(place != std::string::npos);
  return static_cast<std::uint32_t>(place);
}

std::string with_new_name(const std::string& piece, const std::string& name) {
  const LanguageService service(script, "/main.crt", with_part());
  std::vector<ScriptLocation> places = service.rename(place_of(script, piece), name);
  std::string text = script;
  for (auto place = places.rbegin(); place != places.rend(); ++place) {
    if (place->file == "/main.crt")
      text.replace(place->span.begin, place->span.end - place->span.begin, name);
  }
  return text;
}

/// Returns what may stand at the end of a text, with what it puts in.
std::vector<std::string> completed(const std::string& behind) {
  const std::string text = script + behind;
  const LanguageService service(text, "/main.crt", with_part());
  std::vector<std::string> result;
  for (const Completion& item : service.complete(static_cast<std::uint32_t>(text.size())).items)
    result.push_back(item.text);
  return result;
}

bool has(const std::vector<std::string>& texts, const std::string& text) {
  return std::find(texts.begin(), texts.end(), text) != texts.end();
}

}  // namespace

TEST_CASE("the script with these constructs has no diagnostics") {
  CHECK(LanguageService(script, "/main.crt", with_part()).diagnostics().empty());
}

TEST_CASE("a new name of a parameter goes to the arguments that have its name") {
  std::string expected = script;
  for (const char* piece : {"module ->", "module}", "module -> teeth"})
    expected.replace(expected.find(piece), 6, "size");
  CHECK(with_new_name("module ->", "size") == expected);
  CHECK(with_new_name("module -> teeth", "size") == expected);
  CHECK(with_new_name("module}", "size") == expected);
}

TEST_CASE("a new name of what a comprehension takes apart stays in its brackets") {
  std::string expected = script;
  for (const char* piece : {"n * 2", "n, m", "n > 1"}) expected[expected.find(piece)] = 'k';
  CHECK(with_new_name("n, m", "k") == expected);
}

TEST_CASE("a name behind an import's is a name of that script") {
  const LanguageService service(script, "/main.crt", with_part());
  const std::uint32_t member = place_of(script, "size, part");
  const auto definition = service.definition(member);
  REQUIRE(definition);
  CHECK(definition->file == "/part.crt");
  CHECK(definition->span == TextSpan{0, 4});
  const std::vector<ScriptLocation> all = service.rename(member, "length");
  CHECK(all.size() == 4);
  const auto space = service.definition(place_of(script, "part.size"));
  REQUIRE(space);
  CHECK(space->span.begin == place_of(script, "part\n"));
}

TEST_CASE("words that leave loops are keywords, and pieces around a value are strings") {
  const std::vector<ScriptToken> tokens =
      LanguageService(script, "/main.crt", with_part()).tokens();
  const auto kind_at = [&](const std::string& piece) {
    const auto token = std::find_if(tokens.begin(), tokens.end(), [&](const ScriptToken& one) {
      return one.span.begin == place_of(script, piece);
    });
    REQUIRE(token != tokens.end());
    return token->kind;
  };
  CHECK(kind_at("break") == TokenKind::keyword);
  CHECK(kind_at("as part") == TokenKind::keyword);
  CHECK(kind_at("\"\\{teeth}") == TokenKind::string);
  CHECK(kind_at("} of") == TokenKind::string);
  CHECK(kind_at("teeth} of") == TokenKind::parameter);
  CHECK(kind_at("module -> teeth") == TokenKind::attribute);
  CHECK(kind_at("name -> ") == TokenKind::attribute);
}

TEST_CASE("completion offers the parts of a value behind a point") {
  const std::vector<std::string> members = completed("print(part.");
  CHECK(members == std::vector<std::string>{"size", "hidden"});
  CHECK(completed("print(part.hi") == members);
  CHECK(completed("print(bolt.") == std::vector<std::string>{"name", "outer width"});
  CHECK(completed("print(vec3(1, 2, 3).") ==
        std::vector<std::string>{"x", "y", "z", "r", "g", "b", "a"});
}

TEST_CASE("completion offers the parameters of a macro where an argument begins") {
  CHECK(has(completed("print(gear("), "module -> "));
  CHECK(has(completed("print(gear(3, mo"), "module -> "));
  CHECK_FALSE(has(completed("print(gear(3 + "), "module -> "));
  CHECK_FALSE(has(completed("print(gear, "), "module -> "));
  CHECK(has(completed("print(\"a \\{te"), "teeth"));
  CHECK(completed("print(\"a \\{teeth} te").empty());
}

TEST_CASE("the signature of a macro has the defaults of its parameters") {
  const LanguageService service(script, "/main.crt", with_part());
  const auto hover = service.hover(place_of(script, "gear(3"));
  REQUIRE(hover);
  CHECK(hover->markdown.find("gear(teeth, module -> 1)") != std::string::npos);
}
