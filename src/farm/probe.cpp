#include "farm/probe.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "core/render/passes.hpp"
#include "core/sampling/schedule.hpp"
#include "core/tasks/tasks.hpp"

namespace crt::farm {

namespace {

/// The small picture may take this share of the time of the whole one, but has so many pixels.
constexpr double share_of_work = 0.004;
constexpr double least_pixels = 4096;
constexpr double most_pixels = 65536;
constexpr int cell_side = 8;
/// No part of a picture counts as cheaper than this share of the mean: rays have to be made.
constexpr double least_of_mean = 0.02;

/// Returns the seconds that this thread has worked.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  constexpr double nanosecond = 1e-9;
  return static_cast<double>(now.tv_sec) + nanosecond * static_cast<double>(now.tv_nsec);
}

/// Returns how many samples a pixel has at least.
double samples_of(const Settings& settings, const RenderOptions& options) {
  if (core::asks_for_passes(settings, options.passes)) return settings.min_samples;
  return double{1} * settings.supersampling * settings.supersampling * settings.dof_samples;
}

struct SmallScene {
  Scene scene;
  RenderOptions options;
  double factor = 1;  ///< of the whole picture's time
};

SmallScene small_scene(const Scene& scene, const RenderOptions& job) {
  SmallScene small{.scene = scene,
                   .options = {.threads = 1,
                               .seed = job.seed,
                               .passes = job.passes,
                               .max_ray_steps = job.max_ray_steps}};
  Settings& settings = small.scene.settings;
  const bool by_passes = core::asks_for_passes(settings, job.passes);
  const double samples = samples_of(settings, job);
  if (by_passes) {
    if (settings.time_budget > 0 && job.passes == 0)
      small.options.passes = core::passes_until(settings.min_samples);
    settings.time_budget = 0;
  } else {
    settings.supersampling = 1;
    settings.dof_samples = std::min(settings.dof_samples, 2);  // 1 would be no lens
  }
  const double samples_now = samples_of(settings, small.options);
  const double pixels = double{1} * settings.width * settings.height;
  const double wanted =
      std::clamp(share_of_work * pixels * samples / samples_now, least_pixels, most_pixels);
  const double scale = std::min(1.0, std::sqrt(wanted / pixels));
  const auto scaled = [scale](int side) {
    return std::max(1, static_cast<int>(std::lround(scale * side)));
  };
  settings.width = scaled(settings.width);
  settings.height = scaled(settings.height);
  const double pixels_now = double{1} * settings.width * settings.height;
  small.factor = pixels / pixels_now * (samples / samples_now);
  return small;
}

}  // namespace

Probe probe(const Scene& scene, const ProbeOptions& options) {
  const double begin = thread_seconds();
  const SmallScene small = small_scene(scene, options.render);
  const PreparedScene prepared =
      prepare(small.scene, {.go_on = options.go_on, .max_primitives = options.max_primitives});
  const Settings& settings = small.scene.settings;
  Probe result{.map = {.width = scene.settings.width,
                       .height = scene.settings.height,
                       .columns = (settings.width + cell_side - 1) / cell_side,
                       .rows = (settings.height + cell_side - 1) / cell_side}};
  CostMap& map = result.map;
  map.prepare_seconds = thread_seconds() - begin;
  map.seconds.resize(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows));
  std::vector<double> samples(map.seconds.size());
  const auto render_cell = [&](std::size_t at) {
    const auto index = static_cast<int>(at);
    if (options.go_on && !options.go_on()) throw Error(ErrorCode::cancelled, "planning was ended");
    const int x = index % map.columns;
    const int y = index / map.columns;
    // The cells are as wide as the map takes them for.
    const int left = settings.width * x / map.columns;
    const int top = settings.height * y / map.rows;
    RenderOptions cell = small.options;
    cell.region = Region{left, top, settings.width * (x + 1) / map.columns - left,
                         settings.height * (y + 1) / map.rows - top};
    const double start = thread_seconds();
    const Image image = render(prepared, cell);
    map.seconds[at] = thread_seconds() - start;
    samples[at] = image.stats().samples_mean * static_cast<double>(image.stats().pixels);
  };
  render_cell(0);  // to have the memory that others use again
  core::run_tasks(map.seconds.size(), options.render.threads, render_cell);
  double all_samples = 0;
  for (const double count : samples) all_samples += count;
  result.seconds_per_sample = map.total() / std::max(all_samples, 1.0);
  const double least = least_of_mean * map.total() / static_cast<double>(map.seconds.size());
  for (double& seconds : map.seconds) seconds = small.factor * std::max(seconds, least);
  return result;
}

}  // namespace crt::farm
