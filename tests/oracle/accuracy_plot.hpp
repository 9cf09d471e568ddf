#pragma once

#include <string>
#include <vector>

#include "oracle/measure.hpp"

namespace crt::test {

/// Holds what oracle_table knows of a primitive by one of the contestants.
struct MeasuredTier {
  std::string name;
  Record record;
  double nanoseconds = 0;  ///< a ray
};
struct Measured {
  std::size_t kind = 0;
  std::vector<MeasuredTier> tiers;  ///< standard, exact, naive
};

/// Returns an SVG: for each primitive the error that 99.9 % of plain rays stay below, in ulps,
/// against distance.
std::string accuracy_plot(const std::vector<Measured>& all);

}  // namespace crt::test
