// All steps of the tracer's loop share this context.
#pragma once

#include "core/render/frame.hpp"
#include "core/render/progress.hpp"

namespace crt::core {

/// The context holds what is rendered, and the memory and counts of the thread that renders it.
struct TraceContext {
  const Frame& frame;
  const PreparedData& data;
  Workspace& work;
  Progress& progress;
  bool identifies = false;  ///< whether samples get an identity
  unsigned unpolled_rays = 0;

  /// Counts rays, and polls the progress now and then.
  void count_rays(unsigned rays) {
    constexpr unsigned rays_per_poll = 256;
    unpolled_rays += rays;
    if (unpolled_rays < rays_per_poll) return;
    unpolled_rays = 0;
    progress.poll();
  }
};

}  // namespace crt::core
