// Benchmarks that compare two things in one process share these.
#pragma once

#include <algorithm>
#include <ctime>
#include <vector>

namespace crt::bench {

/// Returns the processor's time that a call takes, which other work on the machine does not change.
template <class Call>
double seconds(const Call& call) {
  const std::clock_t begin = std::clock();
  call();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace crt::bench
