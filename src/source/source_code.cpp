#include "crt/source_code.hpp"

#include "crt/file.hpp"
#include "source/entities.hpp"
#include "source/templates.hpp"
#include "source/values.hpp"
#include "text/format.hpp"

namespace crt {

namespace {

using source::EntityWriter;
using source::Program;
using source::Syntax;

/// A Function is what the code of a function is put around.
struct Function {
  const char* type;  ///< "Scene"
  const char* name;  ///< "make_scene"
  std::string result;
};

/// Puts blanks before each line.
std::string indented(const std::string& lines) {
  std::string result;
  bool begins = true;
  for (const char c : lines) {
    if (begins && c != '\n') result += "    ";
    begins = c == '\n';
    result += c;
  }
  return result;
}

std::string begin_of(const Syntax& syntax, const Program& program, bool is_alone) {
  if (syntax.is_script()) return "";
  if (syntax.is_cpp()) return source::cpp_begin;
  if (syntax.is_python()) return is_alone ? "import crt\n\n\n" : source::python_begin;
  const bool sets = program.lines().find("  set(") != std::string::npos;
  return std::string(source::c_begin) + (sets ? source::c_set : "");
}

std::string function_text(const Program& program, const Function& function) {
  const Syntax& syntax = program.syntax();
  if (syntax.is_script()) {
    return text::format("{} = Macro () {{\n{}    return {}\n}}\n", function.name,
                        indented(program.lines()), function.result);
  }
  const std::string arrays = program.arrays().empty() ? std::string() : program.arrays() + "\n";
  if (syntax.is_python()) {
    return text::format("def {}():\n{}    return {}\n", function.name, program.lines(),
                        function.result);
  }
  const std::string head =
      syntax.is_cpp() ? text::format("{} {}() {{\n", function.type, function.name)
                      : text::format("static {}* {}(void) {{\n", function.type, function.name);
  return arrays + head + program.lines() + program.releases(function.result) +
         text::format("  return {};\n}}\n", function.result);
}

/// Adds a thing to the scene in each language.
void add_to_scene(Program& program, const char* list, const char* kind, const std::string& value) {
  const Syntax& syntax = program.syntax();
  if (syntax.is_cpp()) {
    program.add_line(text::format("scene.{}.push_back({});", list, value));
  } else if (syntax.is_python()) {
    program.add_line(text::format("scene.add({})", value));
  } else {
    program.add_line(text::format("check(crt_scene_add_{}(scene, {}));", kind, value));
  }
}

void set_in_scene(Program& program, const char* kind, const std::string& value) {
  const Syntax& syntax = program.syntax();
  program.add_line(syntax.is_c()
                       ? text::format("check(crt_scene_set_{}(scene, &{}));", kind, value)
                       : text::format("scene.{} = {}{}", kind, value, syntax.is_cpp() ? ";" : ""));
}

void write_scene(Program& program, const Scene& scene) {
  const Syntax& syntax = program.syntax();
  if (syntax.is_c()) {
    program.add_line("crt_scene* scene = NULL;");
    program.add_line("check(crt_scene_create(&scene));");
  } else {
    program.add_line(syntax.is_cpp() ? "Scene scene;" : "scene = crt.Scene()");
  }
  EntityWriter writer(program);
  for (const Entity& entity : scene.entities) writer.count(entity);
  for (const Entity& entity : scene.entities)
    add_to_scene(program, "entities", "entity", writer.write(entity));
  for (const Light& light : scene.lights) {
    const std::string value = source::light_value(program, light);
    add_to_scene(program, "lights", "light", syntax.is_c() ? "&" + value : value);
  }
  set_in_scene(program, "camera", source::camera_value(program, scene.camera));
  set_in_scene(program, "background", source::background_value(program, scene.background));
  set_in_scene(
      program, "settings",
      program.structure("settings", "Settings", source::settings_fields(program, scene.settings)));
}

/// Writes the statements of a script: what is made, then Settings and Scene.
void write_script(Program& program, const Scene& scene) {
  if (scene.settings.compat != 0) program.set_is_of_2015();
  EntityWriter writer(program);
  for (const Entity& entity : scene.entities) writer.count(entity);
  std::string entities;
  for (const Entity& entity : scene.entities) entities += writer.write(entity) + "\n";
  source::Fields fields = source::settings_fields(program, scene.settings);
  source::add_projection(fields, scene.camera);
  fields.add_text("camera", "", source::camera_value(program, scene.camera));
  std::string lights;
  for (const Light& light : scene.lights)
    lights += (lights.empty() ? "\n        " : ",\n        ") + source::light_value(program, light);
  if (!lights.empty()) fields.add_text("lights", "", "[" + lights + "\n    ]");
  fields.add_text("background", "", source::background_value(program, scene.background));
  std::string settings;
  for (const std::string& setting : fields.assignments()) settings += "    " + setting + "\n";
  const char* const gap = program.lines().empty() ? "" : "\n";
  program.add_block(gap + ("Settings {\n" + source::wrapped(settings, 12) + "}\n"));
  program.add_block("\nScene {\n" + source::wrapped(indented(entities), 8) + "}\n");
}

const char* main_of(const Syntax& syntax) {
  return syntax.is_cpp()      ? source::cpp_main
         : syntax.is_python() ? source::python_main
                              : source::c_main;
}

}  // namespace

SourceCode source_code(const Scene& scene, const SourceOptions& options) {
  Program program(options);
  if (program.syntax().is_script()) {
    write_script(program, scene);
    return {program.lines(), program.warnings(), program.files()};
  }
  write_scene(program, scene);
  const Syntax& syntax = program.syntax();
  const Function function{syntax.is_c() ? "crt_scene" : "Scene", "make_scene", "scene"};
  return {begin_of(syntax, program, false) + function_text(program, function) + main_of(syntax),
          program.warnings(),
          {}};
}

SourceCode source_code(const Entity& entity, const SourceOptions& options) {
  Program program(options);
  EntityWriter writer(program);
  writer.count(entity);
  const std::string result = writer.write(entity);
  const Syntax& syntax = program.syntax();
  const Function function{syntax.is_c() ? "crt_entity" : "Entity", "make_entity", result};
  return {begin_of(syntax, program, true) + function_text(program, function), program.warnings(),
          program.files()};
}

void write_source_code(const SourceCode& code, const std::filesystem::path& path) {
  for (const SourceFile& file : code.files)
    write_file(path.parent_path() / file.name, std::span<const std::byte>(file.content));
  write_file(path, code.text);
}

std::vector<std::string> save_script(const Scene& scene, const std::filesystem::path& path) {
  constexpr std::size_t most_bytes = std::size_t{64} << 20;
  const SourceCode code = source_code(
      scene,
      {.language = SourceLanguage::script, .most_bytes = most_bytes, .name = path.stem().string()});
  write_source_code(code, path);
  return code.warnings;
}

}  // namespace crt
