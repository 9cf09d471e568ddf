#include "source/values.hpp"

#include <cctype>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "crt/error.hpp"
#include "crt/schema_materials.hpp"
#include "crt/schema_scene.hpp"
#include "crt/schema_settings.hpp"
#include "text/format.hpp"

namespace crt::source {

namespace {

/// Says what a kind of a pattern or light is in the three languages.
struct KindNames {
  std::string cpp;
  std::string python;
  std::string c;
};

/// Returns the names of a kind of a family: "SpotLight", "Light.spot" and "CRT_LIGHT_SPOT".
KindNames names_of(std::string_view family, std::string_view kind) {
  if (kind == "ImageMap") return {"ImageMap", "Pattern.of_image", "CRT_PATTERN_IMAGE"};
  const bool has_family = kind.ends_with(family);
  const schema::Name word =
      schema::c_name(kind.substr(0, kind.size() - (has_family ? family.size() : 0)));
  std::string c = text::format("CRT_{}_{}", family, word.text());
  for (char& letter : c) letter = static_cast<char>(std::toupper(letter));
  return {std::string(kind), text::format("{}.{}", family, word.text()), c};
}

/// Returns the names of the kind that a variant has.
template <class Variant>
KindNames names_of(std::string_view family, const Variant& variant) {
  return std::visit(
      [&]<class Kind>(const Kind&) { return names_of(family, schema::table<Kind>.name); }, variant);
}

const std::string& name_in(const Syntax& syntax, const KindNames& names) {
  return syntax.is_python() ? names.python : names.cpp;
}

std::string pattern_value(Program& program, const Pattern& pattern);

/// Returns what a field has that holds a pattern: its value, or its address in C.
std::string pattern_in_field(Program& program, const Pattern& pattern) {
  const std::string value = pattern_value(program, pattern);
  return program.syntax().is_c() ? "&" + value : value;
}

/// Returns a pattern that takes the place of what a struct has otherwise.
std::string replacing_pattern(Program& program, const Pattern& pattern) {
  const std::string value = pattern_in_field(program, pattern);
  return program.syntax().is_cpp() ? text::format("Pattern{{{}}}", value) : value;
}

/// Adds the fields of a struct that has a table in the schema: those that are not as usual, and in
/// scripts those that must be there.
class RowWriter {
 public:
  RowWriter(Program& program, Fields& fields)
      : program_(program), syntax_(program.syntax()), fields_(fields) {}

  template <class Struct>
  void add_all(const Struct& object, const Struct& usual = {}) {
    schema::for_each_field<Struct>([&]<class Row>(const Row& row) {
      must_be_there_ = syntax_.is_script() && (row.uses.required || row.uses.always_written);
      const bool is_pattern = std::is_same_v<typename Row::Value, SharedPattern>;
      if (!syntax_.is_script() || row.uses.in_scripts || is_pattern)
        add(row.name, row.c_name(), row.uses, object.*row.member, usual.*row.member);
    });
  }

 private:
  using Text = std::string_view;
  using Uses = schema::Uses;

