#include "source/values.hpp"

#include <cstdint>
#include <limits>
#include <type_traits>

#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::source {

namespace {

constexpr const char* projections[] = {"pinhole", "spherical", "cylindrical", "orthographic"};
constexpr const char* aperture_shapes[] = {"circle",   "uniform", "gaussian", "triangle", "square",
                                           "pentagon", "hexagon", "octagon",  "line"};
constexpr const char* mappings[] = {"uv", "planar", "cylindrical", "cubic"};
constexpr const char* panorama_projections[] = {"spherical", "cylindrical", "equal_area"};
constexpr const char* filters[] = {"box", "blackman_harris"};
constexpr const char* falloff_models[] = {"path", "light"};
constexpr const char* ambient_models[] = {"light", "surface"};
constexpr const char* precisions[] = {"standard", "exact"};

/// Names the kinds of patterns and lights in the three languages, in the order of the variants.
struct KindName {
  const char* cpp;
  const char* python;
  const char* c;
};
constexpr KindName pattern_kinds[] = {
    {"Checker", "Pattern.checker", "CRT_PATTERN_CHECKER"},
    {"Stripes", "Pattern.stripes", "CRT_PATTERN_STRIPES"},
    {"Gradient", "Pattern.gradient", "CRT_PATTERN_GRADIENT"},
    {"Noise", "Pattern.noise", "CRT_PATTERN_NOISE"},
    {"Marble", "Pattern.marble", "CRT_PATTERN_MARBLE"},
    {"Wood", "Pattern.wood", "CRT_PATTERN_WOOD"},
    {"ImageMap", "Pattern.of_image", "CRT_PATTERN_IMAGE"},
};
constexpr KindName light_kinds[] = {
    {"PointLight", "Light.point", "CRT_LIGHT_POINT"},
    {"ParallelLight", "Light.parallel", "CRT_LIGHT_PARALLEL"},
    {"SpotLight", "Light.spot", "CRT_LIGHT_SPOT"},
    {"CylinderLight", "Light.cylinder", "CRT_LIGHT_CYLINDER"},
};

const char* name_of(const Syntax& syntax, const KindName& kind) {
  return syntax.is_python() ? kind.python : kind.cpp;
}

void add_angle(Fields& fields, Program& program, const char* name, double value, double usual) {
  if (value != usual) fields.add_text(name, name, program.angle(value));
}

std::string pattern_value(Program& program, const Pattern& pattern);

/// Returns what a field has that holds a pattern: its value, or its address in C.
std::string pattern_in_field(Program& program, const Pattern& pattern) {
  const std::string value = pattern_value(program, pattern);
  return program.syntax().is_c() ? "&" + value : value;
}

class PatternFields {
 public:
  explicit PatternFields(Program& program) : program_(program), fields_(program.syntax()) {}

  template <class Kind>
  Fields of(const Kind& pattern) {
    const Kind usual{};
    if constexpr (std::is_same_v<Kind, ImageMap>) {
      add_image(pattern, usual);
    } else {
      // In a script a pattern stands in the place of a colour.
      const bool is_script = program_.syntax().is_script();
      if (!is_script || !pattern.pattern_a)
        fields_.add("color_a", "color_a", "alpha_a", pattern.color_a, usual.color_a);
      if (!is_script || !pattern.pattern_b)
        fields_.add("color_b", "color_b", "alpha_b", pattern.color_b, usual.color_b);
      add_shape(pattern, usual);
      fields_.add("scale", "scale", pattern.scale, usual.scale);
      fields_.add("offset", "offset", pattern.offset, usual.offset);
      add_nested(is_script ? "color_a" : "pattern_a", pattern.pattern_a);
      add_nested(is_script ? "color_b" : "pattern_b", pattern.pattern_b);
      if constexpr (requires { pattern.colors; }) add_colors(pattern.colors);
    }
    return fields_;
  }

 private:
  template <class Kind>
  void add_shape(const Kind& pattern, const Kind& usual) {
    if constexpr (requires { pattern.direction; })
      fields_.add("direction", "direction", pattern.direction, usual.direction);
    if constexpr (requires { pattern.turbulence; })
      fields_.add("turbulence", "turbulence", pattern.turbulence, usual.turbulence);
    if constexpr (requires { pattern.octaves; })
      fields_.add("octaves", "octaves", pattern.octaves, usual.octaves);
  }

  void add_image(const ImageMap& map, const ImageMap& usual) {
    fields_.add_text("image", "image", image_name(program_, map.image));
    fields_.add("repeat_u", "repeat_u", map.repeat_u, usual.repeat_u);
    fields_.add("repeat_v", "repeat_v", map.repeat_v, usual.repeat_v);
    fields_.add_enum("mapping", "mapping", "ImageMapping", "CRT_MAPPING", mappings, map.mapping,
                     usual.mapping);
    fields_.add("direction", "direction", map.direction, usual.direction);
    fields_.add("scale", "scale", map.scale, usual.scale);
    fields_.add("offset", "offset", map.offset, usual.offset);
  }

