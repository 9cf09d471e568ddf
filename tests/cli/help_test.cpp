#include <doctest/doctest.h>

#include <string>

#include "cli/command.hpp"

using namespace crt::test;

TEST_CASE("--help and --version are no errors and go to standard output") {
  const TemporaryFolder folder;
  for (const char* option : {"--help", "-h", "--version"}) {
    const Outcome run = run_crt(folder, {option});
    CHECK(run.exit_code == 0);
    CHECK_FALSE(run.out.empty());
    CHECK(run.err.empty());
  }
  CHECK(run_crt(folder, {"--version"}).out.starts_with("crt "));
}

TEST_CASE("the help teaches by examples and tells the exit codes") {
  const TemporaryFolder folder;
  const std::string help = run_crt(folder, {"--help"}).out;
  for (const char* piece : {"crt render scene.crt", "--set", "--frames", "crt check", "130"}) {
    CHECK_MESSAGE(help.find(piece) != std::string::npos, piece);
  }
}

TEST_CASE("the help of render lists every setting by its script name") {
  const TemporaryFolder folder;
  const std::string help = run_crt(folder, {"render", "--help"}).out;
  for (const char* name :
       {"--width",          "--height",     "--gamma",        "--supersampling", "--dofsamples",
        "--recursiondepth", "--minweight",  "--falloffmodel", "--ambientmodel",  "--headlight",
        "--showclip",       "--seed",       "--targeterror",  "--timebudget",    "--minsamples",
        "--maxsamples",     "--filter",     "--filterwidth",  "--passes",        "--checkpoint",
        "--precision",      "--projection", "--title",        "--author",        "--date",
        "--notes",          "--exposure",   "--tonemap",      "--lightsamples",  "--indirect",
        "--clamp"}) {
    CHECK_MESSAGE(help.find(name) != std::string::npos, name);
  }
}
