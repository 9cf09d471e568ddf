// These tests check which files a script may reach, and which it may not.
#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "crt/image.hpp"
#include "run.hpp"

namespace {

namespace fs = std::filesystem;

using crt::ErrorCode;
using crt::ScriptOptions;

/// A Folder is one test's own, and is removed with it.
class Folder {
 public:
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "crt_lang_XXXXXX").string();
    REQUIRE(mkdtemp(pattern.data()) != nullptr);
    path_ = fs::canonical(pattern);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }

  const fs::path& path() const { return path_; }

  fs::path write(const fs::path& name, const std::string& text) const {
    fs::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  fs::path path_;
};

/// Runs a script that lies in work/scene.crt of the folder.
crt::test::Run run_in(const Folder& folder, const std::string& statements,
                      ScriptOptions options = {}) {
  return crt::test::run(statements + "\nScene { }\n", std::move(options),
                        (folder.path() / "work" / "scene.crt").string());
}

bool refused(const crt::test::Run& run, const std::string& words) {
  if (!run.failed_with(ErrorCode::io)) return false;
  INFO(run.errors()[0].message);
  const bool found = run.errors()[0].message.find(words) != std::string::npos;
  CHECK(found);
  return found;
}

ScriptOptions with_resources(const Folder& folder) {
  ScriptOptions options;
  options.resource_directories = {folder.path() / "res"};
  return options;
}

/// Fills a folder with a script beside it, one below it, one in the resources and one outside.
void fill(const Folder& folder) {
  fs::create_directories(folder.path() / "work");
  folder.write("work/beside.crt", "where = \"beside\"\n");
  folder.write("work/sub/below.crt", "where = \"below\"\n");
  folder.write("res/lib/shared.crt", "where = \"resources\"\n");
  folder.write("outside.crt", "where = \"outside\"\n");
}

constexpr const char* then_print = "\nprint(where)";

}  // namespace

TEST_CASE("imports are found beside the script, below it, and in the resource directories") {
  const Folder folder;
  fill(folder);
  const ScriptOptions options = with_resources(folder);
  const auto prints = [&](const std::string& import) {
    return run_in(folder, "import \"" + import + "\"" + then_print, options).printed;
  };
  CHECK(prints("beside.crt") == std::vector<std::string>{"beside"});
  CHECK(prints("./beside.crt") == std::vector<std::string>{"beside"});
  CHECK(prints("sub/below.crt") == std::vector<std::string>{"below"});
  CHECK(prints("sub/../beside.crt") == std::vector<std::string>{"beside"});
  CHECK(prints("lib/shared.crt") == std::vector<std::string>{"resources"});
  CHECK(prints("/lib/shared.crt") == std::vector<std::string>{"resources"});
}

TEST_CASE("the script's own directory goes before the resource directories") {
  const Folder folder;
  fill(folder);
  folder.write("res/beside.crt", "where = \"resources\"\n");
  const ScriptOptions options = with_resources(folder);
  CHECK(run_in(folder, std::string("import \"beside.crt\"") + then_print, options).printed ==
        std::vector<std::string>{"beside"});
  CHECK(run_in(folder, std::string("import \"/beside.crt\"") + then_print, options).printed ==
        std::vector<std::string>{"resources"});
}

TEST_CASE("no path leads out of the directories unless the caller allows it") {
  const Folder folder;
  fill(folder);
  ScriptOptions options = with_resources(folder);
  const std::vector<std::string> paths = {"../outside.crt", "sub/../../outside.crt",
                                          "lib/../../outside.crt", "/../outside.crt",
                                          "/lib/../../outside.crt"};
  for (const std::string& outside_path : paths) {
    CAPTURE(outside_path);
    CHECK(refused(run_in(folder, "import \"" + outside_path + "\"", options), "outside"));
  }
  CHECK(refused(
      run_in(folder, "import \"" + (folder.path() / "outside.crt").string() + "\"", options),
      "there is no file"));
  options.allow_outside_files = true;
  for (const std::string& outside_path : paths) {
    CAPTURE(outside_path);
    CHECK(run_in(folder, "import \"" + outside_path + "\"" + then_print, options).printed ==
          std::vector<std::string>{"outside"});
  }
  CHECK(refused(run_in(folder, "import \"/etc/passwd\"", options), "there is no file"));
}

TEST_CASE("a symbolic link out is refused, one that stays within is not") {
  const Folder folder;
  fill(folder);
  fs::create_symlink(folder.path() / "outside.crt", folder.path() / "work" / "link.crt");
  fs::create_directory_symlink(folder.path(), folder.path() / "work" / "up");
  fs::create_symlink("beside.crt", folder.path() / "work" / "twin.crt");
  CHECK(refused(run_in(folder, "import \"link.crt\""), "outside"));
  CHECK(refused(run_in(folder, "import \"up/outside.crt\""), "outside"));
  CHECK(run_in(folder, std::string("import \"twin.crt\"") + then_print).printed ==
        std::vector<std::string>{"beside"});
  ScriptOptions options;
  options.allow_outside_files = true;
  CHECK(run_in(folder, std::string("import \"link.crt\"") + then_print, options).printed ==
        std::vector<std::string>{"outside"});
}

