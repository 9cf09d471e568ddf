#include <doctest/doctest.h>

#include <string>

#include "cli/command.hpp"
#include "cli/scenes.hpp"

using namespace crt::test;

namespace {

bool contains(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

struct Fixture {
  TemporaryFolder folder;
  Fixture() { folder.write("ball.crt", ball_script); }
};

}  // namespace

TEST_CASE_FIXTURE(Fixture, "the ending of the output says the language, and --as says it before") {
  CHECK(run_crt(folder, {"export", "ball.crt", "-o", "ball.cpp"}).exit_code == 0);
  CHECK(run_crt(folder, {"export", "ball.crt", "-o", "ball.py"}).exit_code == 0);
  CHECK(run_crt(folder, {"export", "ball.crt", "-o", "ball.c"}).exit_code == 0);
  CHECK(run_crt(folder, {"export", "ball.crt", "-o", "c.cpp", "--as", "c"}).exit_code == 0);
  CHECK(contains(folder.read("ball.cpp"), "Scene make_scene() {"));
  CHECK(contains(folder.read("ball.py"), "def make_scene():"));
  CHECK(run_crt(folder, {"export", "ball.crt", "-o", "plain.crt"}).exit_code == 0);
  CHECK(contains(folder.read("ball.c"), "static crt_scene* make_scene(void) {"));
  CHECK(contains(folder.read("plain.crt"), "Scene {\n    Sphere {"));
  CHECK(folder.read("c.cpp") == folder.read("ball.c"));
}

TEST_CASE_FIXTURE(Fixture, "without an output the program goes to standard output alone") {
  const Outcome run = run_crt(folder, {"export", "ball.crt", "--as", "python"});
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  CHECK(run.out.starts_with("import sys\n"));
  CHECK(contains(run.err, "n is 3"));  // what the script prints
}

TEST_CASE_FIXTURE(Fixture, "variables and settings are those of the command line") {
  const Outcome run =
      run_crt(folder, {"export", "ball.crt", "--set", "n=7", "--width", "123", "-o", "ball.py"});
  CHECK(contains(run.out, "n is 7"));
  CHECK(contains(folder.read("ball.py"), "width=123"));
}

TEST_CASE_FIXTURE(Fixture, "one entity is a function, and one that is not there is an error") {
  const Outcome run = run_crt(folder, {"export", "ball.crt", "--entity", "0", "-o", "ball.py"});
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  CHECK(contains(folder.read("ball.py"), "def make_entity():"));
  const Outcome beyond = run_crt(folder, {"export", "ball.crt", "--entity", "99"});
  CHECK(beyond.exit_code == 1);
  CHECK(contains(beyond.err, "there is no entity 99"));
}

TEST_CASE_FIXTURE(Fixture, "what cannot be is refused, and nothing is written") {
  CHECK(run_crt(folder, {"export", "ball.crt", "--as", "cobol"}).exit_code == 2);
  CHECK(run_crt(folder, {"export", "ball.crt", "--entity", "-1"}).exit_code == 2);
  const std::string before = folder.read("ball.crt");
  CHECK(run_crt(folder, {"export", "ball.crt", "-o", "./ball.crt"}).exit_code == 1);
  CHECK(folder.read("ball.crt") == before);
  CHECK(run_crt(folder, {"export", "none.crt", "-o", "none.cpp"}).exit_code == 3);
  folder.write("wrong.crt", "Scene { Ball { } }\n");
  CHECK(run_crt(folder, {"export", "wrong.crt", "-o", "wrong.cpp"}).exit_code == 1);
  CHECK(!folder.has("none.cpp"));
  CHECK(!folder.has("wrong.cpp"));
}

TEST_CASE_FIXTURE(Fixture, "an entity of a script is a macro that can be called") {
  const Outcome run = run_crt(folder, {"export", "ball.crt", "--entity", "0", "--as", "script"});
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  folder.write("called.crt", run.out + "Scene { make_entity() }\n");
  CHECK(run_crt(folder, {"check", "called.crt"}).exit_code == 0);
}

TEST_CASE_FIXTURE(Fixture, "files of a script lie beside it, and have none without its name") {
  folder.write("facet.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  folder.write("facet.crt", "Scene { Mesh { file -> \"facet.off\" } }\n");
  const Outcome named = run_crt(folder, {"export", "facet.crt", "-o", "plain.crt"});
  CHECK_MESSAGE(named.exit_code == 0, named.err);
  CHECK(contains(folder.read("plain.crt"), "Mesh { file -> \"plain-"));
  CHECK(run_crt(folder, {"check", "plain.crt"}).exit_code == 0);
  const Outcome streamed = run_crt(folder, {"export", "facet.crt", "--as", "script"});
  CHECK(streamed.exit_code == 1);
  CHECK(contains(streamed.err, "give the script a name with -o"));
}

TEST_CASE_FIXTURE(Fixture, "solids are written as triangles, with what is left out named") {
  folder.write("parts.crt", R"(Settings { unit -> "mm" }
Scene {
  Box {
    cornerA -> vec3(0, 0, 0) cornerB -> vec3(4, 2, 1)
    material -> Material { color -> rgb(1, 0.5, 0) }
  }
  Plane { normal -> vec3(0, 1, 0) position -> vec3(0, -3, 0) }
  Sphere { center -> vec3(9, 0, 0) radius -> 1 }
})");
  const Outcome run =
      run_crt(folder, {"export", "parts.crt", "-o", "parts.3mf", "--deviation", "0.05"});
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  CHECK(contains(run.err, "entity 1 is left out"));
  CHECK(contains(run.err, " triangles, within 0.0"));
  folder.write("read.crt", "Scene { Mesh { file -> \"parts.3mf\" } }\n");
  const Outcome read = run_crt(folder, {"check", "read.crt"});
  CHECK_MESSAGE(read.exit_code == 0, read.err);
  // One entity, with a deviation that fits its size.
  CHECK(run_crt(folder, {"export", "parts.crt", "-o", "box.glb", "--entity", "0"}).exit_code == 0);
  CHECK(contains(folder.read("box.glb"), "\"baseColorFactor\":[1,0.5,0,1]"));
  CHECK(contains(folder.read("box.glb"), "\"max\":[0.004,0.002,0.001]"));
  const Outcome ground = run_crt(folder, {"export", "parts.crt", "-o", "no.stl", "--entity", "1"});
  CHECK(ground.exit_code == 1);
  CHECK(!folder.has("no.stl"));
  CHECK(run_crt(folder, {"export", "parts.crt", "-o", "a.stl", "--deviation", "0"}).exit_code == 2);
  CHECK(run_crt(folder, {"export", "parts.crt", "-o", "a.cpp", "--deviation", "1"}).exit_code == 1);
  CHECK(run_crt(folder, {"export", "parts.crt", "-o", "a.stl", "--seconds", "0"}).exit_code == 2);
  CHECK(run_crt(folder, {"export", "parts.crt", "-o", "a.cpp", "--seconds", "1"}).exit_code == 1);
  const Outcome short_run = run_crt(folder, {"export", "parts.crt", "-o", "ball.stl", "--entity",
                                             "2", "--deviation", "1e-4", "--seconds", "1e-9"});
  CHECK(contains(short_run.err, "could not be proved"));
  CHECK(run_crt(folder, {"export", "parts.crt", "-o", "none/a.stl"}).exit_code == 3);
}