  void add_nested(const char* name, const SharedPattern& pattern) {
    if (!pattern) return;
    const std::string value = pattern_in_field(program_, pattern->pattern);
    fields_.add_text(name, name,
                     program_.syntax().is_cpp() ? text::format("nested({})", value) : value);
  }

  void add_colors(const std::vector<ColorStop>& stops) {
    if (stops.empty()) return;
    std::vector<std::string> items;
    items.reserve(stops.size());
    const Syntax& syntax = program_.syntax();
    const bool is_python = syntax.is_python();
    for (const auto& [position, color] : stops) {
      if (syntax.is_script()) {
        items.push_back(text::format("[{}, {}]", position, syntax.color(color)));
        continue;
      }
      const std::string rgb = text::format("{}, {}, {}", color.r, color.g, color.b);
      items.push_back(is_python ? text::format("({}, ({}), {})", position, rgb, color.a)
                      : syntax.is_cpp()
                          ? text::format("{{{}, {{{}, {}}}}}", position, rgb, color.a)
                          : text::format("{{{}, {{{}}}, {}}}", position, rgb, color.a));
    }
    if (!syntax.is_c()) return fields_.add_text("colors", "colors", syntax.list(items));
    fields_.add_text("", "colors", program_.array("colors", "crt_color_stop", items));
    fields_.add_text("", "color_count", std::to_string(stops.size()));
  }

  Program& program_;
  Fields fields_;
};

std::string pattern_value(Program& program, const Pattern& pattern) {
  const KindName& kind = pattern_kinds[pattern.index()];
  const Fields fields =
      std::visit([&](const auto& one) { return PatternFields(program).of(one); }, pattern);
  return program.structure("pattern", name_of(program.syntax(), kind), fields, kind.c);
}

void add_pattern(Program& program, Fields& fields, const char* cpp, const char* c,
                 const Pattern& pattern) {
  const std::string value = pattern_in_field(program, pattern);
  fields.add_text(cpp, c, program.syntax().is_cpp() ? text::format("Pattern{{{}}}", value) : value);
}

}  // namespace

std::string material_name(Program& program, const SharedMaterial& shared) {
  const Material& material = *shared;
  if (std::string known = program.known(&material); !known.empty()) return known;
  const Material usual;
  Fields fields(program.syntax());
  if (const auto* color = std::get_if<Color>(&material.color)) {
    fields.add("color", "color", "alpha", *color, std::get<Color>(usual.color));
  } else {
    add_pattern(program, fields, "color", "pattern", std::get<Pattern>(material.color));
  }
  fields.add("reflectivity", "reflectivity", material.reflectivity, usual.reflectivity);
  fields.add("transparency", "transparency", material.transparency, usual.transparency);
  fields.add("refractive_index", "refractive_index", material.refractive_index,
             usual.refractive_index);
  if (material.diffuse) fields.add_text("diffuse", "diffuse", Syntax::number(*material.diffuse));
  fields.add("specular", "specular", material.specular, usual.specular);
  fields.add("shininess", "shininess", material.shininess, usual.shininess);
  fields.add("absorption", "absorption", "", material.absorption, usual.absorption);
  if (material.bump) add_pattern(program, fields, "bump", "bump", *material.bump);
  fields.add("bump_height", "bump_height", material.bump_height, usual.bump_height);
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
  const KindName& kind = light_kinds[light.index()];
  Fields fields(program.syntax());
  std::visit(
      [&](const auto& one) {
        using Kind = std::remove_cvref_t<decltype(one)>;
        const Kind usual{};
        if constexpr (requires { one.from; }) {
          fields.add("from", "origin", one.from, fields.required(usual.from));
        } else {
          fields.add("origin", "origin", one.origin, fields.required(usual.origin));
        }
        if constexpr (requires { one.pointing; })
          fields.add("pointing", "pointing", one.pointing, fields.required(usual.pointing));
        fields.add("color", "color", "", one.color, fields.required(usual.color));
        if constexpr (requires { one.angle; }) {
          add_angle(fields, program, "angle", one.angle, usual.angle);
          add_angle(fields, program, "penumbra", one.penumbra, usual.penumbra);
        }
        if constexpr (requires { one.radius; })
          fields.add("radius", "radius", one.radius, fields.required(usual.radius));
        if constexpr (requires { one.falloff; })
          fields.add("falloff", "falloff", one.falloff, usual.falloff);
        fields.add("ambient", "ambient", one.ambient, usual.ambient);
      },
      light);
  return program.structure("light", name_of(program.syntax(), kind), fields, kind.c);
}

void add_projection(Fields& fields, const Camera& camera) {
  fields.add_enum("projection", "projection", "Projection", "CRT_PROJECTION", projections,
                  camera.projection, Camera{}.projection);
}

