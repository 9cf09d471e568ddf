#pragma once

#include <string>
#include <vector>

#include "oracle/measure.hpp"

namespace crt::test {

/// What oracle_table knows of a primitive.
struct Measured {
  std::size_t kind = 0;
  Record ours;
  Record naive;
  double our_time = 0;  ///< nanoseconds a ray
  double naive_time = 0;
};

/// An SVG: for each primitive the error that 99.9 % of plain rays stay below, in ulps, against distance.
std::string accuracy_plot(const std::vector<Measured>& all);

}  // namespace crt::test
