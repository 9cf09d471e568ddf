#pragma once

#include <crt/image.hpp>
#include <crt/prepared_scene.hpp>
#include <functional>
#include <optional>

namespace crt {

/// A rectangle of pixels, from the top left.
struct Region {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// What a render may be asked beyond the scene; the defaults render all of it on all cores.
struct RenderOptions {
  /// Renders only this part of the picture: the image has its size. The pixels are those of the whole.
  std::optional<Region> region{};
  /// Threads at most; 0 takes what the calling TBB arena has, 1 starts none.
  int threads = 0;
  /// Called now and then, from one thread at a time, with the share done: first 0, never less than
  /// before, last 1. Returning false cancels: render() then throws Error (cancelled).
  std::function<bool(double)> progress{};
};

/// Renders the picture. The pixels depend on the scene alone: not on threads, tiles or regions.
/// Throws Error: cancelled, invalid_argument (a region outside the picture), out_of_memory.
Image render(const PreparedScene& scene, const RenderOptions& options = {});

}  // namespace crt
