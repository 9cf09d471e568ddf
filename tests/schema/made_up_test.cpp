// A light and a primitive are made up here by tables of the schema alone. They are found where the
// real ones are: in scripts, in source code, in completion, in the reference and by the checks.
#include <doctest/doctest.h>

#include <numbers>
#include <string>
#include <vector>

#include "core/geometry/check_fields.hpp"
#include "crt/error.hpp"
#include "crt/schema_primitives.hpp"
#include "crt/schema_scene.hpp"
#include "crt/schema_settings.hpp"
#include "lang/failure.hpp"
#include "lang/reference_tables.hpp"
#include "lang/schema_objects.hpp"
#include "service/completion_items.hpp"
#include "service/reference.hpp"
#include "source/row_writer.hpp"
#include "source/shapes.hpp"

namespace {

/// A LanternLight shines like a point, for all that the renderer knows.
struct LanternLight {
  crt::Vec3 origin{0, 0, 0};
  crt::Color color = {1, 1, 1};
  double beam_angle = std::numbers::pi / 6;
  double wick_length = 0.25;
  bool is_lit = true;
  crt::FalloffModel dims_by = crt::FalloffModel::light;

  operator crt::Light() const {  // NOLINT(google-explicit-constructor): as if it were one
    return crt::PointLight{.origin = origin, .color = color, .falloff = wick_length};
  }
};

/// A RoofTile is a box, for all that the renderer knows.
struct RoofTile {
  crt::Vec3 corner_a{0, 0, 0};
  crt::Vec3 corner_b{1, 1, 1};
  double rim_b = 0.5;
  std::optional<crt::SharedMaterial> material{};

  operator crt::Primitive() const {  // NOLINT(google-explicit-constructor): as if it were one
    return crt::Box{.corner_a = corner_a, .corner_b = corner_b, .material = material};
  }
};

}  // namespace

namespace crt::schema {

template <>
inline constexpr auto table<LanternLight> = Table{
    "LanternLight",
    field("origin", &LanternLight::origin, point, required, "where it hangs"),
    field("color", &LanternLight::color, brightness, required, ""),
    field("beam_angle", &LanternLight::beam_angle, radians, {.degrees = "must be an angle"},
          "in degrees"),
    field("wick_length", &LanternLight::wick_length, share, {.c = "wick"}, "how long it burns"),
    field("is_lit", &LanternLight::is_lit, any, {}, ""),
    field("dims_by", &LanternLight::dims_by, any, {}, ""),
};

template <>
inline constexpr auto table<RoofTile> = Table{
    "RoofTile",
    field("corner_a", &RoofTile::corner_a, point, required, "any corner"),
    field("corner_b", &RoofTile::corner_b, opposite_to("corner_a"), required, "the opposite one"),
    field("rim_b", &RoofTile::rim_b, length, {}, "of the rim"),
    material<RoofTile>,
};

}  // namespace crt::schema

namespace {

using crt::lang::Given;
using crt::lang::ObjectType;
using crt::lang::Value;

/// A Script has what an object is made in. All that is wrong is at the beginning of its text.
struct Script {
  crt::ScriptOptions options;
  crt::lang::SourceMap sources;
  crt::lang::SymbolTable symbols;
  crt::lang::Reporter reporter{sources, 10};
  crt::lang::Context context{options, symbols, sources, reporter};
  crt::lang::Span span{};

  Script() {
    const crt::lang::Source& source = sources.add("test.crt", "Lantern { }");
    span = {source.base, source.base + 1};
  }

  /// Makes an object of attributes with these names and values.
  Value make(const ObjectType& type, const std::vector<std::pair<std::string, Value>>& given) {
    std::vector<Given> attributes;
    for (const auto& [name, value] : given) {
      const std::size_t place = find_attribute(type, name);
      REQUIRE(place < type.attributes.size());
      attributes.push_back({&type.attributes[place], span, span, value});
    }
    return type.build({context, span, attributes});
  }

  /// Returns the message of what making it fails with.
  std::string failure(const ObjectType& type,
                      const std::vector<std::pair<std::string, Value>>& given) {
    try {
      make(type, given);
    } catch (const crt::lang::Failure& failure) {
      return failure.message;
    }
    return {};
  }
};

std::string text_of(const LanternLight& light, crt::SourceLanguage language) {
  crt::SourceOptions options;
  options.language = language;
  crt::source::Program program(options);
  const std::string value = light_of_kind(program, light);
  return program.lines() + value;
}

}  // namespace

TEST_CASE("a made-up light is an object of scripts, with defaults and words of its own") {
  const ObjectType type = crt::lang::light<LanternLight>();
  CHECK(type.name == "LanternLight");
  CHECK(crt::test::attribute_rows(type, {}) ==
        "| `origin` | Vec3 | required | where it hangs |\n"
        "| `color` | Color | required | |\n"
        "| `beamangle` | Float | `30` | in degrees |\n"
        "| `wicklength` | Float | `0.25` | how long it burns |\n"
        "| `islit` | Boolean | `true` | |\n"
        "| `dimsby` | String | `\"light\"` | |\n");
  Script script;
  const Value made = script.make(
      type, {{"origin", crt::Vec3(1, 2, 3)}, {"color", crt::Color{1, 0, 0}}, {"wicklength", 0.5}});
  const auto* const light = std::get_if<std::shared_ptr<const crt::Light>>(&made);
  REQUIRE(light != nullptr);
  const auto& point = std::get<crt::PointLight>(**light);
  CHECK(point.origin == crt::Vec3(1, 2, 3));
  CHECK(point.color == crt::Color{1, 0, 0});
  CHECK(point.falloff == 0.5);
  CHECK(script.failure(type, {{"dimsby", script.context.make_string(script.span, "paths")}}) ==
        "'dimsby' must be \"path\" or \"light\"; did you mean \"path\"?");
  CHECK(script.failure(type, {{"islit", 1.0}}) == "'islit' must be a Boolean, not a Float");
  CHECK(script.failure(type, {{"color", crt::Color{-1, 0, 0}}}) ==
        "'color' must not have negative or absurd channels (one is -1)");
}

