#include <doctest/doctest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "cli/command.hpp"

using namespace crt::test;

namespace {

struct Fixture {
  TemporaryFolder folder;
  Fixture() {
    folder.write("scene.crt", R"(hole = Cylinder { from -> vec3(1, 1, -1) to -> vec3(1, 1, 2)
  radius -> 0.5 }
print("a plate")
Scene {
  Sphere { center -> vec3(9, 0, 0) radius -> 1 }
  Box { cornerA -> vec3(0, 0, 0) cornerB -> vec3(4, 2, 1) } - hole
}
)");
  }

  Outcome ask(const std::string& input, const std::vector<std::string>& options = {}) const {
    std::vector<std::string> arguments = {"ask", "scene.crt"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_crt_in({.input = input}, folder, arguments);
  }
};

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

bool contains(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

const std::string names = "t,x,y,z,nx,ny,nz,u,v,entity,part,face,side";

}  // namespace

TEST_CASE_FIXTURE(Fixture, "rays are answered a line each, in their order") {
  const Outcome run = ask("3,1,-5,0,0,2\n\n1, 1, -5, 0, 0, 1\r\n9,0,-5,0,0,1");
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  const std::vector<std::string> lines = lines_of(run.out);
  REQUIRE(lines.size() == 4);
  CHECK(lines[0] == names);
  CHECK(lines[1] == "2.5,3,1,0,0,0,-1,0.75,0.5,1,1,4,enter");
  CHECK(lines[2] == "inf,,,,,,,,,,,,");
  CHECK(lines[3].starts_with("4,9,0,-1,0,0,-1,"));
  CHECK(contains(lines[3], ",0,0,0,enter"));
  CHECK(contains(run.err, "a plate"));  // what the script prints
}

TEST_CASE_FIXTURE(Fixture, "crossings have the number of their ray before them") {
  const Outcome run = ask("ox,oy,oz,dx,dy,dz\n1,1,-5,0,0,1\n3,1,-5,0,0,1\n", {"--crossings"});
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  const std::vector<std::string> lines = lines_of(run.out);
  REQUIRE(lines.size() == 3);
  CHECK(lines[0] == "ray," + names);
  CHECK(lines[1].starts_with("1,5,3,1,0,"));
  CHECK(lines[1].ends_with(",enter"));
  CHECK(lines[2].starts_with("1,6,3,1,1,"));
  CHECK(lines[2].ends_with(",leave"));
}

TEST_CASE_FIXTURE(Fixture, "points are in an entity or in none") {
  const Outcome run = ask("x,y,z\n3,1,0.5\n1,1,0.5\n9.5,0,0\n", {"--contains"});
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  CHECK(run.out == "inside,entity,part\n1,1,1\n0,,\n1,0,0\n");
}

TEST_CASE_FIXTURE(Fixture, "more lines than are answered at a time stay in order") {
  std::string input;
  std::string expected = "inside,entity,part\n";
  for (int i = 0; i < 40000; ++i) {
    input += i % 3 == 0 ? "3,1,0.5\n" : "3,1,7\n";
    expected += i % 3 == 0 ? "1,1,1\n" : "0,,\n";
  }
  CHECK(ask(input, {"--contains", "--threads", "2"}).out == expected);
}

TEST_CASE_FIXTURE(Fixture, "a line that is none is an error with its number") {
  for (const char* wrong : {"1,2,3,4,5", "1,2,3,4,5,6,7", "1,2,3,4,5,x", "1,2,3,4,5,inf",
                            "1,2,3,4,5,", "1;2;3;4;5;6", "word"}) {
    const Outcome run = ask("3,1,-5,0,0,1\n\n" + std::string(wrong) + "\n");
    CAPTURE(wrong);
    CHECK(run.exit_code == 3);
    CHECK(contains(run.err, "<standard input>:3: there must be 6 numbers, ox,oy,oz,dx,dy,dz"));
  }
  const Outcome first = ask("1,2,3\n");
  CHECK(first.exit_code == 3);
  CHECK(contains(first.err, "<standard input>:1: "));
  const Outcome flat = ask("3,1,-5,0,0,1\n3,1,-5,0,0,0\n");
  CHECK(flat.exit_code == 3);
  CHECK(contains(flat.err, "<standard input>:2: "));
  CHECK(contains(flat.err, "direction"));
}

TEST_CASE_FIXTURE(Fixture, "a wrong command line or script of ask ends with its code") {
  CHECK(ask("", {"--crossings", "--contains"}).exit_code == 2);
  CHECK(run_crt(folder, {"ask", "-"}).exit_code == 2);
  CHECK(run_crt(folder, {"ask", "none.crt"}).exit_code == 3);
  folder.write("scene.crt", "Scene { Ball { } }\n");
  CHECK(ask("3,1,-5,0,0,1\n").exit_code == 1);
}

TEST_CASE_FIXTURE(Fixture, "no lines are answered by the names of the columns") {
  const Outcome run = ask("");
  CHECK(run.exit_code == 0);
  CHECK(run.out == names + "\n");
}
