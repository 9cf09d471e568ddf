// What editors know of materials that are derived from variables: brass { roughness -> 0.4 }.
#include <doctest/doctest.h>

#include <algorithm>
#include <crt/language_service.hpp>
#include <string>
#include <vector>

namespace {

using namespace crt;

const std::string script = R"(import "crt/materials"
tint = rgb(0.9, 0.8, 0.4)
brass = PrincipledMaterial { color -> tint metallic -> 1 roughness -> 0.2 }
other = brass
dull = other { roughness -> 0.6 sheen -> 0.1 }
worn = dull { sheen -> 0.3 }
paint = Material { color -> rgb(1, 0, 0) }
gloss = paint { specular -> 0.5 }
gold = satinGold { coat -> 1 }
ball = Macro (wear) {
  Sphere { center -> vec3(0, 0, 0) radius -> 1 material -> wear { bumpheight -> 0 } }
}
Scene { ball(worn) }
)";

const ScriptNode& copy_of(const std::vector<ScriptNode>& tree, const std::string& base) {
  const auto node =
      std::find_if(tree.begin(), tree.end(), [&](const ScriptNode& n) { return n.base == base; });
  REQUIRE(node != tree.end());
  return *node;
}

std::string names_of(const std::vector<ScriptAttribute>& attributes) {
  std::string names;
  for (const ScriptAttribute& attribute : attributes) names += attribute.name + ' ';
  return names;
}

/// Lists what is offered at the sign |, which is not in the text.
std::vector<std::string> offered(std::string text) {
  const std::size_t place = text.find('|');
  text.erase(place, 1);
  const LanguageService service(text, "wall.crt");
  std::vector<std::string> labels;
  for (const Completion& item : service.complete(static_cast<std::uint32_t>(place)).items)
    labels.push_back(item.label);
  return labels;
}

bool has(const std::vector<std::string>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

}  // namespace

TEST_CASE("a derived material is an object of the kind that it is a copy of") {
  const std::vector<ScriptNode> tree = LanguageService(script, "wall.crt").tree();
  const ScriptNode& dull = copy_of(tree, "other");
  CHECK(dull.kind == NodeKind::object);
  CHECK(dull.name == "PrincipledMaterial");
  CHECK(script.substr(dull.span.begin, dull.span.end - dull.span.begin) ==
        "other { roughness -> 0.6 sheen -> 0.1 }");
  CHECK(script.substr(dull.name_span.begin, 5) == "other");
  CHECK(names_of(dull.attributes) == "roughness sheen ");
  CHECK(copy_of(tree, "paint").name == "Material");
  CHECK(copy_of(tree, "satinGold").name == "PrincipledMaterial");
  // What a macro is called with is not known.
  CHECK(copy_of(tree, "wear").name == "wear");
  CHECK(copy_of(tree, "wear").inherited.empty());
  const auto copies = std::count_if(tree.begin(), tree.end(),
                                    [](const ScriptNode& node) { return !node.base.empty(); });
  CHECK(copies == 5);
}

TEST_CASE("what a derived material does not say it has from its variable, and that from its own") {
  const std::vector<ScriptNode> tree = LanguageService(script, "wall.crt").tree();
  CHECK(names_of(copy_of(tree, "other").inherited) == "color metallic ");
  const std::vector<ScriptAttribute>& worn = copy_of(tree, "dull").inherited;
  REQUIRE(names_of(worn) == "roughness color metallic ");
  CHECK(worn[0].literal == LiteralKind::number);
  CHECK(worn[0].numbers == std::vector<double>{0.6});
  CHECK(worn[0].written == "0.6");
  CHECK(worn[1].literal == LiteralKind::none);
  CHECK(worn[1].reason == "the variable 'tint'");
  CHECK(worn[1].written == "tint");
  // The library's satinGold is derived, too: from pureGold.
  const std::vector<ScriptAttribute>& gold = copy_of(tree, "satinGold").inherited;
  REQUIRE(names_of(gold) == "roughness color metallic density ");
  CHECK(gold[0].numbers == std::vector<double>{0.35});
  CHECK(gold[1].literal == LiteralKind::color);
  CHECK(gold[1].written == "rgb(1, 0.766, 0.336)");
}

TEST_CASE("a derived material may be a statement, and may be derived from itself") {
  for (const char* text :
       {"gold = Material { }\ngold { reflectivity -> 0.4 }\n",
        "a = a { sheen -> 1 }\na { coat -> 1 }\n", "a = b { sheen -> 1 }\nb = a { coat -> 1 }\n"}) {
    const std::vector<ScriptNode> tree = LanguageService(text, "wall.crt").tree();
    REQUIRE(tree.size() >= 2);
    CHECK(!tree.back().base.empty());
    CHECK(tree.back().attributes.size() == 1);
  }
}

TEST_CASE("completion in the braces of a derived material offers the attributes of its kind") {
  const std::string brass = "brass = PrincipledMaterial { metallic -> 1 }\n";
  for (const char* text : {"copy = brass { | }\n", "copy = brass { |", "copy = brass { ro|",
                           "copy = brass {\n    ro|\n}\n", "copy = brass { metallic -> 1 | }",
                           "copy = brass { metallic -> 1 ro| }",
                           "Scene { Sphere { radius -> 1 material -> brass { | } } }",
                           "Scene { Sphere { radius -> 1 material -> brass { ro|"}) {
    CAPTURE(text);
    const std::vector<std::string> labels = offered(brass + text);
    CHECK(has(labels, "roughness"));
    CHECK(has(labels, "coatroughness"));
    CHECK_FALSE(has(labels, "reflectivity"));
    CHECK_FALSE(has(labels, "sin"));
  }
  const std::vector<std::string> given = offered(brass + "copy = brass { roughness -> 1 | }");
  CHECK_FALSE(has(given, "roughness"));
  CHECK(has(offered("paint = Material { }\ncopy = paint { | }"), "reflectivity"));
  CHECK(has(offered("import \"crt/materials\"\ncopy = ruby { | }"), "transmission"));
  CHECK(has(offered(brass + "copy = brass { roughness -> | }"), "sin"));
  CHECK_FALSE(has(offered("n = 3\ncopy = n { | }"), "roughness"));
}

TEST_CASE("an attribute of a derived material is explained as one of its kind") {
  const LanguageService service(script, "wall.crt");
  const auto hover_at = [&](const std::string& piece) {
    const auto hover = service.hover(static_cast<std::uint32_t>(script.find(piece)));
    return hover ? hover->markdown : std::string();
  };
  CHECK(hover_at("sheen -> 0.3").find("sheen -> Float, default 0") != std::string::npos);
  CHECK(hover_at("sheen -> 0.3").find("cloth") != std::string::npos);
  CHECK(hover_at("specular").find("specular -> Float") != std::string::npos);
  CHECK(hover_at("coat -> 1").find("varnish") != std::string::npos);
  CHECK(hover_at("bumpheight").empty());
  CHECK(hover_at("dull { sheen").find("dull = other { roughness -> 0.6 sheen -> 0.1 }") !=
        std::string::npos);
}