TEST_CASE("a directory whose name begins like an allowed one is another directory") {
  const Folder folder;
  fill(folder);
  folder.write("work2/near.crt", "where = \"near\"\n");
  CHECK(refused(run_in(folder, "import \"../work2/near.crt\""), "outside"));
}

TEST_CASE("only regular files are opened") {
  const Folder folder;
  fill(folder);
  REQUIRE(mkfifo((folder.path() / "work" / "fifo.crt").c_str(), 0600) == 0);
  CHECK(refused(run_in(folder, "import \"sub\""), "not a regular file"));
  CHECK(refused(run_in(folder, "import \"fifo.crt\""), "not a regular file"));
  CHECK(refused(run_in(folder, "m = ImageMap { image -> \"fifo.crt\" }"), "not a regular file"));
  CHECK(refused(run_in(folder, "import \".\""), "not a regular file"));
  const crt::ScriptResult fifo = crt::run_script_file(folder.path() / "work" / "fifo.crt");
  REQUIRE(fifo.diagnostics.size() == 1);
  CHECK(fifo.diagnostics[0].code == ErrorCode::io);
}

TEST_CASE("an unreadable or missing file is an error at its line") {
  const Folder folder;
  fill(folder);
  const crt::test::Run missing = run_in(folder, "a = 1\nimport \"nothing.crt\"");
  REQUIRE(missing.failed_with(ErrorCode::io));
  CHECK(missing.errors()[0].place.line == 2);
  CHECK(missing.errors()[0].place.column == 8);
  if (geteuid() != 0) {
    fs::permissions(folder.path() / "work" / "beside.crt", fs::perms::none);
    CHECK(refused(run_in(folder, "import \"beside.crt\""), "cannot be read"));
  }
}

TEST_CASE("imports are looked for from the script that imports, and run once") {
  const Folder folder;
  fill(folder);
  folder.write("work/a/one.crt", "print(\"one\")\nimport \"two.crt\"\nimport \"../b/three.crt\"\n");
  folder.write("work/a/two.crt", "print(\"two\")\n");
  folder.write("work/b/three.crt",
               "print(\"three\")\nimport \"../a/two.crt\"\nimport \"beside.crt\"\n");
  const crt::test::Run result =
      run_in(folder, std::string("import \"a/one.crt\"\nimport \"a/two.crt\"") + then_print);
  CHECK(result.printed == std::vector<std::string>{"one", "two", "three", "beside"});
}

TEST_CASE("a script that imports itself is an error") {
  const Folder folder;
  fill(folder);
  folder.write("work/scene.crt", "");
  CHECK(run_in(folder, "import \"scene.crt\"").errors().size() == 1);
  CHECK(run_in(folder, "import \"sub/../scene.crt\"")
            .errors()[0]
            .message.find("import one another") != std::string::npos);
}

TEST_CASE("an import brings definitions, but neither its Scene nor its Settings") {
  const Folder folder;
  folder.write(
      "work/other.crt",
      "r = 2\nSettings { width -> 7 }\nScene { Sphere { center -> vec3(0, 0, 0) radius -> r } }\n");
  const crt::test::Run result = run_in(folder, "import \"other.crt\"\nprint(r)");
  REQUIRE(result.ok());
  CHECK(result.printed == std::vector<std::string>{"2"});
  CHECK(result.result.scene->entities.empty());
  CHECK(result.result.scene->settings.width == 640);
}

TEST_CASE("open_file is asked for each place before the file system is") {
  const Folder folder;
  fill(folder);
  ScriptOptions options = with_resources(folder);
  std::vector<fs::path> asked;
  options.open_file = [&asked](const fs::path& path) -> std::optional<std::vector<std::byte>> {
    asked.push_back(path);
    if (path.filename() != "virtual.crt") return std::nullopt;
    std::vector<std::byte> content;
    for (const char c : std::string("where = \"memory\"\n"))
      content.push_back(static_cast<std::byte>(c));
    return content;
  };
  CHECK(run_in(folder, std::string("import \"virtual.crt\"") + then_print, options).printed ==
        std::vector<std::string>{"memory"});
  CHECK(asked == std::vector<fs::path>{folder.path() / "work" / "virtual.crt"});
  asked.clear();
  CHECK(run_in(folder, std::string("import \"lib/shared.crt\"") + then_print, options).printed ==
        std::vector<std::string>{"resources"});
  CHECK(asked == std::vector<fs::path>{folder.path() / "work" / "lib" / "shared.crt",
                                       folder.path() / "res" / "lib" / "shared.crt"});
  asked.clear();
  CHECK(refused(run_in(folder, "import \"../virtual.crt\"", options), "outside"));
  CHECK(asked == std::vector<fs::path>{});
}

