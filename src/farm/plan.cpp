
#include <algorithm>
#include <cmath>
#include <system_error>

#include "core/math/float_environment.hpp"
#include "core/sampling/schedule.hpp"
#include "core/tasks/tasks.hpp"
#include "crt/file.hpp"
#include "farm/probe.hpp"
#include "farm/scene_files.hpp"
#include "farm/split.hpp"
#include "text/format.hpp"

namespace crt::farm {

namespace {

namespace fs = std::filesystem;

/// So many frames of an animation are measured. The others are taken for what lies between.
constexpr int max_probes = 8;
constexpr double seconds_of_longest = 1.3;  ///< tasks differ so much from their mean

void refuse_if(bool is_so, const char* argument, const std::string& why) {
  if (is_so) throw Error(ErrorCode::invalid_argument, why, argument);
}

void check(const FarmOptions& options) {
  refuse_if(options.tasks < 0 || options.tasks > max_tasks, "tasks",
            text::format("a job has 1 to {} tasks; 0 takes as many as are long enough", max_tasks));
  refuse_if(!std::isfinite(options.least_seconds) || options.least_seconds <= 0, "least_seconds",
            "the least seconds of a task must be above 0");
  refuse_if(options.tile_width < 0 || options.tile_height < 0, "tile_width",
            "a tile has at least one pixel; 0 cuts pictures where that makes tasks equal");
  refuse_if((options.tile_width == 0) != (options.tile_height == 0), "tile_height",
            "a tile has a width and a height");
  refuse_if(options.script.allow_outside_files, "allow_outside_files",
            "a job's script reads files of its own folder and of resource folders alone");
  refuse_if(options.script.open_file != nullptr, "open_file",
            "a job's files come from the file system: its planner calls no open_file");
  refuse_if(options.render.region.has_value(), "region", "a job is of whole pictures");
  refuse_if(!options.render.checkpoint.empty(), "checkpoint", "a job has parts, and no checkpoint");
  refuse_if(options.render.passes < 0, "passes", "passes must not be negative");
  if (!options.frames) return;
  const auto [first, last] = *options.frames;
  constexpr int most = std::numeric_limits<int>::max() - max_frames;
  refuse_if(
      first > last || first < -most || last > most || std::int64_t{last} - first >= max_frames,
      "frames", text::format("the frames are first..last, at most {}", max_frames));
}

/// Makes the folders of a job. Throws Error (io) if there is something.
void make_folders(const fs::path& folder) {
  try {
    fs::create_directories(folder);
    if (!fs::is_empty(folder)) {
      throw Error(ErrorCode::io, text::format("'{}' is not empty: name a new folder for the job",
                                              folder.string()));
    }
    for (const char* inside : {contents_folder, parts_folder, log_folder})
      fs::create_directory(folder / inside);
  } catch (const fs::filesystem_error& error) {
    throw Error(ErrorCode::io, text::format("cannot make the folder '{}': {}",
                                            error.path1().string(), error.code().message()));
  }
}

/// Leaves the folder of a job that could not be planned empty, so that it may be planned again.
void remove_folders(const fs::path& folder) {
  std::error_code ignored;
  for (const char* inside : {contents_folder, parts_folder, log_folder, manifest_name})
    fs::remove_all(folder / inside, ignored);
}

Manifest manifest_of(const fs::path& script, const FarmOptions& options) {
  return {.script = "scene/" + script.filename().string(),
          .resource_folders = static_cast<int>(options.script.resource_directories.size()),
          .t = options.script.t,
          .variables = options.script.variables,
          .settings = options.script.settings,
          .compat = options.script.compat,
          .max_steps = options.script.limits.steps,
          .max_image_pixels = options.script.limits.image_pixels,
          .frames = options.frames,
          .seed = options.render.seed,
          .passes = options.render.passes,
          .max_ray_steps = options.render.max_ray_steps,
          .max_primitives = options.max_primitives,
          .aovs = options.render.aovs};
}

/// Returns the passes that this machine renders in the time budget.
int passes_of_budget(const Settings& settings, const Probe& probe, int threads) {
  const double pixels = double{1} * settings.width * settings.height;
  const double samples =
      settings.time_budget * core::allowed_threads(threads) / (probe.seconds_per_sample * pixels);
  int passes = core::passes_until(1);
  const auto most = static_cast<std::int64_t>(std::min<double>(samples, settings.max_samples));
  while (core::samples_after(passes + 1).samples <= most) ++passes;
  return passes;
}

/// A Planner runs the script, measures frames and splits them.
class Planner {
 public:
  Planner(const fs::path& script, const fs::path& folder, const FarmOptions& options)
      : options_(options),
        job_{.folder = folder, .id = {}, .manifest = manifest_of(script, options)},
        files_(script.parent_path(), options.script.resource_directories, job_) {}

