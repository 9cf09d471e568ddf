#include <doctest/doctest.h>
#include <sys/resource.h>

#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/json.hpp"
#include "cli/scenes.hpp"

using namespace crt::test;

namespace {

using Arguments = std::vector<std::string>;

bool contains(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

constexpr int script_error = 1;
constexpr int usage_error = 2;
constexpr int file_error = 3;

struct Fixture {
  TemporaryFolder folder;
  Fixture() {
    folder.write("ball.crt", ball_script);
    folder.write("wrong.crt", "Scene {\n  Sphere { center -> vec3(0, 0, 0) raduis -> 1 }\n}\n");
  }
};

}  // namespace

TEST_CASE_FIXTURE(Fixture, "a wrong script ends with 1, tells the place and writes nothing") {
  const Outcome run = run_crt(folder, {"render", "wrong.crt"});
  CHECK(run.exit_code == script_error);
  CHECK(contains(run.err, "wrong.crt:2:"));
  CHECK(contains(run.err, "radius"));
  CHECK_FALSE(folder.has("wrong.png"));
}

TEST_CASE_FIXTURE(Fixture, "a setting out of range on the command line is an error, too") {
  CHECK(run_crt(folder, {"render", "ball.crt", "--width", "0"}).exit_code == script_error);
  CHECK(run_crt(folder, {"render", "ball.crt", "--falloffmodel", "none"}).exit_code ==
        script_error);
  CHECK(run_crt(folder, {"render", "ball.crt", "--precision", "half"}).exit_code == script_error);
  CHECK_FALSE(folder.has("ball.png"));
}

TEST_CASE_FIXTURE(Fixture, "--max-steps stops a script that goes on too long") {
  folder.write("loop.crt", "i = 0\nwhile (i < 1) { i = i - 1 }\nScene { }\n");
  const Outcome run = run_crt(folder, {"render", "loop.crt", "--max-steps", "1000"});
  CHECK(run.exit_code == script_error);
  CHECK(contains(run.err, "loop.crt:2:"));
}

TEST_CASE_FIXTURE(Fixture, "--max-image-pixels stops a script with pictures that are too large") {
  folder.write("field.crt",
               "Settings { width -> 4 height -> 3 }\nrow = [0, 0.5, 1]\n"
               "Scene { HeightField { heights -> [row, row] cornerA -> vec3(0, 0, 0) "
               "cornerB -> vec3(1, 1, 1) } }\n");
  CHECK(run_crt(folder, {"check", "field.crt", "--max-image-pixels", "6"}).exit_code == 0);
  const Outcome run = run_crt(folder, {"check", "field.crt", "--max-image-pixels", "5"});
  CHECK(run.exit_code == script_error);
  CHECK(contains(run.err, "field.crt:3:"));
  CHECK(contains(run.err, "5 pixels together"));
}

TEST_CASE_FIXTURE(Fixture,
                  "a wrong command line ends with 2, says what is wrong and names the help") {
  const Arguments wrong_lines[] = {
      {},
      {"paint", "ball.crt"},
      {"ball.crt"},
      {"render"},
      {"render", "ball.crt", "--bogus"},
      {"render", "ball.crt", "--width", "wide"},
      {"render", "ball.crt", "--gamma", "nan"},
      {"render", "ball.crt", "--showclip=maybe"},
      {"render", "ball.crt", "--set", "n"},
      {"render", "ball.crt", "--time", "noon"},
      {"render", "ball.crt", "--frames", "5-2"},
      {"render", "ball.crt", "--frames", "2147483647-2147483647"},
      {"render", "ball.crt", "--frames", "0-2147483646"},
      {"render", "ball.crt", "--frames", "1-1000001"},
      {"render", "ball.crt", "--frames", "1-2", "--time", "3"},
      {"render", "ball.crt", "--region", "0,0,8"},
      {"render", "ball.crt", "--region", "0,0,8,8,8"},
      {"render", "ball.crt", "--threads", "-1"},
      {"render", "ball.crt", "--resources", "nowhere"},
      {"render", "ball.crt", "--diagnostics", "xml"},
      {"render", "ball.crt", "--max-image-pixels", "many"},
      {"check"},
  };
  for (const Arguments& line : wrong_lines) {
    const Outcome run = run_crt(folder, line);
    INFO("arguments: ", line.empty() ? "none" : line.back(), "\n", run.err);
    CHECK(run.exit_code == usage_error);
    CHECK(contains(run.err, "crt: error: "));
    CHECK(contains(run.err, "--help"));
    CHECK(run.out.empty());
  }
}

TEST_CASE_FIXTURE(Fixture, "a script without a command gets the command suggested") {
  CHECK(contains(run_crt(folder, {"ball.crt"}).err, "crt render ball.crt"));
}

TEST_CASE_FIXTURE(Fixture, "a region beyond the picture ends with 2 and tells the picture's size") {
  for (const char* region : {"0,0,17,12", "16,0,1,1", "15,11,1,2", "2147483647,0,2147483647,1"}) {
    const Outcome run = run_crt(folder, {"render", "ball.crt", "--region", region});
    CHECK(run.exit_code == usage_error);
    CHECK(contains(run.err, "16 x 12"));
  }
}

TEST_CASE_FIXTURE(Fixture,
                  "an unknown ending of the picture ends with 2 before anything is rendered") {
  const Outcome run = run_crt(folder, {"render", "ball.crt", "-o", "ball.docx"});
  CHECK(run.exit_code == usage_error);
  CHECK(contains(run.err, "png, tif"));
  CHECK(run.out.empty());
}

TEST_CASE_FIXTURE(Fixture, "a picture never overwrites its own script") {
  folder.write("scene.png", ball_script);
  CHECK(run_crt(folder, {"render", "scene.png"}).exit_code == usage_error);
  CHECK(folder.read("scene.png") == ball_script);
}

TEST_CASE_FIXTURE(Fixture, "a picture of a job that no format can hold ends with 2") {
  REQUIRE(run_crt(folder, {"farm", "plan", "ball.crt", "-o", "job", "--tasks", "1"}).exit_code ==
          0);
  const Outcome still = run_crt(folder, {"farm", "plan", "ball.crt", "--film", "-o", "film"});
  CHECK(still.exit_code == usage_error);
  CHECK(contains(still.err, "say them by frames -> 48"));
  CHECK(run_crt(folder, {"farm", "merge", "job", "-o", "x.docx"}).exit_code == usage_error);
  CHECK(run_crt(folder, {"farm", "status", "job", "--sheet", "x.docx"}).exit_code == usage_error);
  REQUIRE(
      run_crt(folder, {"farm", "plan", "ball.crt", "-o", "deep", "--aov", "depth", "--tasks", "1"})
          .exit_code == 0);
  CHECK(run_crt(folder, {"farm", "merge", "deep", "-o", "x.png"}).exit_code == usage_error);
}

TEST_CASE_FIXTURE(Fixture, "a file beyond what the command may write is an error of files") {
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
  rlimit little = before;
  little.rlim_cur = 2000;
  REQUIRE(setrlimit(RLIMIT_FSIZE, &little) == 0);
  const Outcome run = run_crt(folder, {"render", "ball.crt", "--width", "300", "--height", "300"});
  REQUIRE(setrlimit(RLIMIT_FSIZE, &before) == 0);
  CHECK(run.exit_code == file_error);
  CHECK(contains(run.err, "ball.png"));
  CHECK(folder.names() == Arguments{"ball.crt", "wrong.crt"});
}

TEST_CASE_FIXTURE(Fixture, "what a script prints cannot control a terminal") {
  folder.write("print.crt", "print(\"a\\tb\", \"\x1b[31m\xc2\x9b\")\nScene { }\n");
  const Outcome run = run_crt(folder, {"render", "print.crt", "--width", "4", "--height", "3"});
  CHECK(run.exit_code == 0);
  CHECK(contains(run.out, "a\tb \uFFFD[31m\uFFFD\n"));
}

TEST_CASE_FIXTURE(Fixture, "what messages quote of a job cannot control a terminal") {
  folder.write("manifest.json", "{\"crt_farm\": 1, \"script\": \"/\\u001b[31m\"}");
  const Outcome run = run_crt(folder, {"farm", "status", "."});
  CHECK(run.exit_code == file_error);
  CHECK(contains(run.err, "\uFFFD[31m"));
}

TEST_CASE_FIXTURE(Fixture, "a missing script ends with 3 and names it") {
  const Outcome run = run_crt(folder, {"render", "missing.crt"});
  CHECK(run.exit_code == file_error);
  CHECK(contains(run.err, "missing.crt"));
}

TEST_CASE_FIXTURE(Fixture, "a missing resource ends with 3 and tells the line that wants it") {
  folder.write("sky.crt",
               "Settings {\n  background -> Background { image -> \"sky.jpg\" }\n}\nScene { }\n");
  const Outcome run = run_crt(folder, {"render", "sky.crt"});
  CHECK(run.exit_code == file_error);
  CHECK(contains(run.err, "sky.crt:2:"));
  CHECK(contains(run.err, "sky.jpg"));
}

TEST_CASE_FIXTURE(Fixture,
                  "an output that cannot be written ends with 3 before anything is rendered") {
  folder.write("folder.png/file", "");
  for (const char* output :
       {"nowhere/ball.png", "folder.png", "ball.crt/ball.png", "/proc/ball.png"}) {
    const Outcome run = run_crt(folder, {"render", "ball.crt", "-o", output});
    INFO(output, "\n", run.err);
    CHECK(run.exit_code == file_error);
    CHECK(contains(run.err, "cannot write"));
    CHECK(run.out.empty());
  }
}

TEST_CASE_FIXTURE(Fixture,
                  "statistics that cannot be written end with 3 before anything is rendered") {
  const Outcome run = run_crt(folder, {"render", "ball.crt", "--stats", "nowhere/stats.json"});
  CHECK(run.exit_code == file_error);
  CHECK_FALSE(folder.has("ball.png"));
}

TEST_CASE_FIXTURE(Fixture,
                  "--diagnostics json puts one JSON array on standard error and nothing else") {
  const Json wrong =
      parse_json(run_crt(folder, {"render", "wrong.crt", "--diagnostics", "json"}).err);
  REQUIRE(wrong.items.size() >= 1);
  CHECK(wrong.items[0]["severity"].string == "error");
  CHECK(wrong.items[0]["line"].number == 2);

  CHECK(parse_json(run_crt(folder, {"render", "ball.crt", "--diagnostics", "json"}).err)
            .items.empty());

  const Json unwritable = parse_json(
      run_crt(folder, {"render", "ball.crt", "-o", "no/x.png", "--diagnostics", "json"}).err);
  REQUIRE(unwritable.items.size() == 1);
  CHECK(contains(unwritable.items[0]["message"].string, "cannot write"));
}

TEST_CASE_FIXTURE(Fixture, "--quiet still tells errors, and warnings no more") {
  folder.write("unused.crt", "1 + 2\nScene { }\n");
  CHECK(contains(run_crt(folder, {"check", "unused.crt"}).err, "warning"));
  CHECK(run_crt(folder, {"check", "unused.crt", "--quiet"}).err.empty());
  CHECK(contains(run_crt(folder, {"check", "wrong.crt", "--quiet"}).err, "error"));
}

TEST_CASE_FIXTURE(Fixture, "a warning is reported once, however many frames give it") {
  folder.write("unused.crt", "1 + 2\n" + moving_script);
  const Outcome run = run_crt(folder, {"render", "unused.crt", "--frames", "0-3"});
  REQUIRE(run.exit_code == 0);
  const std::size_t first = run.err.find("warning");
  REQUIRE(first != std::string::npos);
  CHECK(run.err.find("warning", first + 1) == std::string::npos);
}

TEST_CASE_FIXTURE(Fixture, "frames that are all the same get one warning, and moving ones none") {
  const std::string warning = "all frames of 'film.crt' are the same, as it does not read t";
  const std::vector<std::string> film = {"render", "film.crt", "--frames", "0-2"};
  folder.write("film.crt", moving_script);
  CHECK_FALSE(contains(run_crt(folder, film).err, "warning"));
  for (const std::string time : {"1", "u"}) {
    std::string still = "u = 1\nprint(u)\n" + moving_script;
    still.replace(still.find("1 + t"), 5, time);
    folder.write("film.crt", still);
    const std::string err = run_crt(folder, film).err;
    REQUIRE(contains(err, warning));
    CHECK(err.find("warning", err.find(warning)) == std::string::npos);
  }
  folder.write("film.crt", "t = 1\n" + moving_script);
  CHECK(contains(run_crt(folder, film).err, warning));
  folder.write("film.crt", "t = t / 25\n" + moving_script);
  CHECK_FALSE(contains(run_crt(folder, film).err, warning));
  folder.write("film.crt", moving_script);
  CHECK_FALSE(contains(run_crt(folder, {"render", "film.crt"}).err, warning));
}

TEST_CASE_FIXTURE(Fixture, "a picture where many rays end at the recursion depth gets a warning") {
  folder.write("mirrors.crt", mirrors_script);
  const std::vector<std::string> small = {"--width", "8", "--height", "8"};
  std::vector<std::string> shallow = {"render", "mirrors.crt", "--recursiondepth", "2"};
  shallow.insert(shallow.end(), small.begin(), small.end());
  CHECK(contains(run_crt(folder, shallow).err,
                 "64 rays ended at recursiondepth 2 and see the background: raise recursiondepth"));
  shallow.insert(shallow.end(), {"--cutoff", "black"});
  CHECK(contains(run_crt(folder, shallow).err, "and count as black: raise recursiondepth"));
  CHECK_FALSE(contains(run_crt(folder, {"render", "ball.crt"}).err, "warning"));
}

TEST_CASE_FIXTURE(Fixture, "check warns of what prepare finds") {
  folder.write("empty.crt", "Scene { }\n");
  CHECK(contains(run_crt(folder, {"check", "empty.crt"}).err,
                 "empty.crt: warning: the scene has no entities"));
}

TEST_CASE_FIXTURE(Fixture, "check tells of every script and renders none") {
  const Outcome both = run_crt(folder, {"check", "ball.crt", "wrong.crt"});
  CHECK(both.exit_code == script_error);
  CHECK(both.out == "ball.crt: no errors\n");
  CHECK(contains(both.err, "wrong.crt:2:"));
  CHECK(run_crt(folder, {"check", "ball.crt"}).exit_code == 0);
  CHECK(run_crt(folder, {"check", "missing.crt"}).exit_code == file_error);
  CHECK(folder.names() == std::vector<std::string>{"ball.crt", "wrong.crt"});
}
