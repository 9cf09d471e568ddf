// These tests check what crt trade writes, what it refuses, and that it ends in order.
#include <doctest/doctest.h>

#include <csignal>
#include <sstream>

#include "command.hpp"
#include "scenes.hpp"

using namespace crt::test;

namespace {

bool holds(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

/// Returns the number in one column of a CSV file, in the line with these options.
double number_of(const std::string& csv, const std::string& options, int column) {
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find('"' + options + "\",");
    if (at == std::string::npos) continue;
    std::istringstream fields(line.substr(at + options.size() + 3));
    std::string field;
    for (int i = 2; i <= column; ++i) std::getline(fields, field, ',');
    return std::stod(field);
  }
  FAIL("no line has the options " << options);
  return 0;
}

constexpr int rmse_column = 3;

}  // namespace

TEST_CASE("crt trade measures a ladder: more samples cost more and are nearer to the truth") {
  const TemporaryFolder folder;
  folder.write("ball.crt", ball_script);
  const Outcome run =
      run_crt(folder, {"trade", "ball.crt", "--width", "64", "--height", "48", "--budget", "1000",
                       "--error", "200", "--reference-samples", "1024", "--most-seconds", "1000"});
  CAPTURE(run.err);
  REQUIRE(run.exit_code == 0);
  CHECK(folder.names() == std::vector<std::string>{"ball-trade.csv", "ball-trade.svg", "ball.crt"});
  const std::string csv = folder.read("ball-trade.csv");
  const double coarse = number_of(csv, "--supersampling 1", rmse_column);
  const double fine = number_of(csv, "--supersampling 16", rmse_column);
  CHECK(coarse > 3);
  CHECK(fine < coarse / 8);
  CHECK(number_of(csv, "--targeterror 0.003922", rmse_column) < 0.5);
  CHECK(number_of(csv, "--supersampling 16", 5) == 256);
  CHECK(holds(run.out, "Reference:"));
  CHECK(holds(run.out, "The most accurate within 1000 s:\n  RMSE: --"));
  CHECK(holds(run.out, "The fastest within 200 steps of 8 bits:\n  RMSE: "));
  CHECK_FALSE(holds(csv, "recursion depth"));  // nothing mirrors
  CHECK(folder.read("ball-trade.svg").starts_with("<svg "));
}

TEST_CASE("crt trade shows what narrower bounds of a measure cost") {
  const TemporaryFolder folder;
  folder.write("ball.crt", ball_script);
  const Outcome run = run_crt(
      folder, {"trade", "ball.crt", "--measure", "volume", "-o", "ball", "--most-seconds", "2"});
  CAPTURE(run.err);
  REQUIRE(run.exit_code == 0);
  CHECK(folder.names() == std::vector<std::string>{"ball.crt", "ball.csv", "ball.svg"});
  std::istringstream lines(folder.read("ball.csv"));
  std::string line;
  std::getline(lines, line);
  CHECK(line == "relative_width,reached,seconds,lower,upper");
  int count = 0;
  double asked_before = 1;
  double lower_before = 0;
  for (; std::getline(lines, line); ++count) {
    std::istringstream fields(line);
    std::vector<double> numbers;
    for (std::string field; std::getline(fields, field, ',');) numbers.push_back(std::stod(field));
    REQUIRE(numbers.size() == 5);
    CHECK(numbers[0] < asked_before);
    // Rounding ends it at last.
    if (numbers[0] > 1e-9) CHECK(numbers[1] <= 1.2 * numbers[0]);
    CHECK(numbers[3] >= lower_before);
    CHECK(numbers[4] > numbers[3]);
    asked_before = numbers[0];
    lower_before = numbers[3];
  }
  CHECK(count > 3);
  CHECK(folder.read("ball.svg").starts_with("<svg "));
  CHECK(run_crt(folder, {"trade", "ball.crt", "--measure", "smell"}).exit_code == 2);
}

TEST_CASE("crt trade measures the given part") {
  const TemporaryFolder folder;
  folder.write("ball.crt", ball_script);
  const Outcome run =
      run_crt(folder, {"trade", "ball.crt", "-o", "part", "--width", "400", "--height", "300",
                       "--region", "190,140,20,20", "--threads", "1"});
  CAPTURE(run.err);
  REQUIRE(run.exit_code == 0);
  CHECK(folder.names() == std::vector<std::string>{"ball.crt", "part.csv", "part.svg"});
  CHECK(holds(run.out, "Measured: 400 of 120000 pixels, in one piece, on 1 thread;"));
}

TEST_CASE("crt trade refuses what it cannot do, and then writes nothing") {
  const TemporaryFolder folder;
  folder.write("ball.crt", ball_script);
  folder.write("wrong.crt", "Scene { Sphere { radius -> } }");
  const auto fails = [&](std::vector<std::string> arguments, int exit_code,
                         const std::string& piece) {
    arguments.insert(arguments.begin(), "trade");
    const Outcome run = run_crt(folder, arguments);
    CAPTURE(run.err);
    CHECK(run.exit_code == exit_code);
    CHECK(holds(run.err, piece));
  };
  fails({}, 2, "scene");
  fails({"ball.crt", "--budget", "0"}, 2, "--budget needs a number above 0");
  fails({"ball.crt", "--error", "-1"}, 2, "--error");
  fails({"ball.crt", "--pixels", "many"}, 2, "--pixels");
  fails({"ball.crt", "--reference-samples", "100"}, 2, "a power of 2");
  fails({"ball.crt", "--most-seconds", "1e-9"}, 2, "nothing is done within 1e-09 s");
  fails({"ball.crt", "--region", "10,0,7,1"}, 2, "reaches beyond the picture");
  fails({"ball.crt", "--png"}, 2, "no option --png: the plot is an SVG file");
  fails({"ball.crt", "-o", "nowhere/ball"}, 3, "nowhere");
  fails({"wrong.crt"}, 1, "wrong.crt:1");
  fails({"missing.crt"}, 3, "missing.crt");
  CHECK(folder.names() == std::vector<std::string>{"ball.crt", "wrong.crt"});
}

TEST_CASE("crt trade that is interrupted leaves nothing behind" * doctest::skip(!has_terminals())) {
  const TemporaryFolder folder;
  folder.write("endless.crt", endless_script);
  CrtOnTerminal run(folder, {"trade", "endless.crt", "--time", "1", "--pixels", "4000000",
                             "--most-seconds", "600"});
  REQUIRE(run.shows("endless.crt"));
  run.send(SIGINT);
  CHECK(run.wait() == 130);
  CHECK(folder.names() == std::vector<std::string>{"endless.crt"});
}
