// A probe renders a small picture of a scene, cell by cell, and measures where time goes.
#pragma once

#include "crt/scene.hpp"
#include "farm/split.hpp"

namespace crt::farm {

struct ProbeOptions {
  const RenderOptions& render;  ///< of the job
  std::uint64_t max_primitives = 0;
  std::function<bool()> go_on{};
};

struct Probe {
  CostMap map;
  /// This is the time of a sample of a pixel, where pixels are rendered by passes.
  double seconds_per_sample = 0;
};

/// Measures a scene, whose settings must be those of the job. It takes some thousandths of what
/// rendering takes. Throws Error: cancelled, limit, out_of_memory.
Probe probe(const Scene& scene, const ProbeOptions& options);

}  // namespace crt::farm