  void add(Text cpp, Text c, const Uses& uses, double value, double usual) {
    if (value == usual && !must_be_there_) return;
    fields_.add_text(cpp, c, uses.degrees.empty() ? Syntax::number(value) : program_.angle(value));
  }
  void add(Text cpp, Text c, const Uses&, int value, int usual) {
    if (value != usual) fields_.add_text(cpp, c, std::to_string(value));
  }
  void add(Text cpp, Text c, const Uses&, const Vec3& value, const Vec3& usual) {
    if (value != usual || must_be_there_) fields_.add_vector(cpp, c, value);
  }
  /// In C and Python alpha is a field of its own, if there is any.
  void add(Text cpp, Text c, const Uses& uses, const Color& value, const Color& usual) {
    if (syntax_.is_cpp() || syntax_.is_script()) {
      if (value != usual || must_be_there_) fields_.add_text(cpp, c, syntax_.color(value));
      return;
    }
    const Vec3 rgb(value.r, value.g, value.b);
    if (rgb != Vec3(usual.r, usual.g, usual.b)) fields_.add_vector(cpp, c, rgb);
    if (value.a != usual.a) fields_.add_text("", uses.alpha, Syntax::number(value.a));
  }
  void add(Text cpp, Text c, const Uses&, const std::string& value, const std::string&) {
    if (!value.empty()) fields_.add_text(cpp, c, syntax_.text(value));
  }
  /// In C and Python a flag is 0 or 1, and 0 as usual.
  void add(Text cpp, Text c, const Uses&, bool value, bool usual) {
    if (value != usual)
      fields_.add_text(cpp, c,
                       syntax_.is_cpp() || syntax_.is_script() ? syntax_.boolean(value) : "1");
  }
  void add(Text cpp, Text c, const Uses&, std::uint64_t value, std::uint64_t usual) {
    if (value == usual) return;
    if (syntax_.is_script() && value > std::numeric_limits<std::int64_t>::max())
      throw Error(ErrorCode::unsupported,
                  text::format("a {} of 2^63 or more cannot be written in a script", cpp));
    const bool has_suffix = syntax_.is_cpp() || syntax_.is_c();
    fields_.add_text(cpp, c, std::to_string(value) + (has_suffix ? "U" : ""));
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void add(Text cpp, Text c, const Uses&, Enum value, Enum usual) {
    fields_.add_enum(cpp, c, value, usual);
  }
  void add(Text cpp, Text c, const Uses&, const std::optional<double>& value,
           const std::optional<double>&) {
    if (value) fields_.add_text(cpp, c, Syntax::number(*value));
  }
  void add(Text cpp, Text c, const Uses& uses, const std::variant<Color, Pattern>& value,
           const std::variant<Color, Pattern>& usual) {
    if (const auto* color = std::get_if<Color>(&value))
      return add(cpp, c, uses, *color, std::get<Color>(usual));
    fields_.add_text(cpp, "pattern", replacing_pattern(program_, std::get<Pattern>(value)));
  }
  void add(Text cpp, Text c, const Uses&, const std::optional<Pattern>& value,
           const std::optional<Pattern>&) {
    if (value) fields_.add_text(cpp, c, replacing_pattern(program_, *value));
  }
  /// In a script it stands in the place of a colour.
  void add(Text cpp, Text c, const Uses&, const SharedPattern& value, const SharedPattern&) {
    if (!value) return;
    if (syntax_.is_script()) cpp = cpp == "pattern_a" ? "color_a" : "color_b";
    const std::string inner = pattern_in_field(program_, value->pattern);
    fields_.add_text(cpp, c, syntax_.is_cpp() ? text::format("nested({})", inner) : inner);
  }
  void add(Text cpp, Text c, const Uses&, const std::shared_ptr<const Image>& value,
           const std::shared_ptr<const Image>&) {
    fields_.add_text(cpp, c, image_name(program_, value));
  }
  void add(Text, Text, const Uses&, const std::vector<ColorStop>& stops,
           const std::vector<ColorStop>&) {
    if (stops.empty()) return;
    std::vector<std::string> items;
    items.reserve(stops.size());
    const bool is_python = syntax_.is_python();
    for (const auto& [position, color] : stops) {
      if (syntax_.is_script()) {
        items.push_back(text::format("[{}, {}]", position, syntax_.color(color)));
        continue;
      }
      const std::string rgb = text::format("{}, {}, {}", color.r, color.g, color.b);
      items.push_back(is_python ? text::format("({}, ({}), {})", position, rgb, color.a)
                      : syntax_.is_cpp()
                          ? text::format("{{{}, {{{}, {}}}}}", position, rgb, color.a)
                          : text::format("{{{}, {{{}}}, {}}}", position, rgb, color.a));
    }
    if (!syntax_.is_c()) return fields_.add_text("colors", "colors", syntax_.list(items));
    fields_.add_text("", "colors", program_.array("colors", "crt_color_stop", items));
    fields_.add_text("", "color_count", std::to_string(stops.size()));
  }

  Program& program_;
  const Syntax& syntax_;
  Fields& fields_;
  bool must_be_there_ = false;
};

template <class Kind>
void add_pattern_fields(Program& program, Fields& fields, Kind pattern) {
  RowWriter writer(program, fields);
  if constexpr (requires { pattern.pattern_a; }) {
    if (program.syntax().is_script()) {
      // The other pattern stands in the place of the colour, which is not written if it is as
      // usual.
      if (pattern.pattern_a) pattern.color_a = Kind{}.color_a;
      if (pattern.pattern_b) pattern.color_b = Kind{}.color_b;
    }
  }
  writer.add_all(pattern);
}

std::string pattern_value(Program& program, const Pattern& pattern) {
  const KindNames names = names_of("Pattern", pattern);
  Fields fields(program.syntax());
  std::visit([&](const auto& kind) { add_pattern_fields(program, fields, kind); }, pattern);
  return program.structure("pattern", name_in(program.syntax(), names), fields, names.c);
}

}  // namespace

std::string material_name(Program& program, const SharedMaterial& shared) {
  const Material& material = *shared;
  if (std::string known = program.known(&material); !known.empty()) return known;
  Fields fields(program.syntax());
  RowWriter(program, fields).add_all(material);
  // Materials of the same values are one.
  const std::string content = fields.constructed("Material");
  std::string name = program.known_value(content);
  if (name.empty()) {
    name = program.syntax().is_c() ? program.structure("material", "Material", fields)
                                   : program.define("material", "SharedMaterial", content);
    program.remember_value(content, name);
  }
  return program.remember(&material, name);
}

std::string light_value(Program& program, const Light& light) {
  const KindNames names = names_of("Light", light);
  Fields fields(program.syntax());
  std::visit([&](const auto& kind) { RowWriter(program, fields).add_all(kind); }, light);
  return program.structure("light", name_in(program.syntax(), names), fields, names.c);
}

void add_projection(Fields& fields, const Camera& camera) {
  fields.add_enum("projection", "projection", camera.projection, Camera{}.projection);
}

std::string camera_value(Program& program, const Camera& camera) {
  Fields fields(program.syntax());
  RowWriter(program, fields).add_all(camera);
  return program.structure("camera", "Camera", fields);
}

std::string background_value(Program& program, const Background& background) {
  const Syntax& syntax = program.syntax();
  Fields fields(syntax);
  RowWriter writer(program, fields);
  const auto add_type = [&](std::string_view type) {
    fields.add_text("", "type", syntax.enumerator("BackgroundType", "CRT_BACKGROUND", type));
  };
  if (const auto* solid = std::get_if<SolidBackground>(&background)) {
    writer.add_all(*solid);
  } else if (const auto* gradient = std::get_if<GradientBackground>(&background)) {
    add_type("gradient");
    // In C the colours have no defaults.
    constexpr Color none{-1, -1, -1, -1};
    writer.add_all(*gradient, {.horizon = none, .sky = none});
  } else {
    const auto& panorama = std::get<PanoramaBackground>(background);
    add_type(schema::choices<PanoramaProjection>.names.at(schema::place_of(panorama.projection)));
    writer.add_all(panorama);
  }
  const std::string name = std::visit(
      []<class Kind>(const Kind&) { return std::string(schema::table<Kind>.name); }, background);
  return program.structure("background", syntax.is_cpp() ? name : "Background", fields);
}

Fields settings_fields(Program& program, const Settings& settings) {
  Fields fields(program.syntax());
  RowWriter(program, fields).add_all(settings);
  return fields;
}

}  // namespace crt::source
