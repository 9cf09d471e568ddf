#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include "cli/command.hpp"
#include "cli/scenes.hpp"

using namespace crt::test;

namespace fs = std::filesystem;

namespace {

constexpr int interrupted = 130;
const std::string first_sight_of_bar = "0 %";

/// This script prints "made", and then takes long to prepare: half a million balls that overlap.
const std::string crowd_script = R"(i = 0
u = Sphere { center -> vec3(0, 0, 0) radius -> 1 }
n = 19
for (i in range(n)) { u = u + u <translate vec3(0.000000001 * pow(2, i), 0, 0)> }
Settings {
  width -> 4
  height -> 4
  camera -> Camera { position -> vec3(0, 0, -4) pointing -> vec3(0, 0, 0) }
}
Scene { u }
print("made")
)";

/// Returns the time until the command has ended after a signal. Bounds below are generous: what is
/// promised is 0.1 s.
double seconds_to_end(CrtOnTerminal& crt, int signal) {
  const auto begin = std::chrono::steady_clock::now();
  crt.send(signal);
  CHECK(crt.wait() == interrupted);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

TEST_CASE("an interrupt while preparing ends with 130 and leaves no file" *
          doctest::skip(!has_terminals())) {
  const TemporaryFolder folder;
  folder.write("crowd.crt", crowd_script);
  // What the script prints goes to the terminal as well.
  CrtOnTerminal crt(folder, {"render", "crowd.crt", "--stats", "-"});
  REQUIRE(crt.shows("made"));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  CHECK(seconds_to_end(crt, SIGTERM) < 5);
  CHECK(crt.shown().find("not written") != std::string::npos);
  CHECK(folder.names() == std::vector<std::string>{"crowd.crt"});
}

TEST_CASE("an interrupt in a ray that meets 100,000 things ends it at once" *
          doctest::skip(!has_terminals())) {
  for (const char* const setting : {"supersampling -> 1", "supersampling -> 64"}) {
    const TemporaryFolder folder;
    std::string script = crowd_script;
    script.replace(script.find("n = 19"), 6, "n = 17");
    script.replace(script.find("width -> 4"), 10, std::string("width -> 400 ") + setting);
    folder.write("crowd.crt", script);
    CrtOnTerminal crt(folder, {"render", "crowd.crt"});
    REQUIRE(crt.shows(first_sight_of_bar));
    CHECK(seconds_to_end(crt, SIGINT) < 2);
    CHECK(crt.shown().find("not written") != std::string::npos);
  }
}

TEST_CASE("an interrupt while rendering ends with 130 and leaves no file" *
          doctest::skip(!has_terminals())) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const TemporaryFolder folder;
    folder.write("endless.crt", endless_script);
    CrtOnTerminal crt(folder, {"render", "endless.crt", "--time", "1", "--stats", "stats.json"});
    REQUIRE(crt.shows(first_sight_of_bar));
    crt.send(signal);
    CHECK(crt.wait() == interrupted);
    CHECK(crt.shown().find("not written") != std::string::npos);
    CHECK(folder.names() == std::vector<std::string>{"endless.crt"});
  }
}

TEST_CASE("an interrupt at any time leaves a checkpoint, from which the same picture comes" *
          doctest::skip(!has_terminals())) {
  const std::vector<std::string> to_picture = {"render", "mirrors.crt", "--passes", "8",
                                               "--reproducible"};
  const TemporaryFolder folder;
  folder.write("mirrors.crt", mirrors_script);
  std::vector<std::string> whole = to_picture;
  whole.insert(whole.end(), {"-o", "whole.png"});
  REQUIRE(run_crt(folder, whole).exit_code == 0);

  std::vector<std::string> command = to_picture;
  command.insert(command.end(), {"-o", "part.png", "--checkpoint", "part.state"});
  for (const int signal : {SIGINT, SIGTERM}) {
    // The signal comes at once, and within the first pass of the render that continues.
    for (const char* sight : {"0 %", "[#"}) {
      CrtOnTerminal crt(folder, command);
      REQUIRE(crt.shows(sight));
      crt.send(signal);
      CHECK(crt.wait() == interrupted);
      CHECK(crt.shown().find("goes on from its --checkpoint 'part.state'") != std::string::npos);
      CHECK(folder.has("part.state"));
      CHECK_FALSE(folder.has("part.png"));
    }
    CHECK(run_crt(folder, command).exit_code == 0);
    CHECK(folder.read("part.png") == folder.read("whole.png"));
    CHECK(folder.names() ==
          std::vector<std::string>{"mirrors.crt", "part.png", "part.state", "whole.png"});
    fs::remove(folder.path() / "part.png");
    fs::remove(folder.path() / "part.state");
  }
}

TEST_CASE("an interrupted animation keeps the frames that are done" *
          doctest::skip(!has_terminals())) {
  const TemporaryFolder folder;
  folder.write("film.crt", endless_script);
  CrtOnTerminal crt(folder, {"render", "film.crt", "--frames", "0-2"});
  REQUIRE(crt.shows("film_0001.png"));
  crt.send(SIGINT);
  CHECK(crt.wait() == interrupted);
  CHECK(folder.names() == std::vector<std::string>{"film.crt", "film_0000.png"});
}

TEST_CASE("on a terminal progress is a bar that goes away" * doctest::skip(!has_terminals())) {
  const TemporaryFolder folder;
  folder.write("ball.crt", ball_script);
  CrtOnTerminal crt(folder, {"render", "ball.crt"});
  CHECK(crt.wait() == 0);
  const std::string erase_line = "\r\033[K";
  const std::size_t bar = crt.shown().find("ball.png [");
  const std::size_t erased = crt.shown().rfind(erase_line);
  REQUIRE(bar != std::string::npos);
  REQUIRE(erased != std::string::npos);
  CHECK(bar < erased);
}