TEST_CASE("a made-up light is written as source code in each language") {
  LanternLight light{.origin = {1, 0, 0}, .wick_length = 0.5};
  CHECK(text_of(light, crt::SourceLanguage::cpp) ==
        "LanternLight{.origin = {1, 0, 0}, .wick_length = 0.5}");
  CHECK(text_of(light, crt::SourceLanguage::python) ==
        "crt.Light.lantern(origin=(1, 0, 0), wick=0.5)");
  CHECK(text_of(light, crt::SourceLanguage::script) ==
        "LanternLight { origin -> vec3(1, 0, 0) color -> rgb(1, 1, 1) wicklength -> 0.5 }");
  light.is_lit = false;
  const std::string c = text_of(light, crt::SourceLanguage::c);
  CHECK(c.find("CRT_LIGHT_LANTERN") != std::string::npos);
  CHECK(c.find(".wick = 0.5;") != std::string::npos);
  CHECK(c.find("set(") != std::string::npos);
  light.beam_angle = std::numbers::pi;
  light.dims_by = crt::FalloffModel::path;
  CHECK(text_of(light, crt::SourceLanguage::script).find("beamangle -> 180 ") != std::string::npos);
  CHECK(text_of(light, crt::SourceLanguage::cpp).find(".dims_by = FalloffModel::path") !=
        std::string::npos);
}

TEST_CASE("completion offers a made-up light with what it must have") {
  const crt::service::Reference reference("");
  const crt::service::CompletionItems items(reference);
  const ObjectType type = crt::lang::light<LanternLight>();
  const crt::Completion object = items.object(type);
  CHECK(object.label == "LanternLight");
  CHECK(object.snippet == "LanternLight { origin -> $1 color -> $2 }$0");
  const crt::Completion attribute = items.attribute(type, type.attributes[2], true);
  CHECK(attribute.text == "beamangle -> ");
  CHECK(attribute.detail == "Float, default 30");
}

TEST_CASE("a made-up primitive is an entity of scripts, also without a size") {
  const ObjectType type = crt::lang::entity<RoofTile>();
  CHECK(crt::test::attribute_rows(type, {}) ==
        "| `cornerA` | Vec3 | required | any corner |\n"
        "| `cornerB` | Vec3 | required | the opposite one |\n"
        "| `rimB` | Float | `0.5` | of the rim |\n"
        "| `material` | Material | `a grey of 0.5` | |\n");
  Script script;
  const crt::Vec3 zero(0);
  const crt::Vec3 one(1);
  const Value made = script.make(type, {{"cornerA", zero}, {"cornerB", one}});
  REQUIRE(std::holds_alternative<crt::Entity>(made));
  CHECK(std::get<crt::Entity>(made).is_solid());
  script.make(type, {{"cornerA", zero}, {"cornerB", one}, {"rimB", 0.0}});
  script.make(type, {{"cornerA", zero}, {"cornerB", crt::Vec3(1, 0, 1)}});
  std::vector<std::string> warnings;
  for (const crt::Diagnostic& diagnostic : script.reporter.diagnostics())
    warnings.push_back(diagnostic.message);
  CHECK(warnings ==
        std::vector<std::string>{"'rimB' is 0: what has no size draws nothing",
                                 "'cornerB' does not differ from 'cornerA' in every coordinate: "
                                 "what has no size draws nothing"});
}

TEST_CASE("a made-up primitive is checked by its rules") {
  const auto fault = [](const RoofTile& tile) -> std::string {
    try {
      crt::core::check_fields(tile);
    } catch (const crt::Error& error) {
      return error.argument() + ": " + error.what();
    }
    return {};
  };
  CHECK(fault({}).empty());
  CHECK(fault({.rim_b = -1}) == "rim_b: rim_b must be greater than 0 (it is -1)");
  CHECK(fault({.corner_b = {1, 1, 0}}) ==
        "corner_b: corner_b must differ from corner_a in every coordinate");
  CHECK(fault({.corner_a = {1e101, 0, 0}}).starts_with("corner_a: corner_a must be at most 1e100"));
}

TEST_CASE("a made-up primitive is described and written by its numbers") {
  const crt::source::ShapeCode code = crt::source::shape_code_of(RoofTile{});
  CHECK(code.name == "RoofTile");
  CHECK(code.c == "roof_tile");
  REQUIRE(code.arguments.size() == 3);
  CHECK(code.arguments[1].cpp == "corner_b");
  CHECK(std::get<crt::Vec3>(code.arguments[1].value) == crt::Vec3(1));
  CHECK(std::get<double>(code.arguments[2].value) == 0.5);
}

TEST_CASE("the tables of all structs list each field once, and names differ in scripts") {
  std::size_t rows = 0;
  const auto look_at = [&rows]<class Kind>(std::type_identity<Kind>) {
    std::vector<std::string_view> names;
    crt::schema::for_each_field<Kind>([&](const auto& row) {
      ++rows;
      CHECK(std::find(names.begin(), names.end(), row.name) == names.end());
      names.push_back(row.name);
      names.push_back(row.script_name() == row.name ? "" : row.script_name());
    });
  };
  crt::schema::for_each_kind<crt::Primitive>(look_at);
  crt::schema::for_each_kind<crt::Light>(look_at);
  CHECK(rows > 50);
}
