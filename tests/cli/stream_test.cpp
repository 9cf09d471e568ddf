// These tests check scripts from standard input, pictures to standard output, and several scripts.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/json.hpp"
#include "cli/scenes.hpp"

using namespace crt::test;

namespace {

using Names = std::vector<std::string>;

constexpr int usage_error = 2;

bool contains(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

const std::string png_signature = "\x89PNG\r\n\x1a\n";

struct Fixture {
  TemporaryFolder folder;
  Fixture() { folder.write("ball.crt", ball_script); }
};

}  // namespace

TEST_CASE_FIXTURE(Fixture, "a script from standard input gives the picture of the same file") {
  REQUIRE(run_crt(folder, {"render", "ball.crt", "--reproducible"}).exit_code == 0);
  const Outcome run = run_crt_in({.input = ball_script}, folder,
                                 {"render", "-", "-o", "other.png", "--reproducible"});
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  CHECK(run.out == "t is 0\nn is 3\n");
  CHECK(folder.read("other.png") == folder.read("ball.png"));
}

TEST_CASE_FIXTURE(Fixture, "frames of a script from standard input are frames of one script") {
  const Outcome run =
      run_crt_in({.input = ball_script}, folder, {"render", "-", "-o", "a.png", "--frames", "1-2"});
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  CHECK(folder.names() == Names{"a_0001.png", "a_0002.png", "ball.crt"});
}

TEST_CASE_FIXTURE(Fixture,
                  "errors in a script from standard input say so, and its imports are in "
                  "the current folder") {
  const Outcome wrong = run_crt_in({.input = "Scene {\n  Spere {}\n}\n"}, folder, {"check", "-"});
  CHECK(wrong.exit_code == 1);
  CHECK(contains(wrong.err, "<standard input>:2:"));
  folder.write("part.crt", "part = Sphere { center -> vec3(0, 0, 3) radius -> 1 }\n");
  const Outcome run =
      run_crt_in({.input = "import \"part.crt\"\nScene { part }\n"}, folder, {"check", "-"});
  CHECK_MESSAGE(run.exit_code == 0, run.err);
}

TEST_CASE_FIXTURE(Fixture, "-o - writes the picture to standard output and nothing else there") {
  REQUIRE(run_crt(folder, {"render", "ball.crt", "--reproducible"}).exit_code == 0);
  const Outcome run = run_crt(folder, {"render", "ball.crt", "-o", "-", "--reproducible"});
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  CHECK(run.out == folder.read("ball.png"));
  CHECK(contains(run.err, "n is 3\n"));
  CHECK(folder.names() == Names{"ball.crt", "ball.png"});
  const Outcome between = run_crt_in({.input = ball_script}, folder, {"render", "-", "-o", "-"});
  CHECK(between.out.starts_with(png_signature));
}

TEST_CASE_FIXTURE(Fixture, "with --aov, standard output gets an EXR file") {
  const Outcome run = run_crt(folder, {"render", "ball.crt", "-o", "-", "--aov", "depth"});
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  CHECK(run.out.starts_with("\x76\x2f\x31\x01"));
}

TEST_CASE_FIXTURE(Fixture, "a terminal gets no picture file" * doctest::skip(!has_terminals())) {
  CrtOnTerminal crt(folder, {"render", "ball.crt", "-o", "-"}, CrtOnTerminal::Streams::all);
  CHECK(crt.wait() == usage_error);
  CHECK(contains(crt.shown(), "standard output is a terminal"));
  CHECK_FALSE(contains(crt.shown(), "PNG"));
}

TEST_CASE_FIXTURE(Fixture, "a picture that standard output does not take is an error") {
  const Outcome run =
      run_crt_into(folder, {"render", "ball.crt", "-q", "-o", "-"}, "/dev/full", "");
  CHECK(run.exit_code == 3);
  CHECK(contains(run.err, "cannot write to standard output"));
}

TEST_CASE_FIXTURE(Fixture,
                  "each of several scripts gets its own picture, beside it or in a folder") {
  folder.write("deep/cube.crt", ball_script);
  Outcome run = run_crt(folder, {"render", "ball.crt", "deep/cube.crt"});
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  CHECK(folder.has("ball.png"));
  CHECK(folder.has("deep/cube.png"));

  folder.write("pictures/other", "");
  run = run_crt(folder, {"render", "ball.crt", "deep/cube.crt", "-o", "pictures"});
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  CHECK(folder.read("pictures/ball.png").starts_with(png_signature));
  CHECK(folder.read("pictures/cube.png").starts_with(png_signature));
  CHECK(run_crt(folder, {"render", "ball.crt", "-o", "deep/"}).exit_code == 0);
  CHECK(folder.has("deep/ball.png"));
}

TEST_CASE_FIXTURE(Fixture, "an error in one of several scripts leaves the others their pictures") {
  folder.write("wrong.crt", "Scene { Spere {} }");
  const Outcome run = run_crt(folder, {"render", "wrong.crt", "ball.crt", "--stats", "stats.json"});
  CHECK(run.exit_code == 1);
  CHECK(contains(run.err, "wrong.crt:1:"));
  CHECK(folder.has("ball.png"));
  const Json stats = parse_json(folder.read("stats.json"));
  REQUIRE(stats.items.size() == 1);
  CHECK(stats.items[0]["output"].string == "ball.png");
}

TEST_CASE_FIXTURE(Fixture, "what makes no sense together is refused before anything is rendered") {
  folder.write("deep/ball.crt", ball_script);
  folder.write("pictures/other", "");
  const std::vector<std::vector<std::string>> senseless = {
      {"-"},
      {"-", "-", "-o", "a.png"},
      {"-", "ball.crt", "-o", "pictures"},
      {"ball.crt", "deep/ball.crt", "-o", "a.png"},
      {"ball.crt", "deep/ball.crt", "-o", "nowhere"},
      {"ball.crt", "deep/ball.crt", "-o", "-"},
      {"ball.crt", "deep/ball.crt", "-o", "pictures"},
      {"ball.crt", "deep/ball.crt", "--checkpoint", "state"},
      {"ball.crt", "-o", "-", "--stats", "-"},
      {"ball.crt", "-o", "-", "--frames", "1-2"},
      {"ball.crt", "-o", "-", "--film"},
      {"ball.crt", "-o", "picture.png", "--film"},
      {"ball.crt", "--film", "--checkpoint", "state"},
      {"ball.crt", "-o", "film.gif", "--time", "3"},
      {"ball.crt", "-o", "film.gif", "--frames", "1-2", "--aov", "depth"},
      {"ball.crt", "--keep-frames", "frames"},
  };
  for (std::vector<std::string> line : senseless) {
    line.insert(line.begin(), "render");
    const Outcome run = run_crt(folder, line);
    CAPTURE(line.back());
    CAPTURE(run.err);
    CHECK(run.exit_code == usage_error);
    CHECK(contains(run.err, "crt: error: "));
    CHECK(run.out.empty());
  }
  CHECK(folder.names() == Names{"ball.crt", "deep", "pictures"});
}
