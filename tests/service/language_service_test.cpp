// What editors may ask: tokens, the tree with its places, names, completion and diagnostics.
// Places are checked by the text that they mark.
#include <doctest/doctest.h>

#include <algorithm>
#include <crt/error.hpp>
#include <crt/language_service.hpp>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace crt;

const std::string script = R"(-- A wall.
wood = Material { color -> rgb(0.5, 0.25, 0) }
n = 3
post = Macro (x) { Cylinder { from -> vec3(x, 0, 0) to -> vec3(x, 2, 0) radius -> 0.5 } }
Settings {
  width -> 64 title -> "a \"wall\"" showclip -> true
  camera -> Camera { position -> vec3(0, 1, -9) pointing -> vec3(n, 0, 0) fov -> n * 20 roll -> -9 }
}
Scene {
  post(n)
  (Box { cornerA -> vec3(0, 0, 0) cornerB -> vec3(1, -1, 1) material -> wood }
      - Sphere { center -> vec3(0, 0, 0) radius -> n })
      <translate vec3(0, 1, 0)>
  for (i in [1, 2]) { Sphere { radius -> i center -> vec3(1, 0, 0) } }
}
)";

std::string marked(TextSpan span) {
  return script.substr(span.begin, span.end - span.begin);
}

std::uint32_t place_of(const std::string& piece, std::size_t from = 0) {
  return static_cast<std::uint32_t>(script.find(piece, from));
}

const ScriptNode& node_at(const std::vector<ScriptNode>& tree, const std::string& piece) {
  const auto node = std::find_if(tree.begin(), tree.end(), [&](const ScriptNode& n) {
    return n.name_span.begin == place_of(piece);
  });
  REQUIRE(node != tree.end());
  return *node;
}

const ScriptAttribute& attribute_of(const ScriptNode& node, const std::string& name) {
  const auto found = std::find_if(node.attributes.begin(), node.attributes.end(),
                                  [&](const auto& attribute) { return attribute.name == name; });
  REQUIRE(found != node.attributes.end());
  return *found;
}

/// Returns options by which scripts find these files and no others.
ScriptOptions with_files(const std::map<std::string, std::string>& files) {
  ScriptOptions options;
  options.open_file = [files](const std::filesystem::path& path) {
    const auto file = files.find(path.string());
    if (file == files.end()) return std::optional<std::vector<std::byte>>();
    const auto* begin = reinterpret_cast<const std::byte*>(file->second.data());
    return std::optional<std::vector<std::byte>>({begin, begin + file->second.size()});
  };
  return options;
}

/// Puts a new name in at the places of a file.
std::string with_name(std::string text, const std::vector<ScriptLocation>& places,
                      const std::string& file, const std::string& name) {
  for (auto place = places.rbegin(); place != places.rend(); ++place) {
    if (place->file != file) continue;
    text.replace(place->span.begin, place->span.end - place->span.begin, name);
  }
  return text;
}

}  // namespace

TEST_CASE("each token has the kind that the front end gives it") {
  const LanguageService service(script, "wall.crt");
  const std::vector<ScriptToken> tokens = service.tokens();
  const auto kind_at = [&](const std::string& piece) {
    const auto token = std::find_if(tokens.begin(), tokens.end(), [&](const ScriptToken& t) {
      return t.span.begin == place_of(piece);
    });
    REQUIRE(token != tokens.end());
    return token->kind;
  };
  CHECK(kind_at("-- A wall") == TokenKind::comment);
  CHECK(kind_at("Material") == TokenKind::object);
  CHECK(kind_at("color") == TokenKind::attribute);
  CHECK(kind_at("rgb") == TokenKind::function);
  CHECK(kind_at("0.25") == TokenKind::number);
  CHECK(kind_at("Macro") == TokenKind::keyword);
  CHECK(kind_at("x) {") == TokenKind::parameter);
  CHECK(kind_at("\"a ") == TokenKind::string);
  CHECK(kind_at("wood }") == TokenKind::variable);
  for (std::size_t i = 1; i < tokens.size(); ++i)
    CHECK(tokens[i - 1].span.end <= tokens[i].span.begin);
}

