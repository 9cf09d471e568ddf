// These tests check where the command's outputs go, and what it reports when they do not get there.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <string>
#include <thread>
#include <vector>

#include "cli/command.hpp"
#include "cli/scenes.hpp"

using namespace crt::test;

namespace fs = std::filesystem;

namespace {

constexpr int files = 3;  // what the command ends with
// This device takes nothing. Tests write to it as a standard stream alone, which cannot replace it.
const std::string full = "/dev/full";

struct Fixture {
  TemporaryFolder folder;
  Fixture() { folder.write("ball.crt", ball_script); }
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE_FIXTURE(Fixture, "what standard output does not take is an error") {
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{"--help"},
                                             {"--version"},
                                             {"render", "--help"},
                                             {"check", "ball.crt"},
                                             {"render", "ball.crt", "-q"},  // which prints
                                             {"render", "ball.crt", "-q", "--stats", "-"}}) {
    const Outcome run = run_crt_into(folder, command, full, "");
    CHECK_MESSAGE(run.exit_code == files, command.back());
    CHECK(contains(run.err, "cannot write to standard output: No space left on device"));
    CHECK(run.err.find("cannot write") == run.err.rfind("cannot write"));  // once
  }
  CHECK(folder.has("ball.png"));  // what could be done is done
}

TEST_CASE_FIXTURE(Fixture, "what standard error does not take shows in the exit code") {
  CHECK(run_crt_into(folder, {"check", "ball.crt", "--diagnostics", "json"}, "", full).exit_code ==
        files);
  CHECK(run_crt_into(folder, {"check", "ball.crt"}, full, full).exit_code == files);
  folder.write("wrong.crt", "Scene { Spere {} }");
  CHECK(run_crt_into(folder, {"check", "wrong.crt"}, "", full).exit_code == 1);
}

TEST_CASE_FIXTURE(Fixture, "what is asked for on a standard output that is closed is an error") {
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"--help"}, {"--version"}, {"render", "ball.crt", "-q", "--stats", "-"}}) {
    const Outcome run = run_crt_without_output(folder, command);
    CHECK_MESSAGE(run.exit_code == files, command.back());
    CHECK(contains(run.err, "cannot write to standard output"));
  }
  CHECK(
      run_crt_without_output(folder, {"render", "ball.crt", "--stats", "/dev/stdout"}).exit_code ==
      files);
  CHECK(run_crt_without_output(folder, {"render", "ball.crt"}).exit_code == 0);
  CHECK(run_crt_without_output(folder, {"check", "ball.crt"}).exit_code == 0);
}

TEST_CASE_FIXTURE(Fixture,
                  "statistics and pictures go into pipes, through links, and leave both there") {
  for (const char* pipe : {"stats", "picture.ppm"}) {
    REQUIRE(mkfifo((folder.path() / pipe).c_str(), 0600) == 0);
  }
  fs::create_symlink("later.exr", folder.path() / "link.exr");
  std::string stats;
  std::thread reader([&] { stats = folder.read("stats"); });
  const Outcome run = run_crt(folder, {"render", "ball.crt", "-o", "link.exr", "--stats", "stats"});
  reader.join();
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  CHECK(contains(stats, "\"version\""));
  CHECK(fs::is_symlink(folder.path() / "link.exr"));
  CHECK(folder.read("later.exr").starts_with("\x76\x2f\x31\x01"));

  std::string picture;
  std::thread viewer([&] { picture = folder.read("picture.ppm"); });
  CHECK(run_crt(folder, {"render", "ball.crt", "-o", "picture.ppm"}).exit_code == 0);
  viewer.join();
  CHECK(picture.starts_with("P6"));
  CHECK(folder.names() ==
        std::vector<std::string>{"ball.crt", "later.exr", "link.exr", "picture.ppm", "stats"});
  CHECK(fs::is_fifo(folder.path() / "stats"));
  CHECK(fs::is_fifo(folder.path() / "picture.ppm"));
}

TEST_CASE_FIXTURE(Fixture, "a picture that is rendered again keeps its permissions") {
  folder.write("ball.png", "old");
  REQUIRE(chmod((folder.path() / "ball.png").c_str(), 0604) == 0);
  CHECK(run_crt(folder, {"render", "ball.crt"}).exit_code == 0);
  CHECK((fs::status(folder.path() / "ball.png").permissions() & fs::perms::mask) ==
        fs::perms(0604));
}
