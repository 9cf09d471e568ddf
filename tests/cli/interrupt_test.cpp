#include <doctest/doctest.h>

#include <csignal>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/scenes.hpp"

using namespace crt::test;

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