TEST_CASE("the tree has objects with attributes, and a literal is known as what it says") {
  const LanguageService service(script, "wall.crt");
  const std::vector<ScriptNode> tree = service.tree();
  const ScriptNode& settings = node_at(tree, "Settings");
  CHECK(settings.kind == NodeKind::settings);
  CHECK(attribute_of(settings, "width").literal == LiteralKind::number);
  CHECK(attribute_of(settings, "width").numbers == std::vector<double>{64});
  CHECK(marked(attribute_of(settings, "width").value_span) == "64");
  CHECK(attribute_of(settings, "title").text == "a \"wall\"");
  CHECK(marked(attribute_of(settings, "title").value_span) == R"("a \"wall\"")");
  CHECK(attribute_of(settings, "showclip").literal == LiteralKind::boolean);
  CHECK(attribute_of(settings, "camera").reason == "an object Camera");
  const ScriptNode& material = node_at(tree, "Material");
  CHECK(attribute_of(material, "color").literal == LiteralKind::color);
  CHECK(attribute_of(material, "color").numbers == std::vector<double>{0.5, 0.25, 0});
  CHECK(marked(attribute_of(material, "color").value_span) == "rgb(0.5, 0.25, 0)");
  const ScriptNode& cylinder = node_at(tree, "Cylinder");
  CHECK(attribute_of(cylinder, "radius").numbers == std::vector<double>{0.5});
  CHECK(attribute_of(cylinder, "from").literal == LiteralKind::none);
  CHECK(attribute_of(cylinder, "from").numbers.empty());
  CHECK(attribute_of(cylinder, "from").reason == "a call of 'vec3'");
  const ScriptNode& box = node_at(tree, "Box");
  CHECK(attribute_of(box, "cornerB").numbers == std::vector<double>{1, -1, 1});
  CHECK(attribute_of(box, "material").reason == "the variable 'wood'");
  CHECK(attribute_of(node_at(tree, "Camera"), "fov").reason == "a computed value");
  CHECK(attribute_of(node_at(tree, "Camera"), "roll").numbers == std::vector<double>{-9});
}

TEST_CASE("nodes come behind the node around them, and numbers are no nodes") {
  const LanguageService service(script, "wall.crt");
  const std::vector<ScriptNode> tree = service.tree();
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (tree[i].parent == ScriptNode::no_parent) continue;
    REQUIRE(tree[i].parent < i);
    CHECK(tree[tree[i].parent].span.begin <= tree[i].span.begin);
    CHECK(tree[i].span.end <= tree[tree[i].parent].span.end);
  }
  const auto parent_of = [&](const std::string& piece) {
    return tree.at(node_at(tree, piece).parent);
  };
  CHECK(parent_of("Cylinder").kind == NodeKind::macro);
  CHECK(parent_of("Cylinder").name == "post");
  CHECK(parent_of("Box").kind == NodeKind::combination);
  CHECK(parent_of("Box").name == "-");
  CHECK(tree.at(parent_of("Box").parent).kind == NodeKind::placed);
  CHECK(tree.at(parent_of("Box").parent).name == "translate");
  CHECK(node_at(tree, "post(n)").kind == NodeKind::call);
  CHECK(parent_of("Sphere { radius -> i").kind == NodeKind::loop);
  CHECK(std::none_of(tree.begin(), tree.end(), [](const ScriptNode& node) {
    return node.name == "n" && node.attributes.size();
  }));
  CHECK(std::none_of(tree.begin(), tree.end(), [](const ScriptNode& node) {
    return node.kind == NodeKind::name && node.name == "n";
  }));
}

TEST_CASE("symbols have their definition and all uses, and a name leads to its definition") {
  const LanguageService service(script, "wall.crt");
  const std::vector<ScriptSymbol> symbols = service.symbols();
  const auto n = std::find_if(symbols.begin(), symbols.end(),
                              [](const ScriptSymbol& symbol) { return symbol.name == "n"; });
  REQUIRE(n != symbols.end());
  CHECK(n->definition.begin == place_of("n = 3"));
  CHECK(n->uses.size() == 5);
  for (const TextSpan use : n->uses) CHECK(marked(use) == "n");
  const auto post = service.definition(place_of("post(n)") + 1);
  REQUIRE(post);
  CHECK(post->file == "wall.crt");
  CHECK(post->span.begin == place_of("post ="));
  CHECK(service.places(place_of("post =")).size() == 2);
  CHECK_FALSE(service.definition(0));
}

