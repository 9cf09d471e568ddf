#include "core/render/rendering.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <exception>
#include <new>

#include "core/math/float_environment.hpp"
#include "core/render/accuracy.hpp"
#include "core/render/aov_tile.hpp"
#include "core/render/checkpoint.hpp"
#include "core/render/pixel.hpp"
#include "core/tasks/tasks.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

/// Is the half-width of a pixel of which nothing is known, in what a display shows.
constexpr float unknown_half_width = 1;

/// Returns the part of the picture that the options ask for, checked.
Region chosen_region(const RenderOptions& options, const Settings& settings) {
  if (!options.region) return {0, 0, settings.width, settings.height};
  const Region& region = *options.region;
  const bool inside = region.x >= 0 && region.y >= 0 && region.width >= 1 && region.height >= 1 &&
                      region.width <= settings.width - region.x &&
                      region.height <= settings.height - region.y;
  if (!inside) {
    throw Error(
        ErrorCode::invalid_argument,
        text::format("region of {} x {} pixels at ({}, {}) is not inside the picture of {} x {}",
                     region.width, region.height, region.x, region.y, settings.width,
                     settings.height),
        "region");
  }
  return region;
}

/// Returns the part that is rendered for it. The filter looks beyond its borders.
Region rendered_region(const Region& region, const Settings& settings) {
  if (!settings.denoise) return region;
  return widened(region, denoise_reach, {0, 0, settings.width, settings.height});
}

Settings chosen_settings(const RenderOptions& options, const Settings& settings) {
  Settings chosen = settings;
  if (options.seed) chosen.seed = *options.seed;
  return chosen;
}

void check_passes(const RenderOptions& options, const Settings& settings, const Region& region) {
  if (options.passes < 0) {
    throw Error(ErrorCode::invalid_argument,
                "passes must not be negative; 0 means as many as it takes", "passes");
  }
  if (!options.checkpoint.empty() && !asks_for_passes(settings, options.passes)) {
    throw Error(
        ErrorCode::invalid_argument,
        "a checkpoint is of a picture with a target error, a time budget or a number of passes",
        "checkpoint");
  }
  // Each pixel takes some 200 bytes while it is worked on.
  constexpr std::int64_t most_pixels = std::int64_t{1} << 25;
  if (asks_for_passes(settings, options.passes) &&
      std::int64_t{region.width} * region.height > most_pixels) {
    throw Error(
        ErrorCode::limit,
        text::format(
            "{} x {} pixels are too many at once with a target error, a time budget or passes: "
            "render regions of up to 2^25 pixels",
            region.width, region.height));
  }
}

}  // namespace

Rendering::Rendering(const PreparedData& data, RenderOptions options, PassClock::Seconds seconds)
    : data_(data),
      options_(std::move(options)),
      settings_(chosen_settings(options_, data.scene().settings)),
      region_(chosen_region(options_, settings_)),
      canvas_(rendered_region(region_, settings_), settings_),
      progress_(options_.progress),
      rules_{.most = options_.max_ray_steps == 0 ? usual_most_steps : options_.max_ray_steps,
             .poll = [this] { progress_.poll_in_ray(); }},
      seconds_(std::move(seconds)) {
  if (is_any(options_.aovs)) canvas_.add_channels(options_.aovs);
  if (keeps_guides()) canvas_.add_guides();
  allowed_threads(options_.threads);  // throws for an invalid number
  check_passes(options_, settings_, canvas_.region());
}

void Rendering::render_tile(const Frame& frame, const Region& tile, Workspace& work) {
  Tracer tracer(frame, work, progress_);
  if (!is_any(options_.aovs) && !keeps_guides()) {
    trace_tile(frame, tile, tracer, {}, work);
    return;
  }
  AovTile aovs(options_.aovs, tile);
  trace_tile(frame, tile, tracer, aovs.first_hits(keeps_first_hits()), work);
  if (!is_any(options_.aovs)) return;
  aovs.set_samples(static_cast<std::uint32_t>(samples_of_grid(settings_, frame.features().lens)));
  aovs.look(frame.camera(), tracer);
  canvas_.put_aovs(aovs);
}

void Rendering::trace_tile(const Frame& frame, const Region& tile, Tracer& tracer,
                           std::span<FirstHit> first_hits, Workspace& work) {
  std::array<PixelMean, Tiles::most_pixels> storage;
  const std::span<PixelMean> means = std::span(storage).first(pixel_count(tile));
  std::vector<PixelNoise> noise(keeps_guides() ? means.size() : 0);
  trace_pixels(frame, tile, tracer, means, first_hits, noise, work.stats);
  if (keeps_guides()) put_guides(frame, tile, first_hits, noise);
  std::array<float, pixel_channels * Tiles::most_pixels> pixels;
  float* next = pixels.data();
  for (const PixelMean& mean : means) {
    const FloatLanes channels = finite_floats(mean.channels);
    std::memcpy(next, &channels, sizeof channels);
    next += pixel_channels;
    if (mean.dropped != 0) work.cutoff.add(mean.dropped);
  }
  canvas_.put(tile, std::span(pixels.data(), next));
}

