#include <doctest/doctest.h>

#include <csignal>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/scenes.hpp"

using namespace crt::test;

namespace fs = std::filesystem;

namespace {

constexpr int interrupted = 130;
const std::string first_sight_of_bar = "0 %";

}  // namespace

TEST_CASE("an interrupt while rendering ends with 130 and leaves no file" * doctest::skip(!has_terminals())) {
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
  const std::vector<std::string> to_picture = {"render", "mirrors.crt", "--passes", "8", "--reproducible"};
  const TemporaryFolder folder;
  folder.write("mirrors.crt", mirrors_script);
  std::vector<std::string> whole = to_picture;
  whole.insert(whole.end(), {"-o", "whole.png"});
  REQUIRE(run_crt(folder, whole).exit_code == 0);

  std::vector<std::string> command = to_picture;
  command.insert(command.end(), {"-o", "part.png", "--checkpoint", "part.state"});
  for (const int signal : {SIGINT, SIGTERM}) {
    // At once, and within the first pass, going on from there.
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
    CHECK(folder.names() == std::vector<std::string>{"mirrors.crt", "part.png", "part.state", "whole.png"});
    fs::remove(folder.path() / "part.png");
    fs::remove(folder.path() / "part.state");
  }
}

TEST_CASE("an interrupted animation keeps the frames that are done" * doctest::skip(!has_terminals())) {
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
