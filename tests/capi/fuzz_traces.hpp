// The fuzzer of the C interface lets rays begin and end on what other rays have hit.
#pragma once

#include <crt/crt.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "fuzz_input.hpp"

namespace crt::test {

/// Traces valid rays whose nearest hits are known, and from there on.
inline void trace_rays(Input& input, crt_prepared* prepared, const std::array<crt_ray, 3>& rays,
                       const std::array<crt_hit, 3>& hits) {
  std::array<crt_full_hit, 3> full{};
  require(crt_trace(prepared, rays.data(), 0, nullptr, 0, 3, full.data(), 0) == CRT_OK);
  std::array<crt_start, 3> starts{};
  for (std::size_t i = 0; i < 3; ++i) {
    require(full[i].t == hits[i].t);
    starts[i] = full[i].start;
    // What is in a start is for nobody else to write, but nothing may come of it than an error.
    if (input.below(4) == 0) starts[i].bits[input.below(2)] ^= std::uint64_t{1} << input.below(64);
  }
  std::array<std::uint8_t, 3> blocked{};
  std::array<std::size_t, 4> places{};
  std::array<crt_full_hit, 8> crossings{};
  crt_blocked(prepared, rays.data(), 0, starts.data(), starts.data(), 0, 3, blocked.data());
  crt_trace_all(prepared, rays.data(), 0, starts.data(), 0, 3, crossings.data(), 8, places.data());
  crt_trace(prepared, rays.data(), 0, starts.data(), 0, 3, full.data(), 0);
  std::array<std::uint32_t, 3> entities{};
  require(crt_locate(prepared, rays[0].origin, sizeof(crt_ray), 3, entities.data(), nullptr,
                     nullptr) == CRT_OK);
}

}  // namespace crt::test
