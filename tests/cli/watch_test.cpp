#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include "cli/command.hpp"
#include "cli/scenes.hpp"

using namespace crt::test;

namespace {

const std::string picture_done = "ball.png: 32 x 24 pixels";
const std::vector<std::string> watch_ball = {"watch",    "ball.crt", "--width",       "32",
                                             "--height", "24",       "--reproducible"};

bool contains(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

struct Fixture {
  TemporaryFolder folder;
  Fixture() {
    folder.write("radius.crt", "r = 1\n");
    write_ball("r");
  }

  void write_ball(const std::string& radius) const {
    folder.write("ball.crt",
                 "import \"radius.crt\"\n" +
                     std::string(ball_script).replace(ball_script.find("1.0"), 3, radius));
  }
};

}  // namespace

TEST_CASE_FIXTURE(Fixture, "watch makes a draft and then the picture that render makes") {
  CrtOnPipe crt(folder, watch_ball);
  REQUIRE(crt.shows(picture_done));
  const std::size_t draft = crt.shown().find("ball.png: a draft");
  REQUIRE(draft != std::string::npos);
  CHECK(draft < crt.shown().find(picture_done));
  std::vector<std::string> render_ball = watch_ball;
  render_ball[0] = "render";
  render_ball.insert(render_ball.end(), {"-o", "rendered.png"});
  REQUIRE(run_crt(folder, render_ball).exit_code == 0);
  CHECK(folder.read("ball.png") == folder.read("rendered.png"));
}

TEST_CASE_FIXTURE(Fixture, "watch renders again when the script or its import changes") {
  CrtOnPipe crt(folder, watch_ball);
  REQUIRE(crt.shows(picture_done));
  const std::string first = folder.read("ball.png");

  crt.forget();
  folder.write("radius.crt", "r = 0.5\n");
  REQUIRE(crt.shows(picture_done));
  const std::string second = folder.read("ball.png");
  CHECK(second != first);

  crt.forget();
  write_ball("2 * r");
  REQUIRE(crt.shows(picture_done));
  CHECK(folder.read("ball.png") == first);
}

TEST_CASE_FIXTURE(Fixture, "watch goes on over errors, and renders when they are mended") {
  CrtOnPipe crt(folder, watch_ball);
  REQUIRE(crt.shows(picture_done));
  const std::string first = folder.read("ball.png");

  crt.forget();
  folder.write("radius.crt", "r = = 1\n");
  REQUIRE(crt.shows("radius.crt:1:"));
  CHECK(folder.read("ball.png") == first);

  // An import that is missing is waited for.
  crt.forget();
  std::filesystem::remove(folder.path() / "radius.crt");
  REQUIRE(crt.shows("there is no file 'radius.crt'"));

  crt.forget();
  folder.write("radius.crt", "r = 0.5\n");
  REQUIRE(crt.shows(picture_done));
  CHECK(folder.read("ball.png") != first);
}

TEST_CASE("a change during a long render begins it anew") {
  const TemporaryFolder folder;
  // This takes minutes, as each of its pixels has thousands of samples.
  std::string long_script = endless_script;
  long_script.replace(long_script.find("t < 0.5 ? 4 : 8000"), 18, "400");
  folder.write("scene.crt", long_script);
  CrtOnPipe crt(folder, {"watch", "scene.crt"});
  REQUIRE(crt.shows("a draft"));
  crt.forget();
  folder.write("scene.crt", endless_script);
  CHECK(crt.shows("scene.png: 4 x 4 pixels"));
}

TEST_CASE("a picture that takes long is seen in progress, over its draft") {
  const TemporaryFolder folder;
  // White is all around, and what is drawn of it takes minutes.
  std::string white_script = endless_script;
  white_script.replace(white_script.find("t < 0.5 ? 4 : 8000"), 18, "400");
  white_script.replace(white_script.find("camera"), 0,
                       "background -> Background { color -> rgb(1, 1, 1) } ");
  folder.write("scene.crt", white_script);
  CrtOnPipe run(folder, {"watch", "scene.crt", "--reproducible"});
  REQUIRE(run.shows("a draft"));
  const std::string draft = folder.read("scene.png");
  constexpr int looks = 600;
  std::string progress = draft;
  for (int i = 0; i < looks && progress == draft; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    progress = folder.read("scene.png");
  }
  CHECK(progress != draft);
  CHECK_FALSE(contains(run.shown(), "scene.png: 400 x 400 pixels"));
  // What is not yet rendered is as opaque as the draft, and so the file has no alpha.
  CHECK(contains(shell(folder, "oiiotool --info scene.png"), "400 x  400, 3 channel"));
}

TEST_CASE_FIXTURE(Fixture, "a script that is not there is waited for") {
  const std::string script = folder.read("ball.crt");
  std::filesystem::remove(folder.path() / "ball.crt");
  CrtOnPipe crt(folder, watch_ball);
  REQUIRE(crt.shows("waiting for the script 'ball.crt'"));
  CHECK_FALSE(folder.has("ball.png"));
  folder.write("ball.crt", script);
  CHECK(crt.shows(picture_done));
}

TEST_CASE_FIXTURE(Fixture, "a draft does not warn of what it leaves out") {
  std::string script = folder.read("ball.crt");
  script.replace(script.find("vec3(0, 0, -4)"), 14, "vec3(0, 0, -4) aperture -> 1");
  script.replace(script.find("width"), 5, "dofsamples -> 4 width");
  folder.write("ball.crt", script);
  CrtOnPipe crt(folder, watch_ball);
  REQUIRE(crt.shows(picture_done));
  CHECK_FALSE(contains(crt.shown(), "warning"));
}

TEST_CASE_FIXTURE(Fixture, "an interrupt ends watch with 0, and leaves the picture alone") {
  for (const int signal : {SIGINT, SIGTERM}) {
    CrtOnPipe crt(folder, watch_ball);
    REQUIRE(crt.shows(picture_done));
    crt.send(signal);
    CHECK(crt.wait() == 0);
  }
  CHECK(folder.names() == std::vector<std::string>{"ball.crt", "ball.png", "radius.crt"});
}

TEST_CASE_FIXTURE(Fixture, "what cannot be watched ends at once") {
  CHECK(run_crt(folder, {"watch", "-"}).exit_code == 2);
  CHECK(run_crt(folder, {"watch", "ball.crt", "-o", "ball.crt"}).exit_code == 2);
  CHECK(run_crt(folder, {"watch", "ball.crt", "-o", "ball.xyz"}).exit_code == 2);
  CHECK(run_crt(folder, {"watch", "ball.crt", "-o", "no/ball.png"}).exit_code == 3);
}