TEST_CASE("the files are the script and its imports, with their texts") {
  const LanguageService service("import \"part.crt\"\nimport \"crt/metals\"\n", "/a/main.crt",
                                with_files({{"/a/part.crt", "size = 1\n"}}));
  const std::vector<ScriptFile> files = service.files();
  REQUIRE(files.size() == 3);
  CHECK(files[0].name == "/a/main.crt");
  CHECK(files[1].name == "/a/part.crt");
  CHECK(files[1].text == "size = 1\n");
  CHECK(files[2].name == "crt/metals");
  CHECK(service.has_file("/a/main.crt"));
  CHECK(service.has_file("/a/part.crt"));
  CHECK_FALSE(service.has_file("/a/other.crt"));
}

TEST_CASE("the file of a diagnostic is that of an import where that is wrong") {
  const LanguageService service("import \"part.crt\"\nScene { }\n", "/a/main.crt",
                                with_files({{"/a/part.crt", "a = \n"}}));
  REQUIRE(service.diagnostics().size() == 1);
  CHECK(service.diagnostics()[0].place.file == "/a/part.crt");
}

TEST_CASE("a new name goes to all places of the old one in its scope") {
  const LanguageService service(script, "wall.crt");
  const std::uint32_t use = place_of("n, 0, 0) fov");
  REQUIRE(service.renamable_name(use));
  CHECK(marked(*service.renamable_name(use)) == "n");
  CHECK_FALSE(service.renamable_name(place_of("rgb")));
  const std::vector<ScriptLocation> places = service.rename(use, "count");
  CHECK(places.size() == 5);
  const std::string text = with_name(script, places, "wall.crt", "count");
  CHECK(text.find("count = 3") != std::string::npos);
  CHECK(LanguageService(text, "wall.crt").diagnostics().empty());
}

TEST_CASE("a new name that is none, that means something or that comes too early is refused") {
  const LanguageService service(script, "wall.crt");
  const std::uint32_t use = place_of("n = 3");
  for (const char* name : {"", "Big", "while", "a b", "wood", "vec3"})
    CHECK_THROWS_AS(service.rename(use, name), Error);
  CHECK_THROWS_AS(service.rename(place_of("Sphere"), "count"), Error);
  CHECK_THROWS_AS(LanguageService(script + "b = (1", "wall.crt").rename(use, "count"), Error);
}

TEST_CASE("a name of an import is changed in all open scripts that import it") {
  const auto options = with_files({{"/a/part.crt", "size = 1\nlength = size\n"}});
  const LanguageService part("size = 1\nlength = size\n", "/a/part.crt", options);
  const LanguageService main("import \"part.crt\"\nScene { print(size) }\n", "/a/main.crt",
                             options);
  const LanguageService other("size = 2\n", "/a/other.crt", options);
  const std::vector<ScriptLocation> all = part.rename(0, "width", {&part, &main, &other});
  REQUIRE(all.size() == 3);
  CHECK(std::count_if(all.begin(), all.end(),
                      [](const auto& place) { return place.file == "/a/part.crt"; }) == 2);
  CHECK(all[2].file == "/a/main.crt");
  CHECK(all[2].span == TextSpan{32, 36});
  // From the script that imports it, those of the import are found without help.
  CHECK(main.rename(32, "width").size() == 3);
  CHECK(part.rename(0, "width").size() == 2);
  // A name that the other script has already.
  const LanguageService taken("import \"part.crt\"\nwidth = size\n", "/a/taken.crt", options);
  CHECK_THROWS_AS(part.rename(0, "width", {&taken}), Error);
}

TEST_CASE("a script that was read before an import changed gets no new names") {
  const LanguageService main("import \"part.crt\"\nprint(size)\n", "/a/main.crt",
                             with_files({{"/a/part.crt", "size = 1\n"}}));
  const LanguageService part("-- Sizes\nsize = 1\n", "/a/part.crt");
  CHECK_THROWS_AS(part.rename(9, "width", {&main}), Error);
  CHECK(part.rename(9, "width").size() == 1);
}

TEST_CASE("completion offers attributes that an object does not have yet") {
  const LanguageService service(script, "wall.crt");
  const CompletionList list = service.complete(place_of("radius -> i") - 1);
  const auto has = [&](const std::string& label) {
    return std::any_of(list.items.begin(), list.items.end(),
                       [&](const Completion& item) { return item.label == label; });
  };
  CHECK(has("material"));
  CHECK_FALSE(has("width"));
  CHECK(service.hover(place_of("Sphere"))->markdown.find("radius") != std::string::npos);
}

