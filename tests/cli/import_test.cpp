// These tests check `crt import`, which translates files of other programs.
#include <doctest/doctest.h>

#include <string>

#include "cli/command.hpp"

using namespace crt::test;

namespace {

constexpr int wrong_script = 1;
constexpr int wrong_usage = 2;
constexpr int wrong_files = 3;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const std::string bored = R"(difference() {
	cube(size = [10, 10, 10], center = true);
	cylinder($fn = 0, $fa = 12, $fs = 2, h = 20, r1 = 3, r2 = 3, center = true);
}
)";

}  // namespace

TEST_CASE("an imported part is laid out, checks without a warning, and can be measured") {
  const TemporaryFolder folder;
  folder.write("bored.csg", bored);
  const Outcome made = run_crt(folder, {"import", "bored.csg", "-o", "bored.crt"});
  CHECK(made.exit_code == 0);
  CHECK(made.err.empty());
  CHECK(run_crt(folder, {"import", "bored.csg"}).out == folder.read("bored.crt"));
  CHECK(run_crt(folder, {"format", "--check", "bored.crt"}).exit_code == 0);
  const Outcome check = run_crt(folder, {"check", "bored.crt"});
  CHECK(check.exit_code == 0);
  CHECK(check.err.empty());
  const Outcome measure = run_crt(folder, {"measure", "bored.crt", "--volume"});
  CHECK(measure.exit_code == 0);
  CHECK(contains(measure.out, "717.2"));  // 1000 - 90 pi
  // The part is a name that another script can import.
  folder.write(
      "two.crt",
      "import \"bored.crt\" as one\nScene { one.part one.part <translate vec3(20, 0, 0)> }");
  CHECK(run_crt(folder, {"check", "two.crt"}).exit_code == 0);
}

TEST_CASE("a scene finds what it includes beside it, and in folders that are named") {
  const TemporaryFolder folder;
  folder.write("scene.pov",
               "#include \"ball.inc\"\ncamera { location -5*z look_at 0 }\n"
               "light_source { 9*y, 1 }\nobject { Ball }\n");
  const Outcome missing = run_crt(folder, {"import", "scene.pov", "-o", "scene.crt"});
  CHECK(missing.exit_code == wrong_script);
  CHECK(contains(missing.err, "scene.pov:1:1: error: there is no file 'ball.inc'"));
  CHECK(!folder.has("scene.crt"));
  std::filesystem::create_directory(folder.path() / "more");
  folder.write("more/ball.inc", "#declare Ball = sphere { 0, 1 pigment { rgb 1 } }");
  CHECK(
      run_crt(folder, {"import", "scene.pov", "--include", "more", "-o", "scene.crt"}).exit_code ==
      0);
  CHECK(run_crt(folder, {"check", "scene.crt"}).err.empty());
  // A path may not leave the folders.
  folder.write("out.pov", "#include \"../scene.pov\"");
  CHECK(contains(run_crt(folder, {"import", "out.pov", "--include", "more"}).err,
                 "there is no file '../scene.pov'"));
}

TEST_CASE("what is not understood has its place, and --partial leaves it out") {
  const TemporaryFolder folder;
  folder.write("part.csg", bored + "\nfoo();\n");
  const Outcome strict = run_crt(folder, {"import", "part.csg", "-o", "part.crt"});
  CHECK(strict.exit_code == wrong_script);
  CHECK(contains(strict.err, "part.csg:6:1: error: 'foo' is not understood"));
  CHECK(!folder.has("part.crt"));
  const Outcome partial = run_crt(folder, {"import", "part.csg", "--partial", "-o", "part.crt"});
  CHECK(partial.exit_code == 0);
  CHECK(contains(partial.err, "part.csg:6:1: warning: 'foo' is not understood"));
  CHECK(folder.has("part.crt"));
  const Outcome json = run_crt(folder, {"import", "part.csg", "--diagnostics", "json"});
  CHECK(json.exit_code == wrong_script);
  CHECK(contains(json.err, "\"line\": 6"));
}

TEST_CASE("files that are none, or of another kind, are errors") {
  const TemporaryFolder folder;
  folder.write("part.step", "");
  folder.write("part.csg", bored);
  CHECK(run_crt(folder, {"import", "nowhere.csg"}).exit_code == wrong_files);
  CHECK(run_crt(folder, {"import", "nowhere.scad"}).exit_code == wrong_files);
  const Outcome other = run_crt(folder, {"import", "part.step"});
  CHECK(other.exit_code != 0);
  CHECK(contains(other.err, "the ending is none that is understood: .csg, .scad, .pov"));
  CHECK(run_crt(folder, {"import", "part.csg", "-o", "part.csg"}).exit_code != 0);
  CHECK(folder.read("part.csg") == bored);
  CHECK(run_crt(folder, {"import"}).exit_code == wrong_usage);
  CHECK(run_crt(folder, {"import", "part.csg", "--seconds", "0"}).exit_code == wrong_usage);
}

TEST_CASE("a .scad file is evaluated by openscad, and the error says so where there is none") {
  const TemporaryFolder folder;
  folder.write("part.scad", "cube(2);");
  const Outcome without = run_crt_in({.environment = {"PATH=" + folder.path().string()}}, folder,
                                     {"import", "part.scad"});
  CHECK(without.exit_code == wrong_files);
  CHECK(contains(without.err, "install OpenSCAD"));
  // A program of that name stands in for it.
  folder.write("openscad",
               "#!/bin/sh\nprintf '%s' 'cube(size = [2, 2, 2], center = false);' >\"$2\"\n");
  std::filesystem::permissions(folder.path() / "openscad", std::filesystem::perms::owner_all);
  const std::string path = "PATH=" + folder.path().string() + ":/usr/bin:/bin";
  const Outcome made = run_crt_in({.environment = {path}}, folder, {"import", "part.scad"});
  CHECK(made.exit_code == 0);
  CHECK(contains(made.out, "cornerB -> vec3(2, 2, 2)"));
  folder.write("openscad", "#!/bin/sh\nexec sleep 60\n");
  const Outcome slow =
      run_crt_in({.environment = {path}}, folder, {"import", "part.scad", "--seconds", "0.2"});
  CHECK(slow.exit_code != 0);
  CHECK(contains(slow.err, "openscad took longer than 0.2 s"));
  folder.write("openscad", "#!/bin/sh\nexit 1\n");
  CHECK(contains(run_crt_in({.environment = {path}}, folder, {"import", "part.scad"}).err,
                 "openscad could not evaluate it"));
}
