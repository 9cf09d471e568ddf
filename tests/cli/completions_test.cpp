// Completions, the manual page and the help come from the table of options.
#include <doctest/doctest.h>

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/scenes.hpp"

using namespace crt::test;

namespace {

bool contains(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

/// Returns the long options that the help of a command lists.
std::vector<std::string> options_of(const TemporaryFolder& folder, const std::string& command) {
  std::vector<std::string> names;
  std::istringstream help(run_crt(folder, {command, "--help"}).out);
  for (std::string line; std::getline(help, line);) {
    if (!line.starts_with("  -")) continue;
    const std::size_t begin = line.find("--");
    names.push_back(line.substr(begin + 2, line.find_first_of(" ,", begin) - begin - 2));
  }
  return names;
}

/// Returns what bash offers after these words, the last of which is being typed.
std::string completed(const TemporaryFolder& folder, const std::string& words) {
  folder.write("completions", run_crt(folder, {"completions", "bash"}).out);
  const std::string script = "cd '" + folder.path().string() + "'; . ./completions; COMP_WORDS=(" +
                             words +
                             "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _crt; "
                             "echo ${COMPREPLY[@]} >offered";
  folder.write("script", script);
  const std::string line = "bash '" + (folder.path() / "script").string() + "'";
  CHECK(std::system(line.c_str()) == 0);  // NOLINT(cert-env33-c): the words are this test's own
  return folder.read("offered");
}

const char* const commands[] = {"render", "farm",        "watch", "trade",
                                "check",  "completions", "man",   "help"};

}  // namespace

TEST_CASE("completions and the manual page have every command and every option of the help") {
  const TemporaryFolder folder;
  const std::string bash = run_crt(folder, {"completions", "bash"}).out;
  const std::string zsh = run_crt(folder, {"completions", "zsh"}).out;
  const std::string fish = run_crt(folder, {"completions", "fish"}).out;
  const std::string man = run_crt(folder, {"man"}).out;
  for (const std::string command : commands) {
    CAPTURE(command);
    CHECK(contains(bash, "\n    " + command + ")\n"));
    CHECK(contains(zsh, "\n        " + command + ")\n"));
    CHECK(contains(fish, "-a " + command + " -d "));
    CHECK(contains(man, ".SS crt " + command + "\n"));
    const std::vector<std::string> options = options_of(folder, command);
    REQUIRE(options.size() >= 1);
    for (const std::string& option : options) {
      CAPTURE(option);
      std::string in_man = option;
      for (std::size_t at = in_man.find('-'); at != std::string::npos;
           at = in_man.find('-', at + 2))
        in_man.insert(at, "\\");
      CHECK(contains(bash, "--" + option));
      CHECK(contains(zsh, "--" + option));
      CHECK(contains(fish, "'__fish_seen_subcommand_from " + command + "'"));
      CHECK(contains(fish, " -l " + option + " "));
      CHECK(contains(man, "\\fB\\-\\-" + in_man + "\\fR"));
    }
  }
  CHECK(options_of(folder, "render").size() > 40);
}

TEST_CASE("bash completes commands, options, choices and files") {
  const TemporaryFolder folder;
  folder.write("ball.crt", ball_script);
  folder.write("sky.png", "");
  folder.write("parts/part.crt", "");
  CHECK(completed(folder, "crt ch") == "check\n");
  CHECK(completed(folder, "crt render --wid") == "--width\n");
  CHECK(completed(folder, "crt render --diagnostics ''") == "text json\n");
  CHECK(completed(folder, "crt completions ''") == "bash zsh fish\n");
  CHECK(completed(folder, "crt render --resources ''") == "parts\n");
  CHECK(completed(folder, "crt render b") == "ball.crt\n");
  CHECK(completed(folder, "crt render -o s") == "sky.png script\n");
  CHECK(completed(folder, "crt render --width ''") == "\n");
  CHECK_FALSE(contains(completed(folder, "crt check ''"), "sky.png"));
}

TEST_CASE("a shell that is not known is refused with those that are") {
  const TemporaryFolder folder;
  const Outcome run = run_crt(folder, {"completions", "tcsh"});
  CHECK(run.exit_code == 2);
  CHECK(contains(run.err, "bash, zsh or fish"));
}

TEST_CASE("crt help is the help of crt, and with a command that command's") {
  const TemporaryFolder folder;
  CHECK(run_crt(folder, {"help"}).out == run_crt(folder, {"--help"}).out);
  for (const std::string command : commands) {
    const Outcome run = run_crt(folder, {"help", command});
    CHECK(run.exit_code == 0);
    CHECK(run.out == run_crt(folder, {command, "--help"}).out);
  }
  CHECK(contains(run_crt(folder, {"help", "render"}).out, "--supersampling"));
}
