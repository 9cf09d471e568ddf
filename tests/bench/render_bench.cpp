// Measures how many rays a second a whole render follows, on one thread and on all.
#include <benchmark/benchmark.h>

#include <crt/prepared_scene.hpp>
#include <crt/render.hpp>
#include <functional>

#include "scenes.hpp"

namespace {

using crt::bench::balls;
using crt::bench::curved;
using crt::bench::drilled_blocks;
using crt::bench::glass_and_mirrors;

std::uint64_t all_rays(const crt::RenderStats& stats) {
  return stats.camera_rays + stats.shadow_rays + stats.reflection_rays + stats.refraction_rays;
}

void render_scene(benchmark::State& state, const crt::Scene& scene) {
  const crt::PreparedScene prepared = crt::prepare(scene);
  const crt::RenderOptions options{.threads = static_cast<int>(state.range(0))};
  std::uint64_t camera_rays = 0;
  std::uint64_t rays = 0;
  for ([[maybe_unused]] auto pass : state) {
    const crt::Image image = crt::render(prepared, options);
    camera_rays += image.stats().camera_rays;
    rays += all_rays(image.stats());
  }
  state.counters["camera_rays/s"] =
      benchmark::Counter(static_cast<double>(camera_rays), benchmark::Counter::kIsRate);
  state.counters["rays/s"] =
      benchmark::Counter(static_cast<double>(rays), benchmark::Counter::kIsRate);
}

void prepare_scene(benchmark::State& state, const std::function<crt::Scene(int)>& make) {
  const crt::Scene scene = make(static_cast<int>(state.range(0)));
  for ([[maybe_unused]] auto pass : state) benchmark::DoNotOptimize(crt::prepare(scene));
  state.counters["entities/s"] = benchmark::Counter(static_cast<double>(scene.entities.size()),
                                                    benchmark::Counter::kIsIterationInvariantRate);
}

// The argument is the number of threads, 0 for all there are.
BENCHMARK_CAPTURE(render_scene, balls, balls(16))
    ->Arg(1)
    ->Arg(0)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(render_scene, drilled_blocks, drilled_blocks(6))
    ->Arg(1)
    ->Arg(0)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(render_scene, curved, curved(12))
    ->Arg(1)
    ->Arg(0)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(render_scene, glass_and_mirrors, glass_and_mirrors())
    ->Arg(1)
    ->Arg(0)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

// The argument is the number of balls along each side.
BENCHMARK_CAPTURE(prepare_scene, balls, balls)
    ->Arg(8)
    ->Arg(32)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
