#include "source/values.hpp"

#include <variant>

#include "crt/schema_materials.hpp"
#include "crt/schema_scene.hpp"
#include "crt/schema_settings.hpp"
#include "source/row_writer.hpp"

namespace crt::source {

namespace {

/// Names a material that is known by its address. Materials of the same values are one.
template <class Kind>
std::string name_of_material(Program& program, const Kind& material) {
  if (std::string known = program.known(&material); !known.empty()) return known;
  const std::string type(schema::table<Kind>.name);
  Fields fields(program.syntax());
  RowWriter(program, fields).add_all(material);
  const std::string content = fields.constructed(type);
  std::string name = program.known_value(content);
  if (name.empty()) {
    const bool is_principled = std::is_same_v<Kind, PrincipledMaterial>;
    name = program.syntax().is_c()
               ? program.structure(is_principled ? "principled" : "material", type, fields)
               : program.define("material", "SharedMaterial", content);
    program.remember_value(content, name);
  }
  return program.remember(&material, name);
}

}  // namespace

std::string material_name(Program& program, const SharedMaterial& shared) {
  if (const PrincipledMaterial* principled = shared.principled())
    return name_of_material(program, *principled);
  return name_of_material(program, *shared);
}

std::string light_value(Program& program, const Light& light) {
  return std::visit([&](const auto& kind) { return light_of_kind(program, kind); }, light);
}

void add_projection(Fields& fields, const Camera& camera) {
  fields.add_enum("projection", "projection", camera.projection, Camera{}.projection);
}

std::string camera_value(Program& program, const Camera& camera) {
  Fields fields(program.syntax());
  // A script that says both is wrong.
  RowWriter(program, fields).add_all(camera, {}, camera.lens_radius > 0 ? "aperture" : "");
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
  } else if (const auto* sky = std::get_if<SkyBackground>(&background)) {
    add_type("sky");
    writer.add_all(*sky);
    if (syntax.is_script()) return program.structure("background", "Sky", fields);
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
  // Only in scripts do other settings depend on this one.
  const bool is_script_of_2015 = program.syntax().is_script() && settings.compat == compat_2015;
  Settings usual = is_script_of_2015 ? settings_of_2015() : Settings{};
  usual.compat = 0;
  Fields fields(program.syntax());
  RowWriter(program, fields).add_all(settings, usual);
  return fields;
}

}  // namespace crt::source