void Rendering::put_guides(const Frame& frame, const Region& tile,
                           std::span<const FirstHit> first_hits,
                           std::span<const PixelNoise> noise) {
  const std::uint64_t samples = samples_of_grid(settings_, frame.features().lens);
  std::vector<PlacedGuide> guides;
  guides.reserve(noise.size());
  for (std::size_t i = 0; i < noise.size(); ++i) {
    const auto place = static_cast<int>(i);
    guides.push_back({tile.x + place % tile.width, tile.y + place / tile.width,
                      guide_of(first_hits[i], noise[i], samples)});
  }
  canvas_.put(std::span<const PlacedGuide>(guides));
}

void Rendering::run(std::size_t count, WorkspacePool& pool,
                    const std::function<void(std::size_t, Workspace&, Progress&)>& task) {
  // Once a task has failed, the others end as if cancelled. The first failure is the one reported.
  std::atomic_flag failed;
  std::exception_ptr failure;
  try {
    run_tasks(count, options_.threads, [&](std::size_t index) {
      try {
        const FloatEnvironment ieee;
        WorkspacePool::Loan work(pool);
        task(index, *work, progress_);
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
}

void Rendering::render_grid(const Frame& frame, const TaskRunner& run_tasks) {
  const Tiles tiles(canvas_.region());
  run_tasks(tiles.count(), 1, [&](std::size_t index, Workspace& work, Progress& /*progress*/) {
    render_tile(frame, tiles.tile(index), work);
  });
}

void Rendering::put_aovs(const Frame& frame, const TaskRunner& run_tasks) {
  const Tiles tiles(canvas_.region());
  run_tasks(tiles.count(), 1, [&](std::size_t index, Workspace& work, Progress& progress) {
    Tracer tracer(frame, work, progress);
    AovTile aovs(options_.aovs, tiles.tile(index));
    aovs.take(measures_, canvas_.region());
    aovs.look(frame.camera(), tracer);
    canvas_.put_aovs(aovs);
  });
}

void Rendering::run_with_checkpoint(const Frame& frame, Passes& passes, WorkspacePool& pool,
                                    const TaskRunner& run_tasks, double begin) {
  const std::uint64_t picture =
      fingerprint(frame, canvas_.region(), {keeps_first_hits(), keeps_guides()}, progress_, rules_);
  Checkpoint checkpoint(options_.checkpoint, picture, passes, canvas_, pool, seconds_, begin);
  checkpoint.take_up();
  const TaskRunner run_and_tell = [&](std::size_t count, double share_after, const auto& task) {
    run_tasks(count, share_after, task);
    tell_of_checkpoint(checkpoint.take_complaint());
  };
  const auto keep = [&] {
    progress_.do_between_rays({});
    checkpoint.keep();
    tell_of_checkpoint(checkpoint.take_complaint());
  };
  progress_.do_between_rays([&] { checkpoint.keep_if_due(); });
  try {
    passes.run(run_and_tell);
  } catch (...) {
    keep();
    throw;
  }
  keep();
}

void Rendering::leave_checkpoint() const {
  try {
    leave_empty_checkpoint(options_.checkpoint);
  } catch (const std::exception& error) {
    tell_of_checkpoint(error.what());
  }
}

void Rendering::tell_of_checkpoint(const std::string& complaint) const {
  if (complaint.empty() || !options_.log) return;
  log(LogLevel::warning, text::format("no checkpoint was made: {}", complaint));
}

RenderStats Rendering::render_picture() {
  const double begin = seconds_();
  PassClock clock(settings_.time_budget, seconds_);
  WorkspacePool pool(rules_);
  progress_.begin();
  const Frame frame = [&] {
    WorkspacePool::Loan work(pool);
    return Frame(data_, settings_, *work);
  }();
  const TaskRunner run_tasks = [&](std::size_t count, double share_after, const auto& task) {
    progress_.begin_part(count, share_after);
    run(count, pool, task);
  };
  int passes = 0;
  const bool by_passes = asks_for_passes(settings_, options_.passes);
  if (by_passes) {
    Passes rendering(frame, canvas_.region(), options_.passes, keeps_first_hits(), clock, canvas_);
    if (options_.evenly) rendering.go_by_pass();
    if (options_.checkpoint.empty()) {
      rendering.run(run_tasks);
    } else {
      run_with_checkpoint(frame, rendering, pool, run_tasks, begin);
    }
    rendering.finish(run_tasks);
    measures_ = rendering.take_measures();
    if (settings_.denoise) std::ranges::fill(measures_.half_widths, unknown_half_width);
    passes = rendering.passes();
    if (is_any(options_.aovs)) put_aovs(frame, run_tasks);
  } else {
    render_grid(frame, run_tasks);
  }
  const WorkspacePool::Counts counts = pool.total();
  RenderStats stats = counts.stats;
  stats.passes = passes;
  if (by_passes) {
    report_measures(measures_, stats);
  } else {
    report_grid(settings_, frame.features().lens, stats);
  }
  report_cutoff(counts.cutoff, data_.scene().background, stats);
  if (settings_.denoise) {
    canvas_.denoise(strip_runner(), region_);
    forget_accuracy(stats);
  }
  progress_.finish();
  return stats;
}

Image Rendering::picture() const {
  return settings_.denoise ? filtered() : canvas_.copy();
}

Image Rendering::denoised(const std::function<bool()>& go_on) const {
  if (!keeps_guides()) {
    throw Error(ErrorCode::invalid_argument,
                "nothing is kept to denoise the picture: ask for RenderOptions::denoisable",
                "denoisable");
  }
  Image image = filtered(go_on);
  Settings settings = image.settings();
  settings.denoise = true;
  image.set_settings(std::move(settings));
  forget_accuracy(image.stats());
  if (options_.aovs.error) std::ranges::fill(image.channel("error"), unknown_half_width);
  return image;
}

Image Rendering::filtered(const std::function<bool()>& go_on) const {
  const auto run = [&](std::size_t count, const std::function<void(std::size_t)>& task) {
    run_tasks(count, options_.threads, [&](std::size_t index) {
      if (go_on && !go_on()) throw Error(ErrorCode::cancelled, "denoising was cancelled");
      const FloatEnvironment ieee;
      task(index);
    });
  };
  return canvas_.denoised_copy(run, region_);
}

StripRunner Rendering::strip_runner() {
  return [this](std::size_t count, const std::function<void(std::size_t)>& task) {
    run_tasks(count, options_.threads, [&](std::size_t index) {
      const FloatEnvironment ieee;
      progress_.poll();
      task(index);
    });
  };
}

double Rendering::steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void Rendering::run() {
  using Clock = std::chrono::steady_clock;
  const FloatEnvironment ieee;  // of this thread; others have their own for each tile
  const Clock::time_point begin = Clock::now();
  try {
    RenderStats stats = render_picture();
    stats.threads = allowed_threads(options_.threads);
    stats.prepare_seconds = data_.prepare_seconds();
    stats.memory = data_.memory();
    stats.trace_seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    canvas_.set_stats(stats);
    report(stats);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::out_of_memory, "there is not enough memory to render the picture");
  } catch (const Error& error) {
    if (error.code() == ErrorCode::cancelled && !options_.checkpoint.empty()) leave_checkpoint();
    throw;
  }
}

void Rendering::report(const RenderStats& stats) const {
  if (!options_.log) return;
  for (const std::string& warning : data_.warnings()) log(LogLevel::warning, warning);
  log(LogLevel::info,
      text::format("rendered {} pixels in {:.2f} s on {} thread{}", stats.pixels,
                   stats.trace_seconds, stats.threads, stats.threads == 1 ? "" : "s"));
  if (stats.passes > 0 && settings_.denoise) {
    log(LogLevel::info,
        text::format("{} passes: {} to {} samples a pixel, {:.1f} in the mean; denoised, so that "
                     "nothing is claimed of the accuracy",
                     stats.passes, stats.samples_min, stats.samples_max, stats.samples_mean));
  } else if (stats.passes > 0) {
    constexpr double steps = 255;
    log(LogLevel::info,
        text::format(
            "{} passes: {} to {} samples a pixel, {:.1f} in the mean; 95 of 100 pixels are "
            "within {:.2f} "
            "8-bit steps of the truth; {} not within the target",
            stats.passes, stats.samples_min, stats.samples_max, stats.samples_mean,
            steps * stats.half_width_95, stats.pixels_unresolved));
  }
  if (settings_.precision == Precision::exact) {
    log(LogLevel::info, text::format("exact: {} questions were too close for rounded arithmetic",
                                     stats.escalations));
  }
  if (options_.threads > stats.threads) {
    log(LogLevel::warning, text::format("asked for {} threads, but this process may use {} at most",
                                        options_.threads, stats.threads));
  }
  if (stats.samples_over_ray_bound > 0) {
    log(LogLevel::warning,
        text::format("{} camera samples reached the bound on rays and dropped the rest: "
                     "a lower recursion depth costs less",
                     stats.samples_over_ray_bound));
  }
}

void Rendering::log(LogLevel level, const std::string& line) const {
  const HostFloatEnvironment host;
  options_.log(level, line);
}

}  // namespace crt::core
