// Passes: after which of them a pixel has how many samples. The numbers are fixed, so that a
// picture is a function of its pass count.
//
// Up to eight samples a pass gives one more to an eighth of the pixels, from then on every doubling
// of all pixels' samples takes eight passes: a pass never adds more than an eighth to what is
// there, and a picture of which each pixel has a sample can end at any of them.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace crt::core {

/// To a sample of each pixel, then to a doubling.
inline constexpr int passes_per_step = 8;
inline constexpr int samples_before_doubling = 8;
inline constexpr int passes_before_doubling = passes_per_step * samples_before_doubling;

/// What pixels that are never done have after some passes.
struct SamplesDone {
  std::int64_t samples = 0;  ///< each
  int eighths = 0;           ///< of the pixels, those of the lowest ranks, have one more
};

/// The first sample of all pixels comes in one: for fewer than eight passes it is there as well.
constexpr SamplesDone samples_after(int passes) {
  if (passes <= passes_per_step) return {1, 0};
  if (passes <= passes_before_doubling) return {passes / passes_per_step, passes % passes_per_step};
  const int further = passes - passes_before_doubling - 1;
  const int doubling = further / passes_per_step;
  const int step = further % passes_per_step + 1;
  return {std::int64_t{samples_before_doubling + step} << doubling, 0};
}

/// The passes that it takes to have so many samples each, which must be a number that some pass
/// ends with.
constexpr int passes_until(std::int64_t samples) {
  if (samples <= samples_before_doubling) return passes_per_step * static_cast<int>(samples);
  const auto eighths = static_cast<std::uint64_t>(samples - 1) / samples_before_doubling;
  const int doubling = static_cast<int>(std::bit_width(eighths)) - 1;
  const auto step = static_cast<int>((samples >> doubling) - samples_before_doubling);
  return passes_before_doubling + doubling * passes_per_step + step;
}

/// How many samples come before one can stop again, with so many there.
constexpr std::int64_t samples_of_next_step(std::int64_t samples) {
  if (samples < samples_before_doubling) return 1;
  return static_cast<std::int64_t>(std::bit_floor(static_cast<std::uint64_t>(samples))) /
         samples_before_doubling;
}

/// More steps than that never come: there are as many samples as an int can tell, at most.
inline constexpr std::size_t most_steps =
    samples_before_doubling + std::size_t{passes_per_step} * std::numeric_limits<int>::digits;

/// From 0 to 7: in which of the eight passes a pixel gets its next sample, those of each pass far
/// apart.
constexpr int rank_of_pixel(int x, int y) {
  const auto diagonal = static_cast<unsigned>(x + 3 * y) & 7u;
  return static_cast<int>((diagonal & 1u) << 2 | (diagonal & 2u) | diagonal >> 2);
}

}  // namespace crt::core
