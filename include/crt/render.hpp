#pragma once

#include <crt/image.hpp>
#include <crt/prepared_scene.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

namespace crt {

/// A rectangle of pixels, from the top left.
struct Region {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

enum class LogLevel { info, warning };

/// What a render may be asked beyond the scene; the defaults render all of it on all cores.
struct RenderOptions {
  /// Renders only this part of the picture: the image has its size. The pixels are those of the whole.
  std::optional<Region> region{};
  /// Threads at most; 0 takes what the calling TBB arena has, 1 starts none.
  int threads = 0;
  /// Called now and then, from one thread at a time, with the share done: first 0, never less than
  /// before, last 1. Returning false cancels: render() then throws Error (cancelled).
  std::function<bool(double)> progress{};
  /// Takes the place of Settings::seed.
  std::optional<std::uint64_t> seed{};
  /// Above 0: renders so many passes (RenderStats::passes) and no more, whatever the time budget; with
  /// neither target error nor time budget in the settings as with a time budget. Not negative.
  int passes = 0;
  /// Gets what there is to tell of the render, a line each without its end. From the thread that calls
  /// render().
  std::function<void(LogLevel, std::string_view)> log{};
};

/// Renders the picture. The pixels depend on the scene alone: not on threads, tiles or regions.
/// Throws Error: cancelled, invalid_argument (a region outside the picture), out_of_memory.
Image render(const PreparedScene& scene, const RenderOptions& options = {});

}  // namespace crt
