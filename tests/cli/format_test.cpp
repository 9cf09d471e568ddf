#include <doctest/doctest.h>
#include <sys/stat.h>

#include <string>

#include "cli/command.hpp"

using namespace crt::test;

TEST_CASE("format lays the scripts out where they are, and leaves those that are right alone") {
  const TemporaryFolder folder;
  folder.write("a.crt", "x=1\n");
  folder.write("b.crt", "x = 1\n");
  const Outcome run = run_crt(folder, {"format", "a.crt", "b.crt"});
  CHECK(run.exit_code == 0);
  CHECK(run.out.empty());
  CHECK(folder.read("a.crt") == "x = 1\n");
  CHECK(folder.read("b.crt") == "x = 1\n");
}

TEST_CASE("format --check names what would change, changes nothing, and ends with 1") {
  const TemporaryFolder folder;
  folder.write("a.crt", "x=1\n");
  folder.write("b.crt", "x = 1\n");
  const Outcome run = run_crt(folder, {"format", "--check", "a.crt", "b.crt"});
  CHECK(run.exit_code == 1);
  CHECK(run.out == "a.crt: not formatted\n");
  CHECK(folder.read("a.crt") == "x=1\n");
  CHECK(run_crt(folder, {"format", "--check", "b.crt"}).exit_code == 0);
}

TEST_CASE("format reports syntax errors and leaves the script as it is") {
  const TemporaryFolder folder;
  folder.write("a.crt", "x=(\n");
  const Outcome run = run_crt(folder, {"format", "a.crt"});
  CHECK(run.exit_code == 1);
  CHECK(run.err.find("a.crt:1:3: error") == 0);
  CHECK(folder.read("a.crt") == "x=(\n");
}

TEST_CASE("format waits for no pipe, and reads no input that is too long to the end") {
  const TemporaryFolder folder;
  REQUIRE(mkfifo((folder.path() / "pipe.crt").c_str(), 0600) == 0);
  CHECK(run_crt(folder, {"format", "pipe.crt"}).exit_code == 3);
  const std::string too_long((std::size_t{64} << 20) + 1, ' ');
  const Outcome run = run_crt_in({.input = too_long}, folder, {"format", "-"});
  CHECK(run.exit_code == 1);
  CHECK(run.err.find("too long") != std::string::npos);
}

TEST_CASE("format ends with 3 for what it cannot read") {
  const TemporaryFolder folder;
  const Outcome run = run_crt(folder, {"format", "none.crt"});
  CHECK(run.exit_code == 3);
  CHECK(run.err.find("none.crt") != std::string::npos);
}

TEST_CASE("format - goes from standard input to standard output") {
  const TemporaryFolder folder;
  const Outcome run = run_crt(folder, {"format", "-"});  // the input is empty
  CHECK(run.exit_code == 0);
  CHECK(run.out.empty());
}

TEST_CASE("the language server ends with 1 where its client ends without a shutdown") {
  const TemporaryFolder folder;
  CHECK(run_crt(folder, {"lsp"}).exit_code == 1);
  CHECK(run_crt(folder, {"lsp", "--stdio"}).exit_code == 1);
}
