// Rays come in flows, and comparisons are run for each.
#pragma once

#include <fmt/format.h>

#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace crt::bench {

enum class Flow { coherent, scattered };

inline const char* name_of(Flow flow) {
  return flow == Flow::coherent ? "coherent" : "scattered";
}

/// Runs a comparison of `things` for both flows, and adds the rows of JSON that
/// comparison.run(flow, rounds) returns.
template <class Comparison>
void run_flows(Comparison& comparison, const std::string& things, int rounds,
               std::vector<std::string>& rows) {
  for (const Flow flow : {Flow::coherent, Flow::scattered}) {
    std::cerr << fmt::format("{}, {} rays\n", things, name_of(flow));
    for (std::string& row : comparison.run(flow, rounds)) rows.push_back(std::move(row));
  }
}

}  // namespace crt::bench
