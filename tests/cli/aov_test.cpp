// These tests run crt render --aov. They check what gets into the file, as OpenImageIO's own tool
// reads it, and what is refused.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "command.hpp"
#include "scenes.hpp"

using namespace crt::test;

namespace {

bool holds(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

/// Returns what `oiiotool` prints (the CMake package of OpenImageIO cannot be used without it).
std::string oiiotool(const TemporaryFolder& folder, const std::string& arguments) {
  const std::string command =
      "cd '" + folder.path().string() + "' && oiiotool " + arguments + " >tool.txt 2>&1";
  CHECK(std::system(command.c_str()) == 0);  // NOLINT(cert-env33-c): the words are this test's own
  return folder.read("tool.txt");
}

/// Returns depth, the normal's z and the green of the albedo in a pixel of ball.exr.
std::vector<double> numbers_at(const TemporaryFolder& folder, const std::string& pixel) {
  oiiotool(folder, "ball.exr --ch Z,N.Z,albedo.G --crop 1x1+" + pixel + " -o pixel.exr");
  const std::string text = oiiotool(folder, "--dumpdata pixel.exr");
  std::vector<double> numbers(3);
  const std::string line = text.substr(text.find(")"));
  CHECK(std::sscanf(line.c_str(), "): %lf %lf %lf", &numbers[0], &numbers[1], &numbers[2]) == 3);
  return numbers;
}

}  // namespace

TEST_CASE("an EXR file holds what --aov asks for, under the names that compositors know") {
  const TemporaryFolder folder;
  folder.write("ball.crt", ball_script);
  const Outcome run =
      run_crt(folder, {"render", "ball.crt", "--aov", "depth,normal", "--aov", "id,albedo"});
  CHECK(run.exit_code == 0);
  REQUIRE(folder.has("ball.exr"));
  const std::string info = oiiotool(folder, "--info -v ball.exr");
  for (const char* channel :
       {"R (float)", "Z (float)", "N.X (float)", "N.Y (float)", "N.Z (float)", "id (uint)",
        "albedo.R (float)", "albedo.G (float)", "albedo.B (float)"}) {
    CAPTURE(channel);
    CHECK(holds(info, channel));
  }
  // The ray goes through the pixel to the right of the middle and below it, half a pixel from both
  // lines.
  const double tangent = std::tan(std::numbers::pi / 6) / 12;
  const double length = std::sqrt(1 + 2 * tangent * tangent);  // the length of what is 1 along z
  const double middle = 4 / length;
  const double depth = middle - std::sqrt(middle * middle - 15);
  const std::vector<double> ball = numbers_at(folder, "8+6");
  CHECK(ball[0] == doctest::Approx(depth));
  CHECK(ball[1] == doctest::Approx(depth / length - 4));
  CHECK(ball[2] == doctest::Approx(0.5));
  const std::vector<double> corner = numbers_at(folder, "0+0");
  CHECK(std::isinf(corner[0]));
  CHECK(corner[1] == 0);
  CHECK(corner[2] == 0);
}

TEST_CASE("a format that cannot hold what --aov asks for is refused before anything is rendered") {
  const TemporaryFolder folder;
  folder.write("endless.crt", endless_script);
  const Outcome run = run_crt(
      folder, {"render", "endless.crt", "--time", "1", "-o", "picture.png", "--aov", "depth"});
  CHECK(run.exit_code == 2);
  CHECK(holds(run.err, "picture.png"));
  CHECK(holds(run.err, "exr"));
  CHECK_FALSE(folder.has("picture.png"));
}

TEST_CASE("an AOV that there is not is refused with the names of those that there are") {
  const TemporaryFolder folder;
  folder.write("ball.crt", ball_script);
  for (const char* list : {"dept", "depth,", ",depth", "depth;id", ""}) {
    CAPTURE(list);
    const Outcome run = run_crt(folder, {"render", "ball.crt", "--aov", list});
    CHECK(run.exit_code == 2);
    CHECK(holds(run.err, "depth,normal,id,part,albedo,samples,error"));
  }
  CHECK(folder.names() == std::vector<std::string>{"ball.crt"});
}

TEST_CASE("--aov leaves the colours as they are, and works with regions") {
  const TemporaryFolder folder;
  folder.write("ball.crt", ball_script);
  CHECK(run_crt(folder, {"render", "ball.crt", "-o", "plain.exr", "--region", "3,2,10,7"})
            .exit_code == 0);
  CHECK(run_crt(folder,
                {"render", "ball.crt", "-o", "more.exr", "--region", "3,2,10,7", "--aov", "depth"})
            .exit_code == 0);
  CHECK(holds(oiiotool(folder, "plain.exr more.exr --ch R,G,B --diff"), "PASS"));
}
