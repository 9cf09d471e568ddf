// These tests run scripts of 2015 on the command line, with --compat.
#include <doctest/doctest.h>

#include <string>

#include "cli/command.hpp"
#include "cli/json.hpp"

using namespace crt::test;

namespace {

const std::string old_script = R"(in = 2
Settings { width -> 1 height -> 1 background -> Background { color -> rgb(0.999, 0.5, 1) } }
Scene { Sphere { center -> vec3(0, 0, 50) radius -> in shade -> 0.5 } }
)";

bool contains(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

struct Fixture {
  TemporaryFolder folder;
  Fixture() { folder.write("old.crt", old_script); }
};

/// Returns the bytes of a binary PPM file's one pixel.
std::string pixel_of(const std::string& ppm) {
  return ppm.substr(ppm.size() - 3);
}

}  // namespace

TEST_CASE_FIXTURE(Fixture, "a script of 2015 is an error without --compat, and renders with it") {
  CHECK(run_crt(folder, {"render", "old.crt"}).exit_code == 1);
  const Outcome run = run_crt(folder, {"render", "old.crt", "--compat", "2015", "-o", "old.ppm",
                                       "--stats", "old.json", "--region", "0,0,1,1"});
  REQUIRE_MESSAGE(run.exit_code == 0, run.err);
  CHECK(contains(run.err, "old.crt:3:56: warning: unknown attribute 'shade' is passed over"));
  CHECK(parse_json(folder.read("old.json"))["settings"]["compat"].number == 2015);
}

TEST_CASE_FIXTURE(Fixture,
                  "--compat cuts the file's 8-bit values, and 0 turns a script's own mode off") {
  folder.write("plain.crt",
               "Settings { compat -> 2015 width -> 1 height -> 1 "
               "background -> Background { color -> rgb(0.999, 0.5, 1) } }\nScene { }\n");
  REQUIRE(run_crt(folder, {"render", "plain.crt", "-o", "cut.ppm"}).exit_code == 0);
  REQUIRE(
      run_crt(folder, {"render", "plain.crt", "-o", "rounded.ppm", "--compat", "0"}).exit_code ==
      0);
  CHECK(pixel_of(folder.read("cut.ppm")) == "\xfe\x7f\xff");
  // It has the gamma of today, too: 0.5^(1 / 2.2) is 186.1 of 255 steps.
  CHECK(pixel_of(folder.read("rounded.ppm")) == "\xff\xba\xff");
}

TEST_CASE_FIXTURE(Fixture, "check and trade take --compat, too") {
  CHECK(run_crt(folder, {"check", "old.crt"}).exit_code == 1);
  CHECK(run_crt(folder, {"check", "old.crt", "--compat", "2015"}).exit_code == 0);
  const Outcome trade =
      run_crt(folder, {"trade", "old.crt", "--compat", "2015", "--reference-samples", "4"});
  CHECK_MESSAGE(trade.exit_code == 0, trade.err);
  for (const char* command : {"render", "check", "trade"}) {
    CHECK(contains(run_crt(folder, {command, "--help"}).out, "--compat"));
  }
}

TEST_CASE_FIXTURE(Fixture, "a year that there is not is a wrong command line") {
  for (const char* year : {"2014", "", "old", "2015.5"}) {
    const Outcome run = run_crt(folder, {"check", "old.crt", "--compat", year});
    CHECK(run.exit_code == 2);
    CHECK(contains(run.err, "--compat needs 2015, or 0 for none"));
  }
}
