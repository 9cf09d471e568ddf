// A picture is shown in the terminal by what that terminal can do.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "cli/command.hpp"
#include "cli/scenes.hpp"

using namespace crt::test;

namespace {

const std::string half_block = "\u2580";

std::size_t count_of(const std::string& text, const std::string& piece) {
  std::size_t count = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1))
    ++count;
  return count;
}

struct Fixture {
  TemporaryFolder folder;
  Fixture() {
    // The left half is black and the right one green, at any size.
    folder.write("halves.crt", R"(Settings {
  width -> 16
  height -> 12
  camera -> Camera { position -> vec3(0, 0, -4) pointing -> vec3(0, 0, 0) }
  background -> Background { color -> rgb(0, 1, 0) }
}
Scene {
  Box { cornerA -> vec3(-9, -9, 0) cornerB -> vec3(0, 9, 1) }
}
)");
  }
};

}  // namespace

TEST_CASE_FIXTURE(Fixture, "what is no terminal gets characters that have two pixels each") {
  const Outcome run = run_crt(folder, {"render", "halves.crt", "--show"});
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  CHECK(count_of(run.out, half_block) == 16 * 12 / 2);
  CHECK(count_of(run.out, "\n") == 12 / 2);
  const std::string green = "\033[38;2;0;255;0m\033[48;2;0;255;0m";
  CHECK(count_of(run.out, green) == 8 * 12 / 2);
  CHECK(folder.has("halves.png"));
}

TEST_CASE_FIXTURE(Fixture, "a picture that is too wide is made to fit 80 columns") {
  const Outcome run =
      run_crt(folder, {"render", "halves.crt", "--show", "--width", "320", "--height", "240"});
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  CHECK(count_of(run.out, half_block) == 80 * 60 / 2);
}

TEST_CASE_FIXTURE(Fixture, "a terminal with kitty's protocol gets a PNG file in base64" *
                               doctest::skip(!has_terminals())) {
  CrtOnTerminal crt(folder, {"render", "halves.crt", "--show"}, CrtOnTerminal::Streams::all,
                    {"TERM=xterm-kitty"});
  CHECK(crt.wait() == 0);
  CHECK(count_of(crt.shown(), "\033_Ga=T,f=100,m=0;iVBORw0KGgo") == 1);
  CHECK(count_of(crt.shown(), half_block) == 0);
}

TEST_CASE_FIXTURE(Fixture, "a terminal that answers nothing gets characters" *
                               doctest::skip(!has_terminals())) {
  CrtOnTerminal crt(folder, {"render", "halves.crt", "--show"}, CrtOnTerminal::Streams::all,
                    {"TERM=xterm", "KITTY_WINDOW_ID=", "TERM_PROGRAM="});
  CHECK(crt.wait() == 0);
  CHECK(count_of(crt.shown(), half_block) == 16 * 12 / 2);
}
