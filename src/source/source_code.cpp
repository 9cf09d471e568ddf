#include "crt/source_code.hpp"

#include <fmt/format.h>

#include "source/entities.hpp"
#include "source/values.hpp"

namespace crt {

namespace {

using source::EntityWriter;
using source::Program;
using source::Syntax;

constexpr const char* cpp_begin = R"(#include <array>
#include <crt/crt.hpp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <memory>
#include <span>
#include <vector>

using namespace crt;

)";

constexpr const char* cpp_main = R"(
int main(int argc, char** argv) try {
  render(prepare(make_scene())).write(argc > 1 ? argv[1] : "picture.png", {.reproducible = true});
  return 0;
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
)";

constexpr const char* python_begin = R"(import sys

import crt


)";

constexpr const char* python_main = R"(

if __name__ == "__main__":
    make_scene().render().save(sys.argv[1] if len(sys.argv) > 1 else "picture.png", reproducible=True)
)";

constexpr const char* c_begin = R"(#include <crt/crt.h>
#include <stdio.h>
#include <stdlib.h>

/* Ends the program if something has failed. */
static void check(crt_status status) {
  if (status == CRT_OK) return;
  fprintf(stderr, "%s\n", crt_error_message());
  exit(1);
}

)";

constexpr const char* c_set = R"(static void set(double* vector, double x, double y, double z) {
  vector[0] = x;
  vector[1] = y;
  vector[2] = z;
}

)";

constexpr const char* c_main = R"(
int main(int argc, char** argv) {
  crt_scene* scene = make_scene();
  crt_prepared* prepared = NULL;
  check(crt_scene_prepare(scene, &prepared));
  crt_image* image = NULL;
  check(crt_render(prepared, NULL, &image));
  crt_write_options options;
  check(crt_write_options_init(&options, sizeof options));
  options.reproducible = 1;
  check(crt_image_write_with(image, argc > 1 ? argv[1] : "picture.png", &options));
  crt_image_release(image);
  crt_prepared_release(prepared);
  crt_scene_release(scene);
  return 0;
}
)";

/// A Function is what the code of a function is put around.
struct Function {
  const char* type;  ///< "Scene"
  const char* name;  ///< "make_scene"
  std::string result;
};

std::string begin_of(const Syntax& syntax, const Program& program, bool is_alone) {
  if (syntax.is_cpp()) return cpp_begin;
  if (syntax.is_python()) return is_alone ? "import crt\n\n\n" : python_begin;
  const bool sets = program.lines().find("  set(") != std::string::npos;
  return std::string(c_begin) + (sets ? c_set : "");
}

std::string function_text(const Program& program, const Function& function) {
  const Syntax& syntax = program.syntax();
  const std::string arrays = program.arrays().empty() ? std::string() : program.arrays() + "\n";
  if (syntax.is_python()) {
    return fmt::format("def {}():\n{}    return {}\n", function.name, program.lines(),
                       function.result);
  }
  const std::string head =
      syntax.is_cpp() ? fmt::format("{} {}() {{\n", function.type, function.name)
                      : fmt::format("static {}* {}(void) {{\n", function.type, function.name);
  return arrays + head + program.lines() + program.releases(function.result) +
         fmt::format("  return {};\n}}\n", function.result);
}

/// Adds a thing to the scene in each language.
void add_to_scene(Program& program, const char* list, const char* kind, const std::string& value) {
  const Syntax& syntax = program.syntax();
  if (syntax.is_cpp()) {
    program.add_line(fmt::format("scene.{}.push_back({});", list, value));
  } else if (syntax.is_python()) {
    program.add_line(fmt::format("scene.add({})", value));
  } else {
    program.add_line(fmt::format("check(crt_scene_add_{}(scene, {}));", kind, value));
  }
}

void set_in_scene(Program& program, const char* kind, const std::string& value) {
  const Syntax& syntax = program.syntax();
  program.add_line(syntax.is_c()
                       ? fmt::format("check(crt_scene_set_{}(scene, &{}));", kind, value)
                       : fmt::format("scene.{} = {}{}", kind, value, syntax.is_cpp() ? ";" : ""));
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
  set_in_scene(program, "settings", source::settings_value(program, scene.settings));
}

const char* main_of(const Syntax& syntax) {
  return syntax.is_cpp() ? cpp_main : syntax.is_python() ? python_main : c_main;
}

}  // namespace

SourceCode source_code(const Scene& scene, const SourceOptions& options) {
  Program program(options);
  write_scene(program, scene);
  const Syntax& syntax = program.syntax();
  const Function function{syntax.is_c() ? "crt_scene" : "Scene", "make_scene", "scene"};
  return {begin_of(syntax, program, false) + function_text(program, function) + main_of(syntax),
          program.warnings()};
}

SourceCode source_code(const Entity& entity, const SourceOptions& options) {
  Program program(options);
  EntityWriter writer(program);
  writer.count(entity);
  const std::string result = writer.write(entity);
  const Syntax& syntax = program.syntax();
  const Function function{syntax.is_c() ? "crt_entity" : "Entity", "make_entity", result};
  return {begin_of(syntax, program, true) + function_text(program, function), program.warnings()};
}

}  // namespace crt
