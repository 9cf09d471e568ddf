#include "crt/render.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <new>
#include <stdexcept>

#include "core/render/float_environment.hpp"
#include "core/render/pixel.hpp"
#include "core/render/progress.hpp"
#include "core/render/tasks.hpp"
#include "core/render/tiles.hpp"
#include "crt/error.hpp"

namespace crt {

namespace core {

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

/// A channel as the image's floats hold it.
double float_range(double value) {
  constexpr double largest = std::numeric_limits<float>::max();
  return std::clamp(value, -largest, largest);
}

void render_tile(const Frame& frame, const Region& tile, const Region& region, Workspace& work,
                 Progress& progress, Image& image) {
  const FloatEnvironment ieee;
  Tracer tracer(frame, work, progress);
  for (int y = tile.y; y < tile.y + tile.height; ++y) {
    for (int x = tile.x; x < tile.x + tile.width; ++x) {
      const Tracer::Sample pixel = trace_pixel(frame, x, y, tracer, work.stats);
      image.set(
          x - region.x, y - region.y,
          {float_range(pixel.color.x), float_range(pixel.color.y), float_range(pixel.color.z), pixel.alpha});
    }
  }
}

void render_tiles(const Frame& frame, const Region& region, const RenderOptions& options, WorkspacePool& pool,
                  Image& image) {
  const Tiles tiles(region);
  Progress progress(options.progress, tiles.count());
  progress.begin();
  run_tasks(tiles.count(), options.threads, [&](std::size_t index) {
    try {
      WorkspacePool::Loan work(pool);
      render_tile(frame, tiles.tile(index), region, *work, progress, image);
      progress.task_done();
    } catch (...) {
      progress.stop();
      throw;
    }
  });
  progress.finish();
}

Image render(const PreparedData& data, const RenderOptions& options) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const Settings& settings = data.scene().settings;
  const Region region = chosen_region(options, settings);
  const int threads = allowed_threads(options.threads);

  Image image(region.width, region.height);
  image.set_settings(settings);
  WorkspacePool pool;
  const Frame frame = [&] {
    WorkspacePool::Loan work(pool);
    return Frame(data, *work);
  }();
  render_tiles(frame, region, options, pool, image);

  image.stats() = pool.total_stats();
  image.stats().threads = threads;
  image.stats().prepare_seconds = data.prepare_seconds();
  image.stats().trace_seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return image;
}

[[noreturn]] void throw_out_of_memory() {
  throw Error(ErrorCode::out_of_memory, "there is not enough memory to render the picture");
}

}  // namespace

}  // namespace core

Image render(const PreparedScene& scene, const RenderOptions& options) {
  const core::FloatEnvironment ieee;  // of this thread; others have their own for each tile
  try {
    return core::render(scene.data(), options);
  } catch (const std::bad_alloc&) {
    core::throw_out_of_memory();
  } catch (const std::length_error&) {
    core::throw_out_of_memory();
  }
}

}  // namespace crt
