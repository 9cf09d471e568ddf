// The command loads OpenImageIO, which takes longer than a small picture, only for files that need
// it. The dynamic linker says what is loaded.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/scenes.hpp"

using namespace crt::test;

namespace {

/// Runs `crt`, and says whether OpenImageIO was loaded.
bool loads_openimageio(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                       int exit_code) {
  const TemporaryFolder logs;
  const Outcome run = run_crt_in(
      {.environment = {"LD_DEBUG=files", "LD_DEBUG_OUTPUT=" + (logs.path() / "log").string()}},
      folder, arguments);
  CHECK_MESSAGE(run.exit_code == exit_code, run.err);
  REQUIRE(logs.names().size() == 1);
  const std::string log = logs.read(logs.names().front());
  REQUIRE(log.find("libtbb") != std::string::npos);
  return log.find("libOpenImageIO") != std::string::npos;
}

}  // namespace

TEST_CASE("a wrong script and a PNG file load no OpenImageIO, and other formats do") {
  const TemporaryFolder folder;
  folder.write("ball.crt", ball_script);
  folder.write("wrong.crt", "Scene { Spere {} }");
  CHECK_FALSE(loads_openimageio(folder, {"render", "wrong.crt", "-o", "wrong.jpg"}, 1));
  CHECK_FALSE(loads_openimageio(folder, {"render", "ball.crt"}, 0));
  CHECK_FALSE(loads_openimageio(folder, {"render", "ball.crt", "-o", "ball.xyz"}, 2));
  CHECK(loads_openimageio(folder, {"render", "ball.crt", "-o", "ball.jpg"}, 0));
}
