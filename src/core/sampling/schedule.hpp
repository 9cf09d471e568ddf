// The schedule says after which pass a pixel has how many samples. The numbers are fixed, so that a
// picture is a function of its pass count.
//
// Up to eight samples a pass gives one more to an eighth of the pixels. From then on every doubling
// of all pixels' samples takes eight passes. So a pass never adds more than an eighth to what is
// there. A picture whose pixels all have a sample can end at any pass.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace crt::core {

/// This many passes lead to a sample of each pixel, later to a doubling.
inline constexpr int passes_per_step = 8;
inline constexpr int samples_before_doubling = 8;
inline constexpr int passes_before_doubling = passes_per_step * samples_before_doubling;

/// A SamplesDone is what pixels that stay active have after some passes.
struct SamplesDone {
  std::int64_t samples = 0;  ///< the samples of each pixel
  int eighths = 0;           ///< the eighths of all pixels that have one more, those of the lowest
                             ///< ranks
};

/// Returns the samples after some passes. All pixels get their first sample at once, so it counts
/// even for fewer than eight passes.
constexpr SamplesDone samples_after(int passes) {
  if (passes <= passes_per_step) return {1, 0};
  if (passes <= passes_before_doubling) return {passes / passes_per_step, passes % passes_per_step};
  const int further = passes - passes_before_doubling - 1;
  const int doubling = further / passes_per_step;
  const int step = further % passes_per_step + 1;
  return {std::int64_t{samples_before_doubling + step} << doubling, 0};
}

/// Returns the passes after which each pixel has so many samples. It must be a number that some
/// pass ends with.
constexpr int passes_until(std::int64_t samples) {
  if (samples <= samples_before_doubling) return passes_per_step * static_cast<int>(samples);
  const auto eighths = static_cast<std::uint64_t>(samples - 1) / samples_before_doubling;
  const int doubling = static_cast<int>(std::bit_width(eighths)) - 1;
  const auto step = static_cast<int>((samples >> doubling) - samples_before_doubling);
  return passes_before_doubling + doubling * passes_per_step + step;
}

/// Returns how many samples come before rendering can stop again, with so many there.
constexpr std::int64_t samples_of_next_step(std::int64_t samples) {
  if (samples < samples_before_doubling) return 1;
  return static_cast<std::int64_t>(std::bit_floor(static_cast<std::uint64_t>(samples))) /
         samples_before_doubling;
}

/// There are never more steps than this, as the number of samples is an int.
inline constexpr std::size_t most_steps =
    samples_before_doubling + std::size_t{passes_per_step} * std::numeric_limits<int>::digits;

/// Returns the pass of eight, from 0 to 7, in which a pixel gets its next sample. The pixels of
/// each pass are far from each other.
constexpr int rank_of_pixel(int x, int y) {
  const auto diagonal = static_cast<unsigned>(x + 3 * y) & 7u;
  return static_cast<int>((diagonal & 1u) << 2 | (diagonal & 2u) | diagonal >> 2);
}

}  // namespace crt::core
