// Passes: after which of them a pixel has how many samples. The numbers are fixed, so that a picture is a
// function of its pass count.
//
// The first passes add one sample each. From then on every doubling of the samples takes the same number of
// passes, so that a pass never adds more than an eighth to what is there.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace crt::core {

inline constexpr int passes_per_doubling = 8;

/// Of a pixel that is never done, after `passes` >= 0 passes.
constexpr std::int64_t samples_after(int passes) {
  if (passes <= passes_per_doubling) return passes;
  const int further = passes - passes_per_doubling - 1;
  const int doubling = further / passes_per_doubling;
  const int step = further % passes_per_doubling + 1;
  return std::int64_t{passes_per_doubling + step} << doubling;
}

/// The passes that it takes to have so many samples, which must be a number that some pass ends with.
constexpr int passes_until(std::int64_t samples) {
  if (samples <= passes_per_doubling) return static_cast<int>(samples);
  const auto eighths = static_cast<std::uint64_t>(samples - 1) / passes_per_doubling;
  const int doubling = static_cast<int>(std::bit_width(eighths)) - 1;
  const auto step = static_cast<int>((samples >> doubling) - passes_per_doubling);
  return (doubling + 1) * passes_per_doubling + step;
}

/// The samples that the pass after the first `samples` adds.
constexpr std::int64_t samples_of_next_pass(std::int64_t samples) {
  if (samples < passes_per_doubling) return 1;
  return static_cast<std::int64_t>(std::bit_floor(static_cast<std::uint64_t>(samples))) / passes_per_doubling;
}

}  // namespace crt::core
