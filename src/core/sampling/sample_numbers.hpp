// Numbers are drawn for what a sample decides after its place and lens: which point of a light it
// sees, where a diffuse ray goes.
#pragma once

#include "core/sampling/sequence.hpp"

namespace crt::core {

/// A SampleId says which sample of a pixel it is.
struct SampleId {
  int x = 0;  ///< of the pixel
  int y = 0;
  std::uint32_t index = 0;
};

/// A SampleDecision is one that a sample takes at a ray that it follows. Each has four numbers.
struct SampleDecision {
  std::uint32_t ray = 0;   ///< the ray's number within the sample, from 1
  std::uint32_t kind = 0;  ///< below max_kinds

  static constexpr std::uint32_t max_kinds = 1u << 15;
  static constexpr std::uint32_t none = ~0u;
  static constexpr std::uint32_t diffuse_direction = max_kinds - 1;
  static constexpr std::uint32_t scattered_direction = max_kinds - 2;
  static constexpr std::uint32_t chosen_light = max_kinds - 3;
  /// Points of more lights than there are such kinds share them.
  static constexpr std::uint32_t of_light(std::uint32_t light) { return light % (max_kinds / 2); }
};

/// Returns the numbers by which as many samples decide as there are lanes: two, or all four. The
/// samples of a pixel get each number distributed evenly over [0, 1).
template <std::size_t count = sequence_dimensions>
std::array<Lanes, count> sample_numbers(std::uint64_t seed,
                                        const std::array<SampleId, lane_count>& samples,
                                        const std::array<SampleDecision, lane_count>& decisions) {
  std::array<PixelSequence::Decision, lane_count> each;
  for (std::size_t i = 0; i < lane_count; ++i) {
    const auto& [ray, kind] = decisions[i];
    each[i] = {.x = samples[i].x,
               .y = samples[i].y,
               .index = samples[i].index,
               .decision = ray * SampleDecision::max_kinds + kind};
  }
  if constexpr (count == 2) {
    return PixelSequence::first_numbers_of_each(seed, each);
  } else {
    return PixelSequence::numbers_of_each(seed, each);
  }
}

/// Returns the numbers of samples for the lens, which are distributed evenly together with the
/// place on the pixel.
inline std::array<Lanes, 2> numbers_of_lens(std::uint64_t seed,
                                            const std::array<SampleId, lane_count>& samples) {
  std::array<PixelSequence::Decision, lane_count> each;
  for (std::size_t i = 0; i < lane_count; ++i) {
    each[i] = {.x = samples[i].x,
               .y = samples[i].y,
               .index = samples[i].index,
               .decision = PixelSequence::place_and_lens};
  }
  const auto [place_u, place_v, u, v] = PixelSequence::numbers_of_each(seed, each);
  return {u, v};
}

}  // namespace crt::core
