#include <fmt/format.h>

#include <chrono>
#include <crt/file.hpp>
#include <crt/image.hpp>
#include <crt/prepared_scene.hpp>
#include <utility>

#include "cli/commands.hpp"
#include "cli/files.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "cli/reporter.hpp"
#include "cli/stats_json.hpp"

namespace crt::cli {

namespace {

namespace fs = std::filesystem;

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

std::uint64_t all_rays(const RenderStats& stats) {
  return stats.camera_rays + stats.shadow_rays + stats.reflection_rays + stats.refraction_rays;
}

/// Renders the pictures of one request, one after the other.
class RenderJob {
 public:
  explicit RenderJob(const RenderRequest& request)
      : request_(request), reporter_(request), style_(progress_style(request)) {}

  ExitCode run() {
    try {
      if (accept_output()) render_all();
    } catch (const Error& error) {
      reporter_.add(error);
    }
    return reporter_.finish();
  }

 private:
  /// Says whether the picture can be written. If not, it reports that before any work is done.
  bool accept_output() {
    std::error_code unlike;
    if (fs::equivalent(request_.scene, request_.output, unlike)) {
      reporter_.add(
          ErrorCode::invalid_argument,
          fmt::format("the picture would overwrite its script '{}': name another file with -o",
                      request_.scene.string()),
          ExitCode::usage);
      return false;
    }
    try {
      check_picture(request_.output, request_.render.aovs != Aovs{});
      if (!request_.stats.empty() && request_.stats != "-") check_writable(request_.stats);
      if (!request_.render.checkpoint.empty()) check_writable(request_.render.checkpoint);
    } catch (const Error& error) {
      const bool unknown_format = error.code() == ErrorCode::unsupported;
      reporter_.add(error.code(), error.what(), unknown_format ? ExitCode::usage : ExitCode::files);
      return false;
    }
    return true;
  }

  void render_all() {
    if (!request_.frames) {
      if (render_picture(request_.script.t, std::nullopt)) write_stats(to_json(reports_.front()));
      return;
    }
    for (int frame = request_.frames->first; frame <= request_.frames->last; ++frame) {
      if (!render_picture(frame, frame)) return;
    }
    write_stats(to_json(reports_));
  }

  /// Renders one picture, from script to file. Returns false if that failed, which is then
  /// reported.
  bool render_picture(double t, std::optional<int> frame) {
    const Stopwatch parse_watch;
    const std::optional<Scene> scene = run_scene(t);
    const double parse_seconds = parse_watch.seconds();
    if (!scene) return false;
    const std::optional<Region>& region = request_.render.region;
    if (region && !reporter_.accept_region(*region, scene->settings)) return false;

    const fs::path output = frame ? frame_path(request_.output, *frame) : request_.output;
    const InterruptScope interrupt;
    Image image = trace(*scene, output.string(), interrupt);
    for (const std::string& warning : std::exchange(warnings_, {})) reporter_.note(warning);
    image.stats().parse_seconds = parse_seconds;
    const Stopwatch write_watch;
    image.write(output, {.reproducible = request_.reproducible});
    image.stats().write_seconds = write_watch.seconds();

    const RenderStats& stats = image.stats();
    reporter_.note(fmt::format(
        "{}: {} x {} pixels, {} rays, {:.2f} s", output.string(), image.width(), image.height(),
        all_rays(stats),
        stats.parse_seconds + stats.prepare_seconds + stats.trace_seconds + stats.write_seconds));
    reports_.push_back({.script = request_.scene.string(),
                        .output = output.string(),
                        .frame = frame,
                        .region = request_.render.region,
                        .settings = image.settings(),
                        .projection = scene->camera.projection,
                        .stats = stats});
    if (interrupt.interrupted()) throw Error(ErrorCode::cancelled, "interrupted");
    return true;
  }

  std::optional<Scene> run_scene(double t) {
    ScriptOptions options = request_.script;
    options.t = t;
    // Standard output belongs to the statistics if they are asked for there.
    options.print = [this](std::string_view line) {
      const std::string text = fmt::format("{}\n", line);
      request_.stats == "-" ? reporter_.say(text) : reporter_.print(text);
    };
    ScriptResult result = run_script_file(request_.scene, options);
    reporter_.add(result.diagnostics);
    return std::move(result.scene);
  }

  Image trace(const Scene& scene, const std::string& name, const InterruptScope& interrupt) {
    PrepareOptions how{.max_primitives = request_.max_primitives};
    how.go_on = [&] { return !interrupt.interrupted(); };
    RenderOptions options = request_.render;
    options.log = [&](LogLevel level, std::string_view line) {
      if (level == LogLevel::warning) warnings_.push_back(fmt::format("crt: warning: {}", line));
    };
    try {
      const PreparedScene prepared = prepare(scene, how);
      Progress progress(name, style_);
      options.progress = [&](double share) {
        progress.update(share);
        return !interrupt.interrupted();
      };
      Image image = render(prepared, options);
      if (!interrupt.interrupted()) return image;
    } catch (const Error& error) {
      if (error.code() != ErrorCode::cancelled) throw;
    }
    throw Error(ErrorCode::cancelled,
                fmt::format("interrupted: '{}' is not written{}", name, where_to_go_on()));
  }

  std::string where_to_go_on() const {
    const fs::path& checkpoint = request_.render.checkpoint;
    std::error_code ignored;
    if (checkpoint.empty() || !fs::exists(checkpoint, ignored)) return "";
    return fmt::format("; the same command goes on from its --checkpoint '{}'",
                       checkpoint.string());
  }

  void write_stats(const std::string& json) {
    if (request_.stats == "-") {
      reporter_.print(json, Reporter::IfClosed::fails);
    } else if (!request_.stats.empty()) {
      write_file(request_.stats, json);
    }
  }

  const RenderRequest& request_;
  Reporter reporter_;
  ProgressStyle style_;
  std::vector<PictureReport> reports_;
  std::vector<std::string> warnings_;
};

}  // namespace

ExitCode run_render(const RenderRequest& request) {
  return RenderJob(request).run();
}

}  // namespace crt::cli