std::string camera_value(Program& program, const Camera& camera) {
  const Camera usual;
  Fields fields(program.syntax());
  fields.add("position", "position", camera.position, fields.required(usual.position));
  fields.add("pointing", "pointing", camera.pointing, fields.required(usual.pointing));
  add_angle(fields, program, "fov", camera.fov, usual.fov);
  add_angle(fields, program, "roll", camera.roll, usual.roll);
  if (!program.syntax().is_script()) add_projection(fields, camera);
  // Cameras of 2015 have other defaults.
  if (camera.lens_radius > 0) {
    fields.add("lens_radius", "lens_radius", camera.lens_radius, usual.lens_radius);
  } else {
    fields.add("aperture", "aperture", camera.aperture, fields.required(usual.aperture));
  }
  fields.add("focal_distance", "focal_distance", camera.focal_distance,
             fields.required(usual.focal_distance));
  fields.add_enum("aperture_shape", "aperture_shape", "ApertureShape", "CRT_APERTURE",
                  aperture_shapes, camera.aperture_shape, usual.aperture_shape);
  return program.structure("camera", "Camera", fields);
}

std::string background_value(Program& program, const Background& background) {
  const Syntax& syntax = program.syntax();
  Fields fields(syntax);
  if (const auto* solid = std::get_if<SolidBackground>(&background)) {
    fields.add("color", "color", "alpha", solid->color, SolidBackground{}.color);
    return program.structure("background", syntax.is_cpp() ? "SolidBackground" : "Background",
                             fields);
  }
  if (const auto* gradient = std::get_if<GradientBackground>(&background)) {
    constexpr Color none{-1, -1, -1, -1};  // in C the colours have no defaults
    fields.add_text("", "type", syntax.enumerator("BackgroundType", "CRT_BACKGROUND", "gradient"));
    fields.add("horizon", "horizon", "horizon_alpha", gradient->horizon, none);
    fields.add("sky", "sky", "sky_alpha", gradient->sky, none);
    return program.structure("background", syntax.is_cpp() ? "GradientBackground" : "Background",
                             fields);
  }
  const auto& panorama = std::get<PanoramaBackground>(background);
  const char* const projection =
      panorama_projections[static_cast<std::size_t>(panorama.projection)];
  fields.add_text("", "type", syntax.enumerator("BackgroundType", "CRT_BACKGROUND", projection));
  fields.add_text("image", "image", image_name(program, panorama.image));
  fields.add_enum("projection", "", "PanoramaProjection", "", panorama_projections,
                  panorama.projection, PanoramaProjection::spherical);
  fields.add("angle", "angle", panorama.angle, 0);
  return program.structure("background", syntax.is_cpp() ? "PanoramaBackground" : "Background",
                           fields);
}

Fields settings_fields(const Program& program, const Settings& settings) {
  const Syntax& syntax = program.syntax();
  // Only in scripts do other settings depend on this one.
  const bool is_script_of_2015 = syntax.is_script() && settings.compat == compat_2015;
  const Settings usual = is_script_of_2015 ? settings_of_2015() : Settings{};
  Fields fields(syntax);
  fields.add_string("title", settings.title);
  fields.add_string("author", settings.author);
  fields.add_string("date", settings.date);
  fields.add_string("notes", settings.notes);
  fields.add("width", "width", settings.width, usual.width);
  fields.add("height", "height", settings.height, usual.height);
  fields.add("gamma", "gamma", settings.gamma, usual.gamma);
  fields.add("supersampling", "supersampling", settings.supersampling, usual.supersampling);
  fields.add("dof_samples", "dof_samples", settings.dof_samples, usual.dof_samples);
  fields.add("target_error", "target_error", settings.target_error, usual.target_error);
  fields.add("time_budget", "time_budget", settings.time_budget, usual.time_budget);
  fields.add("min_samples", "min_samples", settings.min_samples, usual.min_samples);
  fields.add("max_samples", "max_samples", settings.max_samples, usual.max_samples);
  fields.add_enum("filter", "filter", "PixelFilter", "CRT_FILTER", filters, settings.filter,
                  usual.filter);
  fields.add("filter_width", "filter_width", settings.filter_width, usual.filter_width);
  fields.add("recursion_depth", "recursion_depth", settings.recursion_depth, usual.recursion_depth);
  fields.add("min_weight", "min_weight", settings.min_weight, usual.min_weight);
  fields.add_enum("falloff_model", "falloff_model", "FalloffModel", "CRT_FALLOFF", falloff_models,
                  settings.falloff_model, usual.falloff_model);
  fields.add_enum("ambient_model", "ambient_model", "AmbientModel", "CRT_AMBIENT", ambient_models,
                  settings.ambient_model, usual.ambient_model);
  fields.add_flag("head_light", "", settings.head_light, usual.head_light);
  if (!settings.head_light) fields.add_text("", "no_head_light", "1");
  if (settings.show_clip)
    fields.add_text("show_clip", "show_clip", syntax.is_python() || syntax.is_c() ? "1" : "true");
  if (syntax.is_script() && settings.seed > std::numeric_limits<std::int64_t>::max())
    throw Error(ErrorCode::unsupported, "a seed of 2^63 or more cannot be written in a script");
  if (settings.seed != usual.seed)
    fields.add_text("seed", "seed",
                    std::to_string(settings.seed) + (syntax.is_cpp() || syntax.is_c() ? "U" : ""));
  fields.add_enum("precision", "precision", "Precision", "CRT_PRECISION", precisions,
                  settings.precision, usual.precision);
  fields.add("compat", "compat", settings.compat, 0);
  return fields;
}

}  // namespace crt::source
