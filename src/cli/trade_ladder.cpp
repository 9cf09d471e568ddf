#include "cli/trade_ladder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "cli/trade_measure.hpp"

namespace crt::cli {

namespace {

struct GridRung {
  int supersampling;
  int dof_samples;
};

constexpr GridRung grids[] = {{1, 1}, {2, 1}, {3, 1}, {4, 1}, {6, 1}, {8, 1}, {12, 1}, {16, 1}};

/// With a lens its points count most.
constexpr GridRung grids_with_lens[] = {{1, 4}, {1, 16}, {2, 16}, {2, 64}, {4, 64}};

/// Holds a target error in 8-bit steps, and about how many samples a pixel it takes.
struct TargetRung {
  double steps;
  double expected_samples;
};
constexpr TargetRung targets[] = {{8, 20}, {4, 25}, {2, 40}, {1, 60}, {0.5, 120}, {0.25, 250}};

/// Depths and precisions are tried with this target, which is good enough to show what they do.
constexpr TargetRung target_of_others = {1, 60};
constexpr int depths[] = {0, 1, 2, 4, 8, 16};

/// Returns a target error with as many digits as the command line gets.
double target_error(double steps) {
  constexpr double digits = 1e6;
  return std::round(digits * steps / steps_of_8_bits) / digits;
}

std::string target_option(double steps) {
  return fmt::format("--targeterror {}", target_error(steps));
}

Settings with_target(Settings settings, double steps) {
  settings.target_error = target_error(steps);
  settings.time_budget = 0;
  return settings;
}

void add_grids(const Scene& scene, std::vector<Rung>& ladder) {
  const bool lens = has_lens(scene.camera) && scene.settings.dof_samples > 1;
  const auto add = [&](const GridRung& grid) {
    Rung rung{
        .family = Family::grid,
        .options = fmt::format("--supersampling {}", grid.supersampling),
        .settings = with_target(scene.settings, 0),
        .expected_samples = double(grid.supersampling) * grid.supersampling * grid.dof_samples};
    rung.settings.supersampling = grid.supersampling;
    if (lens) {
      rung.settings.dof_samples = grid.dof_samples;
      rung.options += fmt::format(" --dofsamples {}", grid.dof_samples);
    }
    ladder.push_back(std::move(rung));
  };
  if (lens) {
    std::for_each(std::begin(grids_with_lens), std::end(grids_with_lens), add);
  } else {
    std::for_each(std::begin(grids), std::end(grids), add);
  }
}

}  // namespace

std::string name_of(Family family) {
  switch (family) {
    case Family::as_given:
      return "as the script says";
    case Family::grid:
      return "grid";
    case Family::target:
      return "target error";
    case Family::depth:
      return "recursion depth";
    case Family::precision:
      return "exact precision";
  }
  return "";
}

std::vector<Rung> ladder_of(const Scene& scene, bool with_depths) {
  const Settings& given = scene.settings;
  const double given_samples =
      given.target_error > 0 || given.time_budget > 0
          ? target_of_others.expected_samples
          : double(given.supersampling) * given.supersampling * given.dof_samples;
  std::vector<Rung> ladder = {{.family = Family::as_given,
                               .options = "",
                               .settings = given,
                               .expected_samples = given_samples}};
  add_grids(scene, ladder);
  for (const TargetRung& target : targets) {
    ladder.push_back({.family = Family::target,
                      .options = target_option(target.steps),
                      .settings = with_target(given, target.steps),
                      .expected_samples = target.expected_samples});
  }
  for (const int depth : depths) {
    if (!with_depths) break;
    Rung rung{.family = Family::depth,
              .options = fmt::format("{} --recursiondepth {}",
                                     target_option(target_of_others.steps), depth),
              .settings = with_target(given, target_of_others.steps),
              .expected_samples = target_of_others.expected_samples};
    rung.settings.recursion_depth = depth;
    ladder.push_back(std::move(rung));
  }
  Rung exact{.family = Family::precision,
             .options = target_option(target_of_others.steps) + " --precision exact",
             .settings = with_target(given, target_of_others.steps),
             .expected_samples = target_of_others.expected_samples};
  exact.settings.precision = Precision::exact;
  ladder.push_back(std::move(exact));
  return ladder;
}

Settings reference_settings(const Settings& settings, int most_samples, std::uint64_t seed) {
  // This is finer than anything that the ladder asks for.
  constexpr double target_steps = 0.05;
  constexpr int least_samples = 64;
  constexpr int deep = 32;
  constexpr double small_weight = 1.0 / (1 << 16);
  Settings reference = with_target(settings, target_steps);
  reference.min_samples = std::min(least_samples, most_samples);
  reference.max_samples = most_samples;
  reference.recursion_depth = std::max(settings.recursion_depth, deep);
  reference.min_weight = std::min(settings.min_weight, small_weight);
  reference.precision = Precision::exact;
  reference.seed = seed;
  return reference;
}

}  // namespace crt::cli
