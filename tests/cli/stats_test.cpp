#include <doctest/doctest.h>

#include <string>

#include "cli/command.hpp"
#include "cli/json.hpp"
#include "cli/scenes.hpp"

using namespace crt::test;

namespace {

struct Fixture {
  TemporaryFolder folder;
  Fixture() { folder.write("ball.crt", ball_script); }

  Json stats_of(std::vector<std::string> more) {
    std::vector<std::string> arguments = {"render", "ball.crt", "--stats", "stats.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome run = run_crt(folder, arguments);
    REQUIRE_MESSAGE(run.exit_code == 0, run.err);
    return parse_json(folder.read("stats.json"));
  }
};

}  // namespace

TEST_CASE_FIXTURE(Fixture, "statistics tell seconds, rays, counters and settings") {
  const Json stats = stats_of({"--supersampling", "3"});
  CHECK(stats["pixels"].number == 16 * 12);
  CHECK(stats["rays"]["camera"].number == 16 * 12 * 9);
  CHECK(stats["settings"]["supersampling"].number == 3);
  CHECK(stats["settings"]["title"].string == "A ball");
  CHECK(stats["settings"]["falloffmodel"].string == "light");
  CHECK(stats["settings"]["ambientmodel"].string == "surface");
  CHECK(stats["settings"]["gamma"].number == 2.2);
  CHECK(stats["settings"]["precision"].string == "standard");
  CHECK(stats["counters"]["escalations"].number == 0);
  CHECK(stats["counters"]["undecided"].number == 0);
  CHECK(stats["script"].string == "ball.crt");
  CHECK(stats["output"].string == "ball.png");
  for (const char* stage : {"parse", "prepare", "trace", "write"}) {
    CHECK(stats["seconds"][stage].kind == Json::Kind::number);
    CHECK(stats["seconds"][stage].number >= 0);
  }
  CHECK(stats["memory_bytes"]["primitives"].number > 0);
  CHECK(stats["memory_bytes"]["csg"].number == 0);
  CHECK(stats["memory_bytes"]["tree"].number > 0);
  CHECK(stats["memory_bytes"]["materials"].number > 0);
  CHECK(stats["counters"]["intersection_tests"].number > 0);
  CHECK(stats["version"].kind == Json::Kind::string);
  CHECK_FALSE(stats.has("frame"));
}

TEST_CASE_FIXTURE(Fixture, "statistics count rays along which a field could not be decided") {
  const std::string camera =
      "Settings { width -> 16 height -> 12 camera -> Camera { position -> vec3(0.5, 1, -5) "
      "pointing -> vec3(0, 0, 0) } }\n";
  const auto undecided = [&](const std::string& field, const std::vector<std::string>& more) {
    folder.write("field.crt", camera + "Scene { Implicit { field -> " + field +
                                  " lower -> vec3(-1, -1, -1) upper -> vec3(1, 1, 1) } }");
    std::vector<std::string> arguments = {"render", "field.crt", "--stats", "field.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome run = run_crt(folder, arguments);
    REQUIRE_MESSAGE(run.exit_code == 0, run.err);
    return parse_json(folder.read("field.json"))["counters"]["undecided"].number;
  };
  for (const std::vector<std::string>& tier :
       {std::vector<std::string>{}, {"--precision", "exact"}}) {
    CHECK(undecided("x ** 2 + y ** 2 + z ** 2 - 1", tier) == 0);
    // The pole is no root that has a slope.
    CHECK(undecided("-1 / z", tier) > 0);
  }
}

TEST_CASE_FIXTURE(
    Fixture, "statistics tell how near to the truth a picture is, and its passes give it again") {
  const Json grid = stats_of({"--supersampling", "3"});
  CHECK(grid["accuracy"]["passes"].number == 0);
  CHECK(grid["accuracy"]["samples_min"].number == 9);
  const Json stats = stats_of({"--targeterror", "0.02", "--reproducible"});
  const Json& accuracy = stats["accuracy"];
  CHECK(accuracy["samples_min"].number == 16);
  CHECK(accuracy["samples_mean"].number * 16 * 12 ==
        doctest::Approx(stats["rays"]["camera"].number));
  CHECK(accuracy["half_width_max"].number > 0);
  CHECK(accuracy["half_width_95"].number <= accuracy["half_width_max"].number);
  CHECK(accuracy["half_width_rms"].number <= accuracy["half_width_max"].number);
  CHECK(stats["settings"]["targeterror"].number == 0.02);
  CHECK(stats["settings"]["filter"].string == "box");
  const std::string picture = folder.read("ball.png");
  const std::string passes = std::to_string(static_cast<int>(accuracy["passes"].number));
  stats_of({"--targeterror", "0.02", "--passes", passes, "--reproducible"});
  CHECK(folder.read("ball.png") == picture);
  CHECK(run_crt(folder, {"render", "ball.crt", "--passes", "-1"}).exit_code == 2);
  CHECK(run_crt(folder, {"render", "ball.crt", "--targeterror", "0.02", "--minsamples", "20"})
            .exit_code != 0);
}

TEST_CASE_FIXTURE(Fixture, "a picture goes on from its checkpoint, and from no other one's") {
  const std::vector<std::string> error = {"--targeterror", "0.004", "--reproducible"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), error.begin(), error.end());
    return more;
  };
  const Json whole = stats_of(error);
  const std::string picture = folder.read("ball.png");
  stats_of(with({"--passes", "70", "--checkpoint", "ball.state"}));
  CHECK(folder.read("ball.png") != picture);
  const Json resumed = stats_of(with({"--checkpoint", "ball.state"}));
  CHECK(folder.read("ball.png") == picture);
  CHECK(resumed["rays"]["camera"].number == whole["rays"]["camera"].number);

