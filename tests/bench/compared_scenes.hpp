// Benchmarks that compare two scenes in one process share these.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <crt/query.hpp>
#include <cstdint>
#include <ctime>
#include <span>
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

/// A RandomShare makes random numbers from 0 to 1, which are equal in every run.
class RandomShare {
 public:
  double operator()() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state_ >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_ = 1;
};

/// Holds how far rays go in two scenes.
struct ComparedDistances {
  std::vector<double> first;
  std::vector<double> second;
};

/// Sends the same rays through two scenes in turns. The counter `ratio` is the median of the
/// second's time / the first's, and `ns_a_ray` is the first's time.
inline ComparedDistances compare_in_turns(benchmark::State& state, const PreparedScene& first,
                                          const PreparedScene& second, std::span<const Ray> rays) {
  RayQueries first_queries(first);
  RayQueries second_queries(second);
  ComparedDistances distances{std::vector<double>(rays.size()), std::vector<double>(rays.size())};
  std::vector<double> ratios;
  std::vector<double> nanoseconds;
  for (auto _ : state) {
    const double of_first = seconds([&] { first_queries.distances(rays, distances.first); });
    const double of_second = seconds([&] { second_queries.distances(rays, distances.second); });
    ratios.push_back(of_second / of_first);
    nanoseconds.push_back(of_first / static_cast<double>(rays.size()) * 1e9);
  }
  state.counters["ratio"] = median(ratios);
  state.counters["ns_a_ray"] = median(nanoseconds);
  return distances;
}

}  // namespace crt::bench
