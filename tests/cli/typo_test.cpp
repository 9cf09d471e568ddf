// What is misspelt on the command line gets a suggestion.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/scenes.hpp"

using namespace crt::test;

namespace {

bool contains(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

}  // namespace

TEST_CASE("a misspelt option is named as it was written, with the one that was meant") {
  const TemporaryFolder folder;
  folder.write("ball.crt", ball_script);
  const std::vector<std::vector<std::string>> mistakes = {
      {"--widht", "--width"},  {"--hieght", "--height"}, {"--suppersampling", "--supersampling"},
      {"--frame", "--frames"}, {"--qiet", "--quiet"},
  };
  for (const auto& mistake : mistakes) {
    const Outcome run = run_crt(folder, {"render", "ball.crt", mistake[0], "100"});
    CAPTURE(run.err);
    CHECK(run.exit_code == 2);
    CHECK(contains(run.err, "'crt render' has no option " + mistake[0] + "; did you mean " +
                                mistake[1] + "?"));
  }
  CHECK(contains(run_crt(folder, {"render", "ball.crt", "--widht=100"}).err, "--width?"));
  CHECK(contains(run_crt(folder, {"check", "ball.crt", "--sett", "n=1"}).err, "--set?"));
}

TEST_CASE("an unknown option is refused before help is given") {
  const TemporaryFolder folder;
  folder.write("ball.crt", ball_script);
  const Outcome run = run_crt(folder, {"render", "ball.crt", "-w", "100", "-h", "100"});
  CHECK(run.exit_code == 2);
  CHECK(run.out.empty());
  CHECK(contains(run.err, "'crt render' has no option -w; did you mean --width?"));
  CHECK(run_crt(folder, {"render", "ball.crt", "-h"}).exit_code == 0);
  // Any other letter is as near to a letter.
  const Outcome other = run_crt(folder, {"render", "ball.crt", "-z", "100"});
  CHECK(contains(other.err, "has no option -z\n"));
}

TEST_CASE("what is like no option gets no suggestion") {
  const TemporaryFolder folder;
  const Outcome run = run_crt(folder, {"render", "ball.crt", "--xylophone"});
  CHECK(run.exit_code == 2);
  CHECK(contains(run.err, "'crt render' has no option --xylophone\n"));
  CHECK_FALSE(contains(run.err, "did you mean"));
}

TEST_CASE("a misspelt command gets the one that was meant, or the list of all") {
  const TemporaryFolder folder;
  CHECK(contains(run_crt(folder, {"rednder", "ball.crt"}).err,
                 "no command 'rednder'; did you mean render?"));
  CHECK(contains(run_crt(folder, {"chek", "ball.crt"}).err, "did you mean check?"));
  CHECK(contains(run_crt(folder, {"help", "wacth"}).err, "did you mean watch?"));
  const Outcome run = run_crt(folder, {"xylophone"});
  CHECK(run.exit_code == 2);
  CHECK(contains(run.err, "there are render, farm, watch, "));
}

TEST_CASE("an option for which there is something else is answered by that") {
  const TemporaryFolder folder;
  for (const char* command : {"render", "watch", "studio"}) {
    const Outcome run = run_crt(folder, {command, "a.crt", "--display", "127.0.0.1:14158"});
    CHECK(run.exit_code == 2);
    CHECK(contains(run.err, "has no option --display: crt watch shows a picture in progress"));
  }
  CHECK(contains(run_crt(folder, {"render", "a.crt", "--show"}).err,
                 "has no option --show: crt render scene.crt -o - | chafa shows"));
}

TEST_CASE("a word too many is named") {
  const TemporaryFolder folder;
  const Outcome run = run_crt(folder, {"trade", "a.crt", "b.crt"});
  CHECK(run.exit_code == 2);
  CHECK(contains(run.err, "'b.crt' is one word too many for 'crt trade'"));
}