TEST_CASE("an image is read once a run, wherever it is used") {
  const Folder folder;
  crt::Image image(2, 2);
  image.set(0, 0, {1, 0, 0, 1});
  fs::create_directories(folder.path() / "work");
  image.write(folder.path() / "work" / "picture.png");
  const crt::test::Run result = run_in(folder, R"(
for (i in range(3)) {
    map = ImageMap { image -> "picture.png" repeatU -> 2 }
    sky = Background { image -> "./picture.png" angle -> 1.5 projection -> "cylindrical" }
}
Settings {
    background -> Background { image -> "picture.png" angle -> 1.5 projection -> "cylindrical" }
}
)");
  REQUIRE(result.ok());
  const auto* panorama = std::get_if<crt::PanoramaBackground>(&result.result.scene->background);
  REQUIRE(panorama != nullptr);
  CHECK(panorama->angle == 1.5);
  CHECK(panorama->projection == crt::PanoramaProjection::cylindrical);
  CHECK(panorama->image->width() == 2);
  // The cache of the run is gone, and only the scene holds the picture.
  CHECK(panorama->image.use_count() == 1);
}

TEST_CASE("an image can come from open_file") {
  const Folder folder;
  const fs::path file = folder.path() / "picture.png";
  crt::Image(3, 1).write(file);
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)),
                          std::istreambuf_iterator<char>());
  ScriptOptions options;
  options.open_file = [&bytes](const fs::path& path) -> std::optional<std::vector<std::byte>> {
    if (path != "folder/there.png") return std::nullopt;
    const auto* begin = reinterpret_cast<const std::byte*>(bytes.data());
    return std::vector<std::byte>(begin, begin + bytes.size());
  };
  const crt::test::Run result =
      crt::test::run("Settings { background -> Background { image -> \"there.png\" } }\nScene { }",
                     options, "folder/scene.crt");
  REQUIRE(result.ok());
  CHECK(std::get<crt::PanoramaBackground>(result.result.scene->background).image->width() == 3);
}

TEST_CASE("a mesh is read once a run, and can come from open_file") {
  const Folder folder;
  folder.write("work/one.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const std::string two_meshes =
      "Scene { Mesh { file -> \"one.off\" } Mesh { file -> \"./one.off\" } }";
  const fs::path script = folder.write("work/scene.crt", two_meshes);
  const crt::ScriptResult result = crt::run_script_file(script);
  REQUIRE(result.scene);
  const std::vector<crt::Entity>& entities = result.scene->entities;
  REQUIRE(entities.size() == 2);
  CHECK(entities[0].shared_node() == entities[1].shared_node());

  ScriptOptions options;
  options.open_file = [](const fs::path& path) -> std::optional<std::vector<std::byte>> {
    if (path != "folder/there.obj") return std::nullopt;
    const std::string bytes = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const auto* begin = reinterpret_cast<const std::byte*>(bytes.data());
    return std::vector<std::byte>(begin, begin + bytes.size());
  };
  CHECK(
      crt::test::run("Scene { Mesh { file -> \"there.obj\" } }", options, "folder/scene.crt").ok());
  CHECK(crt::load_mesh("folder/there.obj", options).primitive_count() > 0);
  CHECK_THROWS_AS(crt::load_mesh("folder/none.obj", options), crt::Error);
}

TEST_CASE("a script file that is missing is a diagnostic of its own") {
  const crt::ScriptResult result = crt::run_script_file("no/such/script.crt");
  CHECK_FALSE(result.scene);
  REQUIRE(result.diagnostics.size() == 1);
  CHECK(result.diagnostics[0].code == ErrorCode::io);
  CHECK(result.diagnostics[0].place.file == "no/such/script.crt");
  CHECK(crt::format_diagnostic(result.diagnostics[0]) ==
        "no/such/script.crt: error: cannot read the script: there is no such file\n");
}

TEST_CASE("a script file that is longer than allowed is not read") {
  const Folder folder;
  const fs::path file = folder.write("long.crt", std::string(1000, ' ') + "Scene { }");
  ScriptOptions options;
  CHECK(crt::run_script_file(file, options).scene);
  options.limits.source_bytes = 1000;
  const crt::ScriptResult result = crt::run_script_file(file, options);
  CHECK_FALSE(result.scene);
  REQUIRE(result.diagnostics.size() == 1);
  CHECK(result.diagnostics[0].code == ErrorCode::limit);
}

TEST_CASE(
    "values of a picture that are not finite are warned of where it is named, once a picture") {
  const Folder folder;
  std::string file = "PF\n2 1\n-1.0\n";
  const float values[] = {1, 1, 1, 0, std::numeric_limits<float>::quiet_NaN(), 0};
  file.append(reinterpret_cast<const char*>(values), sizeof values);
  folder.write("work/sky.pfm", file);
  const auto run = run_in(folder,
                          "_a = ImageMap { image -> \"sky.pfm\" }\n"
                          "_b = Background { image -> \"sky.pfm\" }");
  REQUIRE(run.ok());
  REQUIRE(run.result.diagnostics.size() == 1);
  const crt::Diagnostic& warning = run.result.diagnostics[0];
  CHECK(warning.severity == crt::Severity::warning);
  CHECK(warning.message.find("sky.pfm' has 1 pixel with values that are not finite") !=
        std::string::npos);
  CHECK(warning.message.find("at (1, 0)") != std::string::npos);
  CHECK(warning.place.line == 1);
}