TEST_CASE("a script that is right has no diagnostics, and a broken one keeps what can be known") {
  CHECK(LanguageService(script, "wall.crt").diagnostics().empty());
  const std::string broken = script + "\nhalf = Sphere { radius -> \n";
  const LanguageService service(broken, "wall.crt");
  CHECK_FALSE(service.diagnostics().empty());
  CHECK(service.tree().size() >= LanguageService(script, "wall.crt").tree().size());
  for (const ScriptNode& node : LanguageService("Scene { Box { ", "open.crt").tree())
    CHECK(node.span.end <= 14);
  CHECK(LanguageService("", "").tree().empty());
  CHECK(LanguageService("", "").tokens().empty());
}

TEST_CASE("what is assigned to no name makes no name") {
  for (const std::string text : {"1 = 3 ", "1 += 3 ", "half = 0.5 2 = half "}) {
    CAPTURE(text);
    const LanguageService service(text, "numbers.crt");
    CHECK(service.diagnostics().size() == 1);
    CHECK(service.tree().size() == service.symbols().size());
    for (const ScriptSymbol& symbol : service.symbols()) CHECK(symbol.name == "half");
    const CompletionList list = service.complete(static_cast<std::uint32_t>(text.size()));
    for (const Completion& item : list.items) CHECK(item.label != "");
  }
}

TEST_CASE("a place behind the end is the end") {
  const LanguageService service(script, "wall.crt");
  CHECK_FALSE(service.definition(0xffffffff));
  CHECK_FALSE(service.hover(0xffffffff));
  CHECK_FALSE(service.complete(0xffffffff).items.empty());
}

TEST_CASE("all objects are described, and Settings last") {
  const std::vector<ObjectDescription> objects = describe_objects();
  REQUIRE(objects.size() > 20);
  CHECK(objects.back().name == "Settings");
  const auto sphere = std::find_if(objects.begin(), objects.end(),
                                   [](const auto& object) { return object.name == "Sphere"; });
  REQUIRE(sphere != objects.end());
  CHECK(sphere->attributes.front().name == "center");
}

TEST_CASE("formatting gives a text or says what is wrong") {
  CHECK(format_script("a=1", "a.crt").text == "a = 1\n");
  const FormattedScript wrong = format_script("a = = 1", "a.crt");
  CHECK_FALSE(wrong.text);
  CHECK_FALSE(wrong.diagnostics.empty());
}

TEST_CASE("each entity of a scene knows the statements that put it there") {
  const ScriptResult result = run_script(script, "wall.crt");
  REQUIRE(result.scene);
  REQUIRE(result.entity_places.size() == result.scene->entities.size());
  REQUIRE(result.entity_places.size() == 4);
  CHECK(marked(result.entity_places[0].statement) == "post(n)");
  CHECK(marked(result.entity_places[0].origin).starts_with("Cylinder {"));
  CHECK(marked(result.entity_places[1].statement).starts_with("(Box"));
  CHECK(result.entity_places[1].statement == result.entity_places[1].origin);
  CHECK(marked(result.entity_places[3].statement) ==
        "Sphere { radius -> i center -> vec3(1, 0, 0) }");
}

TEST_CASE("what a macro of an imported script emits comes from the call") {
  const std::string text = "import \"post.crt\"\nScene { post() }";
  ScriptOptions options;
  options.open_file = [](const std::filesystem::path& path) {
    const std::string post = "post = Macro () { Sphere { center -> vec3(0, 0, 0) radius -> 1 } }";
    const auto* begin = reinterpret_cast<const std::byte*>(post.data());
    return path.filename() == "post.crt"
               ? std::optional(std::vector<std::byte>(begin, begin + post.size()))
               : std::nullopt;
  };
  const ScriptResult result = run_script(text, "main.crt", options);
  REQUIRE(result.entity_places.size() == 1);
  const TextSpan call{static_cast<std::uint32_t>(text.find("post()")),
                      static_cast<std::uint32_t>(text.find(" }"))};
  CHECK(result.entity_places[0].statement == call);
  CHECK(result.entity_places[0].origin == call);
}