  const auto refused = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"render", "ball.crt", "--checkpoint", "ball.state"});
    const Outcome run = run_crt(folder, arguments);
    CHECK(run.err.find("checkpoint") != std::string::npos);
    return run.exit_code != 0;
  };
  CHECK(refused({"--targeterror", "0.008"}));
  CHECK(refused({}));
  CHECK(refused({"--targeterror", "0.004", "--frames", "1-2"}));
  CHECK(run_crt(folder, {"render", "ball.crt", "--checkpoint", "no/where", "--passes", "3"})
            .exit_code != 0);
}

TEST_CASE_FIXTURE(Fixture, "texts of any kind come through the options into the statistics") {
  const std::string text = "quote \" backslash \\ newline \n tab \t \xc3\xa9";
  CHECK(stats_of({"--notes", text})["settings"]["notes"].string == text);
}

TEST_CASE_FIXTURE(Fixture, "statistics of a region count its pixels and say where it is") {
  const Json stats = stats_of({"--region", "1,2,5,4"});
  CHECK(stats["pixels"].number == 20);
  REQUIRE(stats["region"].items.size() == 4);
  CHECK(stats["region"].items[0].number == 1);
  CHECK(stats["region"].items[3].number == 4);
}

TEST_CASE_FIXTURE(Fixture, "an animation's statistics are an array, an object a frame") {
  const Json stats = stats_of({"--frames", "2-4"});
  REQUIRE(stats.items.size() == 3);
  CHECK(stats.items[0]["frame"].number == 2);
  CHECK(stats.items[2]["output"].string == "ball_0004.png");
}

TEST_CASE_FIXTURE(Fixture,
                  "statistics go to standard output for '-', and what the script prints does not") {
  const Outcome run = run_crt(folder, {"render", "ball.crt", "--stats", "-"});
  REQUIRE(run.exit_code == 0);
  CHECK(parse_json(run.out)["pixels"].number == 16 * 12);
  CHECK(run.err.find("t is 0") != std::string::npos);
}

TEST_CASE_FIXTURE(Fixture, "a file's name that is no UTF-8 still gives well-formed statistics") {
  folder.write("odd\xff.crt", ball_script);
  const Outcome run =
      run_crt(folder, {"render", "odd\xff.crt", "--stats", "stats.json", "-o", "odd.png"});
  REQUIRE_MESSAGE(run.exit_code == 0, run.err);
  CHECK(parse_json(folder.read("stats.json"))["script"].string == "odd\ufffd.crt");
}
