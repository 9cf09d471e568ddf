#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/scenes.hpp"

using namespace crt::test;

namespace {

using Names = std::vector<std::string>;

bool contains(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

bool is_png(const std::string& content) {
  return content.starts_with("\x89PNG\r\n\x1a\n");
}

/// Returns the sides of a PNG, from its header chunk.
std::pair<int, int> png_size(const std::string& content) {
  const auto number_at = [&](std::size_t at) {
    int number = 0;
    for (std::size_t i = 0; i < 4; ++i)
      number = 256 * number + static_cast<unsigned char>(content.at(at + i));
    return number;
  };
  constexpr std::size_t width_place = 16;
  return {number_at(width_place), number_at(width_place + 4)};
}

struct Fixture {
  TemporaryFolder folder;
  Fixture() { folder.write("ball.crt", ball_script); }
};

}  // namespace

TEST_CASE_FIXTURE(Fixture, "a script is rendered to a picture of its name beside it") {
  folder.write("deep/er/ball.crt", ball_script);
  const Outcome run = run_crt(folder, {"render", "deep/er/ball.crt"});
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  CHECK(is_png(folder.read("deep/er/ball.png")));
  CHECK(png_size(folder.read("deep/er/ball.png")) == std::pair(16, 12));
}

TEST_CASE_FIXTURE(Fixture, "nothing but the picture is left in the folder") {
  run_crt(folder, {"render", "ball.crt", "-o", "picture.png"});
  CHECK(folder.names() == Names{"ball.crt", "picture.png"});
}

TEST_CASE_FIXTURE(Fixture, "what a script prints goes to standard output") {
  CHECK(run_crt(folder, {"render", "ball.crt"}).out == "t is 0\nn is 3\n");
}

TEST_CASE_FIXTURE(Fixture, "--set replaces a variable of the script by an expression") {
  const Outcome plain = run_crt(folder, {"render", "ball.crt", "-o", "a.png"});
  const Outcome raised = run_crt(folder, {"render", "ball.crt", "-o", "b.png", "--set", "n=2 + 2"});
  REQUIRE(plain.exit_code == 0);
  REQUIRE_MESSAGE(raised.exit_code == 0, raised.err);
  CHECK(contains(raised.out, "n is 4"));
  CHECK(folder.read("a.png") != folder.read("b.png"));
}

TEST_CASE_FIXTURE(Fixture, "--time is the script's t") {
  CHECK(contains(run_crt(folder, {"render", "ball.crt", "--time", "2.5"}).out, "t is 2.5"));
  CHECK(contains(run_crt(folder, {"render", "ball.crt", "--time", "-1.5"}).out, "t is -1.5"));
}

TEST_CASE_FIXTURE(Fixture, "--frames renders a picture for each t, numbered before the ending") {
  const Outcome run = run_crt(folder, {"render", "ball.crt", "--frames", "9-11", "-o", "film.png"});
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  CHECK(folder.names() == Names{"ball.crt", "film_0009.png", "film_0010.png", "film_0011.png"});
  CHECK(contains(run.out, "t is 9\n"));
  CHECK(contains(run.out, "t is 11\n"));
}

TEST_CASE_FIXTURE(Fixture, "--frames puts the number where the output's name has ### or %03d") {
  run_crt(folder, {"render", "ball.crt", "--frames", "7-8", "-o", "a###b.png"});
  run_crt(folder, {"render", "ball.crt", "--frames", "7", "-o", "c%05d.png"});
  run_crt(folder, {"render", "ball.crt", "--frames", "123", "-o", "d#.png"});
  CHECK(folder.names() == Names{"a007b.png", "a008b.png", "ball.crt", "c00007.png", "d123.png"});
}

TEST_CASE_FIXTURE(Fixture, "every setting of a script is an option") {
  const Outcome run = run_crt(folder, {"render",
                                       "ball.crt",
                                       "--width",
                                       "10",
                                       "--height",
                                       "8",
                                       "--gamma",
                                       "1",
                                       "--exposure",
                                       "-0.5",
                                       "--tonemap",
                                       "filmic",
                                       "--lightsamples",
                                       "2",
                                       "--indirect",
                                       "1",
                                       "--clamp",
                                       "10",
                                       "--supersampling",
                                       "2",
                                       "--dofsamples",
                                       "2",
                                       "--recursiondepth",
                                       "1",
                                       "--minweight",
                                       "0.01",
                                       "--falloffmodel",
                                       "path",
                                       "--ambientmodel",
                                       "light",
                                       "--showclip",
                                       "--seed",
                                       "7",
                                       "--projection",
                                       "spherical",
                                       "--title",
                                       "Quote \" and \\",
                                       "--author",
                                       "Ann",
                                       "--date",
                                       "today",
                                       "--notes",
                                       "none"});
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  CHECK(png_size(folder.read("ball.png")) == std::pair(10, 8));
}

TEST_CASE_FIXTURE(Fixture, "--region renders only that part, as a picture of its size") {
  const Outcome run = run_crt(folder, {"render", "ball.crt", "--region", "4,3,8,6"});
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  CHECK(png_size(folder.read("ball.png")) == std::pair(8, 6));
}

TEST_CASE_FIXTURE(Fixture, "--reproducible gives the same bytes for any number of threads") {
  run_crt(folder, {"render", "ball.crt", "--reproducible", "--threads", "1", "-o", "a.png"});
  run_crt(folder, {"render", "ball.crt", "--reproducible", "--threads", "3", "-o", "b.png"});
  REQUIRE(is_png(folder.read("a.png")));
  CHECK(folder.read("a.png") == folder.read("b.png"));
}

TEST_CASE_FIXTURE(Fixture, "--quiet says nothing when all is well") {
  folder.write("silent.crt",
               "Settings { width -> 8 height -> 8 }\nScene { Sphere { center -> vec3(0, 0, 3) "
               "radius -> 1 } }\n");
  const Outcome run = run_crt(folder, {"render", "silent.crt", "--quiet"});
  CHECK(run.exit_code == 0);
  CHECK(run.out.empty());
  CHECK(run.err.empty());
  CHECK(folder.has("silent.png"));
}

TEST_CASE_FIXTURE(Fixture, "--quiet leaves what the script prints") {
  CHECK(run_crt(folder, {"render", "ball.crt", "-q"}).out == "t is 0\nn is 3\n");
}

TEST_CASE_FIXTURE(Fixture,
                  "where standard error is no terminal, a short render shows no progress") {
  const Outcome run = run_crt(folder, {"render", "ball.crt"});
  CHECK_FALSE(contains(run.err, "%"));
  CHECK(contains(run.err, "16 x 12 pixels"));
  CHECK(std::none_of(run.err.begin(), run.err.end(),
                     [](char c) { return c == '\r' || c == '\033'; }));
}

TEST_CASE_FIXTURE(Fixture, "what is written to closed standard streams gets into no file") {
  run_crt(folder, {"render", "ball.crt", "--reproducible", "-o", "heard.png"});
  CHECK(run_crt_unheard(folder, {"render", "ball.crt", "--reproducible", "-o", "unheard.png"}) ==
        0);
  REQUIRE(is_png(folder.read("heard.png")));
  CHECK(folder.read("unheard.png") == folder.read("heard.png"));
}

TEST_CASE_FIXTURE(Fixture, "a picture of linear light is written as .exr") {
  const Outcome run = run_crt(folder, {"render", "ball.crt", "-o", "ball.exr"});
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  CHECK(folder.read("ball.exr").starts_with("\x76\x2f\x31\x01"));
}

TEST_CASE_FIXTURE(Fixture, "resources are found in the folders that --resources names") {
  folder.write("library/part.crt", "part = Sphere { center -> vec3(0, 0, 3) radius -> 1 }\n");
  folder.write("scenes/user.crt", "import \"/part.crt\"\nScene { part }\n");
  const std::vector<std::string> command = {"render", "scenes/user.crt", "--width",
                                            "8",      "--height",        "8"};
  CHECK(run_crt(folder, command).exit_code == 3);
  std::vector<std::string> with_library = command;
  with_library.insert(with_library.end(), {"--resources", "library"});
  const Outcome run = run_crt(folder, with_library);
  CHECK_MESSAGE(run.exit_code == 0, run.err);
}

TEST_CASE_FIXTURE(Fixture, "a section cuts the ball open, as a camera that says so") {
  const auto picture = [&](const std::vector<std::string>& more, const std::string& script) {
    std::vector<std::string> arguments = {"render", script, "-o", script + ".png",
                                          "--reproducible"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome run = run_crt(folder, arguments);
    CHECK_MESSAGE(run.exit_code == 0, run.err);
    return folder.read(script + ".png");
  };
  std::string open_script = ball_script;
  const std::string pointing = "pointing -> vec3(0, 0, 0) }";
  open_script.replace(open_script.find(pointing), pointing.size(),
                      "pointing -> vec3(0, 0, 0) sectionnormal -> vec3(0, 0, -2) "
                      "sectionoffset -> -0.25 }");
  folder.write("open.crt", open_script);
  const std::string whole = picture({}, "ball.crt");
  const std::string cut = picture({"--section", "0,0,-1=-0.25"}, "ball.crt");
  CHECK(cut != whole);
  CHECK(picture({}, "open.crt") == cut);
  CHECK(run_crt(folder, {"render", "ball.crt", "--section", "w=1"}).exit_code == 2);
}