  FarmPlan plan() {
    const std::vector<int> probed = measure_frames();
    const auto [first, last] = frames_of(job_.manifest);
    std::vector<const CostMap*> frames;
    std::vector<CostMap> between = maps_between(probed, first, last);
    frames.reserve(between.size());
    for (const CostMap& map : between) frames.push_back(&map);
    job_.manifest.tasks = split(frames, first, shape(frames));
    job_.manifest.files = files_.hashes();
    const std::string text = to_text(job_.manifest);
    parse_manifest(text);  // what could not be read again is better refused now
    write_file(job_.folder / manifest_name, text);
    return plan_of(open_job(job_.folder));
  }

 private:
  /// Measures some frames, and returns which.
  std::vector<int> measure_frames() {
    const auto [first, last] = frames_of(job_.manifest);
    std::vector<int> frames;
    const int steps = std::min(max_probes - 1, last - first);
    for (int i = 0; i <= steps; ++i) {
      const double place = steps == 0 ? 0 : double{1} * (last - first) * i / steps;
      const int frame = first + static_cast<int>(std::lround(place));
      share_ = static_cast<double>(i) / (steps + 1);
      const bool reads_time = measure(frame);
      frames.push_back(frame);
      if (!reads_time) break;
    }
    return frames;
  }

  /// Measures a frame. Returns whether others differ.
  bool measure(int frame) {
    Manifest& manifest = job_.manifest;
    const double t = manifest.frames ? frame : manifest.t;
    const auto go_on = [this] { return this->go_on(); };
    const ScriptResult result = run_job_script(
        manifest, t, [this](const std::string& name) { return files_.open(name); }, go_on);
    const Settings& settings = result.scene->settings;
    validate_size(settings, frame);
    if (settings.denoise) {
      throw Error(ErrorCode::unsupported,
                  "a job cuts pictures into parts, which no filter can be applied to: leave out "
                  "'denoise'");
    }
    const bool has_budget = settings.time_budget > 0 && manifest.passes == 0;
    RenderOptions render = options_.render;
    render.passes = manifest.passes;
    Probe measured =
        probe(*result.scene,
              {.render = render, .max_primitives = options_.max_primitives, .go_on = go_on});
    if (has_budget) {
      const int passes = passes_of_budget(settings, measured, options_.render.threads);
      manifest.passes = passes;
      const double more =
          static_cast<double>(core::samples_after(passes).samples) / settings.min_samples;
      for (double& seconds : measured.map.seconds) seconds *= more;
    }
    maps_.push_back(std::move(measured.map));
    return result.reads_time;
  }

  void validate_size(const Settings& settings, int frame) {
    Manifest& manifest = job_.manifest;
    if (maps_.empty()) {
      manifest.width = settings.width;
      manifest.height = settings.height;
      return;
    }
    refuse_if(
        manifest.width != settings.width || manifest.height != settings.height, "frames",
        text::format("the frames of a job have one size: that of frame {} is {} x {}, and "
                     "that of the first {} x {}",
                     frame, settings.width, settings.height, manifest.width, manifest.height));
  }

  /// Returns a map for each frame, between those of the measured ones.
  std::vector<CostMap> maps_between(const std::vector<int>& probed, int first, int last) const {
    std::vector<CostMap> maps;
    std::size_t before = 0;
    for (int frame = first; frame <= last; ++frame) {
      while (before + 1 < probed.size() && probed[before + 1] <= frame) ++before;
      CostMap map = maps_[before];
      if (before + 1 < probed.size()) {
        const CostMap& next = maps_[before + 1];
        const double share =
            double{1} * (frame - probed[before]) / (probed[before + 1] - probed[before]);
        for (std::size_t i = 0; i < map.seconds.size(); ++i)
          map.seconds[i] += share * (next.seconds[i] - map.seconds[i]);
        map.prepare_seconds += share * (next.prepare_seconds - map.prepare_seconds);
      }
      maps.push_back(std::move(map));
    }
    return maps;
  }

  SplitShape shape(const std::vector<const CostMap*>& frames) const {
    double seconds = 0;
    for (const CostMap* map : frames) seconds += map->total() + map->prepare_seconds;
    const double fitting = std::floor(seconds / (seconds_of_longest * options_.least_seconds));
    const int tasks = options_.tasks > 0
                          ? options_.tasks
                          : static_cast<int>(std::clamp<double>(fitting, 1, max_tasks));
    return {.tasks = tasks, .tile_width = options_.tile_width, .tile_height = options_.tile_height};
  }

  bool go_on() const { return !options_.render.progress || options_.render.progress(share_); }

  const FarmOptions& options_;
  Job job_;
  FileCollector files_;
  std::vector<CostMap> maps_;
  double share_ = 0;
};

}  // namespace

}  // namespace crt::farm

namespace crt {

FarmPlan plan_farm(const std::filesystem::path& script, const std::filesystem::path& job,
                   const FarmOptions& options) {
  farm::check(options);
  farm::make_folders(job);
  try {
    return farm::Planner(script, job, options).plan();
  } catch (...) {
    farm::remove_folders(job);
    throw;
  }
}

}  // namespace crt
