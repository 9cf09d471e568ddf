// The fuzzer of the C interface makes custom shapes that answer well or badly.
#pragma once

#include <crt/crt.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "fuzz_input.hpp"

namespace crt::test {

/// Says what a custom shape may answer to a ray.
enum class FuzzedAnswer : std::uint8_t { two, many, odd, pole, large_error, failure };
inline constexpr std::array fuzzed_answers = {FuzzedAnswer::two,         FuzzedAnswer::many,
                                              FuzzedAnswer::odd,         FuzzedAnswer::pole,
                                              FuzzedAnswer::large_error, FuzzedAnswer::failure};

inline int answer_crossings(const crt_ray* ray, crt_custom_crossing* crossings,
                            std::size_t capacity, std::size_t* count, void* user) {
  const FuzzedAnswer answer = *static_cast<const FuzzedAnswer*>(user);
  *count = 2;
  if (answer == FuzzedAnswer::many) *count = capacity + 4;
  if (answer == FuzzedAnswer::odd) *count = 3;
  for (std::size_t i = 0; i < std::min(*count, capacity); ++i) {
    const double share =
        answer == FuzzedAnswer::pole ? 1 / (ray->origin[0] - 1) : static_cast<double>(i) / 20;
    const double error = answer == FuzzedAnswer::large_error ? share : 1e-9;
    const auto face = static_cast<std::uint32_t>(i % 2);
    crossings[i] = {ray->t_min + share * (ray->t_max - ray->t_min), error, face, 0};
  }
  return answer == FuzzedAnswer::failure && ray->origin[1] > 1 ? 1 : 0;
}

inline int answer_point(const double position[3], std::uint32_t, crt_custom_point* point, void*) {
  std::copy_n(position, 3, point->normal);
  return 0;
}

inline void describe_any(Input& input, const std::array<double, 3>& lower,
                         const std::array<double, 3>& upper, crt_custom& custom) {
  custom.face_count = input.below(4);
  std::copy_n(lower.data(), 3, custom.lower);
  std::copy_n(upper.data(), 3, custom.upper);
  custom.crossings = answer_crossings;
  custom.point = answer_point;
  custom.user = const_cast<FuzzedAnswer*>(&fuzzed_answers[input.below(fuzzed_answers.size())]);
}

}  // namespace crt::test
