#include "core/render/rendering.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <exception>
#include <limits>
#include <new>

#include "core/math/float_environment.hpp"
#include "core/render/pixel.hpp"
#include "core/tasks/tasks.hpp"
#include "crt/error.hpp"

namespace crt::core {

namespace {

/// The part of the picture that the options ask for, checked.
Region chosen_region(const RenderOptions& options, const Settings& settings) {
  if (!options.region) return {0, 0, settings.width, settings.height};
  const Region& region = *options.region;
  const bool inside = region.x >= 0 && region.y >= 0 && region.width >= 1 && region.height >= 1 &&
                      region.width <= settings.width - region.x &&
                      region.height <= settings.height - region.y;
  if (!inside) {
    throw Error(ErrorCode::invalid_argument,
                fmt::format("region of {} x {} pixels at ({}, {}) is not inside the picture of {} x {}",
                            region.width, region.height, region.x, region.y, settings.width, settings.height),
                "region");
  }
  return region;
}

Settings chosen_settings(const RenderOptions& options, const Settings& settings) {
  Settings chosen = settings;
  if (options.seed) chosen.seed = *options.seed;
  return chosen;
}

/// A channel as the image's floats hold it.
float float_range(double value) {
  constexpr double largest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -largest, largest));
}

}  // namespace

Rendering::Rendering(const PreparedData& data, RenderOptions options)
    : data_(data),
      options_(std::move(options)),
      settings_(chosen_settings(options_, data.scene().settings)),
      canvas_(chosen_region(options_, settings_), settings_),
      tiles_(canvas_.region()),
      progress_(options_.progress, tiles_.count()) {
  allowed_threads(options_.threads);  // throws for a number that is none
}

void Rendering::render_tile(const Frame& frame, const Region& tile, Workspace& work) {
  const FloatEnvironment ieee;
  Tracer tracer(frame, work, progress_);
  constexpr std::size_t most_pixels = std::size_t{Tiles::side} * Tiles::side;
  std::array<Tracer::Sample, most_pixels> samples;
  trace_pixels(frame, tile, tracer, samples, work.stats);
  std::array<float, 4 * most_pixels> pixels;
  float* next = pixels.data();
  const auto count = static_cast<std::size_t>(tile.width) * static_cast<std::size_t>(tile.height);
  for (const Tracer::Sample& sample : std::span(samples).first(count)) {
    for (int channel = 0; channel < 3; ++channel) *next++ = float_range(sample.color[channel]);
    *next++ = static_cast<float>(sample.alpha);
  }
  canvas_.put(tile, std::span(pixels.data(), next));
}

RenderStats Rendering::render_tiles() {
  WorkspacePool pool;
  const Frame frame = [&] {
    WorkspacePool::Loan work(pool);
    return Frame(data_, settings_, *work);
  }();
  // Once a tile has failed the others end as if cancelled: what counts is what failed first.
  std::atomic_flag failed;
  std::exception_ptr failure;
  progress_.begin();
  try {
    run_tasks(tiles_.count(), options_.threads, [&](std::size_t index) {
      try {
        WorkspacePool::Loan work(pool);
        render_tile(frame, tiles_.tile(index), *work);
        progress_.task_done();
      } catch (...) {
        if (!failed.test_and_set()) failure = std::current_exception();
        progress_.stop();
        throw;
      }
    });
  } catch (...) {
    if (failure) std::rethrow_exception(failure);
    throw;
  }
  progress_.finish();
  return pool.total_stats();
}

void Rendering::run() {
  using Clock = std::chrono::steady_clock;
  const FloatEnvironment ieee;  // of this thread; others have their own for each tile
  const Clock::time_point begin = Clock::now();
  try {
    RenderStats stats = render_tiles();
    stats.threads = allowed_threads(options_.threads);
    stats.prepare_seconds = data_.prepare_seconds();
    stats.memory = data_.memory();
    stats.trace_seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    canvas_.set_stats(stats);
    tell(stats);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::out_of_memory, "there is not enough memory to render the picture");
  }
}

void Rendering::tell(const RenderStats& stats) const {
  if (!options_.log) return;
  log(LogLevel::info, fmt::format("rendered {} pixels in {:.2f} s on {} thread{}", stats.pixels,
                                  stats.trace_seconds, stats.threads, stats.threads == 1 ? "" : "s"));
  if (settings_.precision == Precision::exact) {
    log(LogLevel::info,
        fmt::format("exact: {} questions were too close for rounded arithmetic", stats.escalations));
  }
  if (options_.threads > stats.threads) {
    log(LogLevel::warning, fmt::format("asked for {} threads, but this process may use {} at most",
                                       options_.threads, stats.threads));
  }
  if (stats.samples_over_ray_bound > 0) {
    log(LogLevel::warning, fmt::format("{} camera samples reached the bound on rays and dropped the rest: "
                                       "a lower recursion depth costs less",
                                       stats.samples_over_ray_bound));
  }
}

void Rendering::log(LogLevel level, const std::string& line) const {
  const HostFloatEnvironment host;
  options_.log(level, line);
}

}  // namespace crt::core
