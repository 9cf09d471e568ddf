// These tests check which settings `crt trade` tries.
#include "cli/trade_ladder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <crt/validate.hpp>
#include <set>

using namespace crt;
using namespace crt::cli;

namespace {

std::vector<Rung> of_family(const std::vector<Rung>& ladder, Family family) {
  std::vector<Rung> result;
  std::copy_if(ladder.begin(), ladder.end(), std::back_inserter(result),
               [&](const Rung& rung) { return rung.family == family; });
  return result;
}

Scene with_lens() {
  Scene scene;
  scene.camera.aperture = 50;
  scene.settings.dof_samples = 200;
  return scene;
}

}  // namespace

TEST_CASE("every rung can be rendered, and no two are the same") {
  for (const Scene& scene : {Scene(), with_lens()}) {
    std::set<std::string> options;
    for (const Rung& rung : ladder_of(scene, true)) {
      CAPTURE(rung.options);
      CHECK_NOTHROW(validate(rung.settings));
      CHECK(options.insert(rung.options).second);
      CHECK(rung.expected_samples > 0);
    }
  }
}

TEST_CASE("what the script says comes first, and the rest keeps what it does not try") {
  Scene scene;
  scene.settings.title = "mine";
  scene.settings.supersampling = 5;
  scene.settings.gamma = 2.2;
  scene.settings.target_error = 0.03;
  const std::vector<Rung> ladder = ladder_of(scene, false);
  CHECK(ladder.front().family == Family::as_given);
  CHECK(ladder.front().options.empty());
  CHECK(ladder.front().settings.supersampling == 5);
  CHECK(ladder.front().settings.target_error == 0.03);
  for (const Rung& rung : ladder) {
    CHECK(rung.settings.title == "mine");
    CHECK(rung.settings.gamma == 2.2);
  }
  for (const Rung& rung : of_family(ladder, Family::grid)) CHECK(rung.settings.target_error == 0);
}

TEST_CASE(
    "the grid goes from 1 to 16 without a lens, and mostly up in points of the lens with one") {
  const std::vector<Rung> grid = of_family(ladder_of({}, false), Family::grid);
  CHECK(grid.front().settings.supersampling == 1);
  CHECK(grid.back().settings.supersampling == 16);
  CHECK(std::is_sorted(grid.begin(), grid.end(), [](const Rung& a, const Rung& b) {
    return a.expected_samples < b.expected_samples;
  }));
  const std::vector<Rung> lens = of_family(ladder_of(with_lens(), false), Family::grid);
  CHECK(lens.back().settings.dof_samples > lens.front().settings.dof_samples);
  CHECK(lens.back().options.find("--dofsamples") != std::string::npos);
}

TEST_CASE("depths are tried where they matter only") {
  CHECK(of_family(ladder_of({}, false), Family::depth).empty());
  const std::vector<Rung> depths = of_family(ladder_of({}, true), Family::depth);
  CHECK(depths.size() > 3);
  CHECK(depths.front().settings.recursion_depth == 0);
}

TEST_CASE("a target error on the command line is the one that was measured") {
  for (const Rung& rung : of_family(ladder_of({}, false), Family::target)) {
    const std::string name = "--targeterror ";
    REQUIRE(rung.options.starts_with(name));
    CHECK(std::stod(rung.options.substr(name.size())) == rung.settings.target_error);
  }
}

TEST_CASE("the reference is finer than anything that is tried") {
  const Scene scene;
  const Settings reference = reference_settings(scene.settings, 4096, 77);
  CHECK_NOTHROW(validate(reference));
  CHECK_NOTHROW(validate(reference_settings(scene.settings, 4, 77)));
  CHECK(reference.seed == 77);
  for (const Rung& rung : ladder_of(scene, true)) {
    if (rung.family == Family::target) CHECK(reference.target_error < rung.settings.target_error);
    CHECK(reference.recursion_depth >= rung.settings.recursion_depth);
    CHECK(reference.min_weight <= rung.settings.min_weight);
  }
}
