// These tests run scripts through the C interface: options, callbacks, diagnostics.
#include <cstring>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "support.hpp"
#include "support/temporary_directory.hpp"

using namespace crt::test;

namespace {

struct Ran {
  crt_status status = CRT_OK;
  DiagnosticsHandle diagnostics;
  SceneHandle scene;
};

Ran run(const std::string& text, const crt_script_options* options = nullptr) {
  crt_diagnostics* diagnostics = nullptr;
  crt_scene* scene = nullptr;
  Ran ran;
  ran.status = crt_scene_from_script(text.data(), text.size(), "dir/test.crt", options,
                                     &diagnostics, &scene);
  ran.diagnostics.reset(diagnostics);
  ran.scene.reset(scene);
  CHECK((scene != nullptr) == (ran.status == CRT_OK));
  return ran;
}

crt_script_options options() {
  crt_script_options result;
  REQUIRE(crt_script_options_init(&result, sizeof result) == CRT_OK);
  return result;
}

crt_diagnostic diagnostic(const Ran& ran, std::size_t index) {
  crt_diagnostic result;
  result.struct_size = sizeof result;
  REQUIRE(crt_diagnostics_get(ran.diagnostics.get(), index, &result) == CRT_OK);
  return result;
}

}  // namespace

TEST_CASE("a script makes a scene that C can go on with") {
  const Ran ran =
      run("Settings { width -> 20 height -> 10 title -> \"A\" }\nScene { Sphere { center -> "
          "vec3(0, 0, 0) "
          "radius -> 2.0 } }\n");
  INFO(crt_diagnostics_text(ran.diagnostics.get()));
  REQUIRE(ran.status == CRT_OK);
  CHECK(crt_diagnostics_count(ran.diagnostics.get()) == 0);
  CHECK(crt_scene_entity_count(ran.scene.get()) == 1);
  crt_settings settings;
  settings.struct_size = sizeof settings;
  REQUIRE(crt_scene_get_settings(ran.scene.get(), &settings) == CRT_OK);
  CHECK(settings.width == 20);
  CHECK(std::string(settings.title) == "A");
  const PreparedHandle prepared = prepare(ran.scene.get());
  CHECK(crt_image_height(render(prepared.get()).get()) == 10);
}

