// This file lists the settings that `crt trade` tries: a ladder of them for each way to spend time.
#pragma once

#include <crt/scene.hpp>
#include <string>
#include <vector>

namespace crt::cli {

enum class Family {
  as_given,   ///< what the script says
  grid,       ///< supersampling, and points of the lens if there is one
  target,     ///< target errors
  depth,      ///< recursion depths
  precision,  ///< the exact tier
};

/// Returns what the plot and the table call it.
std::string name_of(Family family);

struct Rung {
  Family family = Family::as_given;
  /// These options are added to the command line of `crt render`.
  std::string options;
  Settings settings;
  /// A pixel gets about this many samples. This is for planning.
  double expected_samples = 1;
};

/// Returns the ladder of a scene, each family from the fastest to the slowest. Depths are tried if
/// the cut-off does anything.
std::vector<Rung> ladder_of(const Scene& scene, bool with_depths);

/// Returns the settings of the reference: as many samples as needed up to `most_samples`, paths
/// followed much further, hits that are right.
Settings reference_settings(const Settings& settings, int most_samples, std::uint64_t seed);

}  // namespace crt::cli