TEST_CASE("a wrong script tells where, with the line, and through whom") {
  const Ran ran =
      run("f = Macro (r) { Sphere { center -> vec3(0, 0, 0) radius -> r } }\nScene { f(2.0)\n  "
          "f(-3.0) }\n");
  CHECK(ran.status == CRT_ERROR_SCRIPT);
  REQUIRE(crt_diagnostics_count(ran.diagnostics.get()) == 1);
  const crt_diagnostic what = diagnostic(ran, 0);
  CHECK(what.severity == CRT_SEVERITY_ERROR);
  CHECK(what.status == CRT_ERROR_SCRIPT);
  CHECK(std::string(what.file) == "dir/test.crt");
  CHECK(what.line == 1);
  CHECK(what.column > 1);
  CHECK(what.length > 0);
  CHECK(std::string(what.source_line) ==
        "f = Macro (r) { Sphere { center -> vec3(0, 0, 0) radius -> r } }");
  CHECK(std::string(what.message).find("radius") != std::string::npos);
  REQUIRE(what.call_count == 1);
  crt_diagnostic_call call;
  call.struct_size = sizeof call;
  REQUIRE(crt_diagnostics_get_call(ran.diagnostics.get(), 0, 0, &call) == CRT_OK);
  CHECK(std::string(call.name) == "f");
  CHECK(call.line == 3);
  CHECK(call.column == 3);
  CHECK(crt_diagnostics_get_call(ran.diagnostics.get(), 0, 1, &call) == CRT_ERROR_INVALID_ARGUMENT);
  crt_diagnostic beyond = what;
  CHECK(crt_diagnostics_get(ran.diagnostics.get(), 1, &beyond) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(run("Scene {").status == CRT_ERROR_SCRIPT);
  CHECK(says("dir/test.crt:1:"));
  const std::string text = crt_diagnostics_text(ran.diagnostics.get());
  CHECK(text.find("^") != std::string::npos);
  CHECK(std::string(crt_diagnostics_json(ran.diagnostics.get())).front() == '[');
}

TEST_CASE("without a place for diagnostics the message alone says what is wrong") {
  crt_scene* scene = nullptr;
  CHECK(crt_scene_from_script("Scene { Spheer { } }", 20, "x.crt", nullptr, nullptr, &scene) ==
        CRT_ERROR_SCRIPT);
  CHECK(says("x.crt:1:9"));
  CHECK(says("Sphere"));
  CHECK(scene == nullptr);
}

TEST_CASE("the first error decides the status") {
  CHECK(run("i = 0\nwhile (true) { i = i + 1 }\nScene { }").status == CRT_ERROR_LIMIT);
  crt_script_options few = options();
  few.max_steps = 10;
  CHECK(run("for (i in range(100)) { x = i }\nScene { }", &few).status == CRT_ERROR_LIMIT);
  crt_scene* scene = nullptr;
  CHECK(crt_scene_from_script_file("no/such/file.crt", nullptr, nullptr, &scene) == CRT_ERROR_IO);
  CHECK(says("no/such/file.crt"));
}

TEST_CASE("the pictures of a script have a limit in pixels") {
  crt_script_options few = options();
  few.max_image_pixels = 8;
  const char* const field =
      "row = [0, 0.5, 1]\nScene { HeightField { heights -> [row, row, row] "
      "cornerA -> vec3(0, 0, 0) cornerB -> vec3(1, 1, 1) } }";
  CHECK(run(field, &few).status == CRT_ERROR_LIMIT);
  few.max_image_pixels = 9;
  CHECK(run(field, &few).status == CRT_OK);
}

TEST_CASE("variables, settings and t come from outside") {
  crt_script_options given = options();
  const char* const names[] = {"n", "name"};
  const char* const values[] = {"3", "\"x\""};
  given.variable_names = names;
  given.variable_values = values;
  given.variable_count = 2;
  const char* const setting_names[] = {"width"};
  const char* const setting_values[] = {"33"};
  given.setting_names = setting_names;
  given.setting_values = setting_values;
  given.setting_count = 1;
  given.t = 4;
  const Ran ran =
      run("n = 1\nname = \"y\"\nSettings { width -> 7 }\n"
          "Scene { for (i in range(n)) { Sphere { center -> vec3(i * 3, t, 0) radius -> 1 } } }",
          &given);
  INFO(crt_diagnostics_text(ran.diagnostics.get()));
  REQUIRE(ran.status == CRT_OK);
  CHECK(crt_scene_entity_count(ran.scene.get()) == 3);
  crt_settings settings;
  settings.struct_size = sizeof settings;
  REQUIRE(crt_scene_get_settings(ran.scene.get(), &settings) == CRT_OK);
  CHECK(settings.width == 33);
  const PreparedHandle prepared = prepare(ran.scene.get());
  const crt_ray ray = {{6, 0, 0}, {0, 1, 0}, 0, infinity};
  crt_hit hit;
  REQUIRE(crt_intersect(prepared.get(), &ray, 0, 1, &hit, 0) == CRT_OK);
  CHECK(hit.t == doctest::Approx(3));
  given.variable_values = nullptr;
  CHECK(run("Scene { }", &given).status == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("variable_values"));
}

TEST_CASE("what a script prints goes to the callback, which may cancel it") {
  std::vector<std::string> lines;
  crt_script_options given = options();
  given.print = [](const char* line, std::size_t length, void* user) {
    CHECK(std::strlen(line) == length);
    auto* const all = static_cast<std::vector<std::string>*>(user);
    all->emplace_back(line, length);
    return all->size() == 3 ? 21 : 0;
  };
  given.print_user = &lines;
  CHECK(run("print(1)\nprint(\"zwei\")\nScene { }", &given).status == CRT_OK);
  CHECK(lines == std::vector<std::string>{"1", "zwei"});
  CHECK(run("print(3)\nprint(4)\nScene { }", &given).status == CRT_ERROR_CANCELLED);
  CHECK(crt_cancel_value() == 21);
  CHECK(lines.size() == 3);
}

TEST_CASE("a script can be stopped while it runs") {
  int rounds = 0;
  crt_script_options given = options();
  given.poll = [](void* user) { return ++*static_cast<int*>(user) > 5 ? 8 : 0; };
  given.poll_user = &rounds;
  const Ran ran = run("i = 0\nwhile (true) { i = i + 1 }\nScene { }", &given);
  CHECK(ran.status == CRT_ERROR_CANCELLED);
  CHECK(crt_cancel_value() == 8);
  CHECK(rounds == 6);
  REQUIRE(crt_diagnostics_count(ran.diagnostics.get()) == 1);
  CHECK(diagnostic(ran, 0).status == CRT_ERROR_CANCELLED);
}

TEST_CASE("files come from the caller first; a number that is none of the answers cancels") {
  using Files = std::map<std::string, std::string>;
  Files files = {{"dir/parts.crt", "r = 2.5\n"}};
  crt_script_options given = options();
  given.open_file = [](const char* path, crt_file_content* content, void* user) -> int {
    const auto& all = *static_cast<const Files*>(user);
    const auto found = all.find(path);
    if (std::strcmp(path, "dir/stop.crt") == 0) return 77;
    if (found == all.end()) return CRT_FILE_NOT_GIVEN;
    // The content is appended in pieces, as a file is read.
    for (const char& c : found->second) {
      if (crt_file_content_append(content, &c, 1) != CRT_OK) return 99;
    }
    return CRT_FILE_GIVEN;
  };
  given.open_file_user = &files;
  const Ran ran =
      run("import \"parts.crt\"\nScene { Sphere { center -> vec3(0, 0, 0) radius -> r } }", &given);
  INFO(crt_diagnostics_text(ran.diagnostics.get()));
  REQUIRE(ran.status == CRT_OK);
  const PreparedHandle prepared = prepare(ran.scene.get());
  const crt_ray ray = {{0, 0, 0}, {0, 1, 0}, 0, infinity};
  crt_hit hit;
  REQUIRE(crt_intersect(prepared.get(), &ray, 0, 1, &hit, 0) == CRT_OK);
  CHECK(hit.t == doctest::Approx(2.5));
  CHECK(run("import \"none.crt\"\nScene { }", &given).status == CRT_ERROR_IO);
  CHECK(run("import \"stop.crt\"\nScene { }", &given).status == CRT_ERROR_CANCELLED);
  CHECK(crt_cancel_value() == 77);
}

TEST_CASE("a script sees no files outside its directory unless it may") {
  crt_script_options given = options();
  const std::string text = "import \"../../etc/passwd\"\nScene { }";
  CHECK(run(text, &given).status == CRT_ERROR_IO);
  CHECK(says("outside"));
  given.allow_outside_files = 1;
  CHECK(run(text, &given).status != CRT_OK);
  CHECK_FALSE(says("outside"));
  const char* const folders[] = {nullptr};
  given.resource_directories = folders;
  given.resource_directory_count = 1;
  CHECK(run(text, &given).status == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("resource_directories"));
}

TEST_CASE("a mesh file becomes an entity, and a broken one is an error with its line") {
  const TemporaryDirectory folder;
  const std::string good = (folder / "good.off").string();
  const std::string broken = (folder / "broken.off").string();
  std::ofstream(good) << "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  std::ofstream(broken) << "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n";
  crt_entity* entity = nullptr;
  CHECK(crt_mesh_load(broken.c_str(), nullptr, &entity) == CRT_ERROR_IO);
  CHECK(says("line 6: a corner is '3'"));
  CHECK(crt_mesh_load("none.off", nullptr, &entity) == CRT_ERROR_IO);
  CHECK(entity == nullptr);
  const EntityHandle mesh = made<EntityHandle>(
      [&](crt_entity** out) { return crt_mesh_load(good.c_str(), nullptr, out); });

  // With options, files are found as those of scripts are.
  crt_script_options given = options();
  CHECK(crt_mesh_load(good.c_str(), &given, &entity) == CRT_ERROR_IO);
  CHECK(says("a leading '/' means a resource directory"));
  const std::string directory = folder.path().string();
  const char* const directories[] = {directory.c_str()};
  given.resource_directories = directories;
  given.resource_directory_count = 1;
  made<EntityHandle>([&](crt_entity** out) { return crt_mesh_load("good.off", &given, out); });
  CHECK(crt_mesh_load("../good.off", &given, &entity) == CRT_ERROR_IO);
  CHECK(says("lies outside the directories"));
}
