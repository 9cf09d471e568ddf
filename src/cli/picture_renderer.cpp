#include "cli/picture_renderer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <crt/job.hpp>
#include <crt/prepared_scene.hpp>
#include <thread>
#include <utility>
#include <vector>

#include "cli/format_loader.hpp"
#include "text/printable.hpp"

namespace crt::cli {

ScriptResult run_scene(const ScriptSource& script, const ScriptOptions& options,
                       bool output_is_free, Reporter& reporter) {
  ScriptOptions with_print = options;
  with_print.print = [&](std::string_view line) {
    // Control characters could make a terminal do anything.
    const std::string text = text::printable(line, text::Kept::tabs_and_line_ends) + "\n";
    output_is_free ? reporter.print(text) : reporter.say(text);
  };
  ScriptResult result = script.run(with_print);
  for (const Diagnostic& diagnostic : result.diagnostics) {
    if (diagnostic.code == ErrorCode::cancelled) throw Error(diagnostic.code, diagnostic.message);
  }
  reporter.add(result.diagnostics);
  return result;
}

namespace {

/// Renders, and hands over the picture in progress if it is wanted.
Image render_seen(const PreparedScene& prepared, const RenderOptions& options,
                  const PictureTask& task) {
  if (!task.in_progress) return render(prepared, options);
  constexpr std::chrono::milliseconds end_interval{5};
  constexpr double least_pause = 2;
  constexpr double pause_of_work = 10;  // what becomes of a picture costs a tenth at most
  const crt::RenderJob job(prepared, options);
  double next = least_pause;
  for (const Stopwatch watch; !job.finished(); std::this_thread::sleep_for(end_interval)) {
    const double begin = watch.seconds();
    if (begin < next) continue;
    task.in_progress(job.snapshot());
    const double end = watch.seconds();
    next = end + std::max(least_pause, pause_of_work * (end - begin));
  }
  return job.wait();
}

Image trace(const Scene& scene, const PictureTask& task, const FormatLoader& loader,
            std::vector<std::string>& warnings) {
  const auto go_on = [&] { return task.go_on() && !loader.has_failed(); };
  const PreparedScene prepared =
      prepare(scene, {.go_on = go_on, .max_primitives = task.request.max_primitives});
  RenderOptions options = task.request.render;
  options.log = [&](LogLevel level, std::string_view line) {
    if (level == LogLevel::warning) warnings.emplace_back(line);
  };
  Progress progress(task.name, task.style);
  options.progress = [&](double share) {
    progress.update(share);
    return go_on();
  };
  return render_seen(prepared, options, task);
}

}  // namespace

Image render_scene(const Scene& scene, const PictureTask& task, Reporter& reporter) {
  FormatLoader loader(task.picture);
  std::vector<std::string> warnings;
  try {
    Image image = trace(scene, task, loader, warnings);
    loader.finish();
    for (const std::string& warning : warnings) reporter.warn(warning);
    return image;
  } catch (const Error& error) {
    if (error.code() == ErrorCode::cancelled) loader.finish();  // which may be the reason
    throw;
  }
}

std::optional<std::string> warning_of(const Image& image) {
  constexpr double max_in_a_good_picture = 0.03;
  const RenderStats& stats = image.stats();
  const auto ended = static_cast<double>(stats.rays_beyond_depth);
  if (ended <= max_in_a_good_picture * static_cast<double>(stats.camera_rays)) return std::nullopt;
  const Settings& settings = image.settings();
  const bool is_black = settings.cutoff == Cutoff::black;
  return fmt::format("{} rays ended at recursiondepth {} and {}: raise recursiondepth",
                     stats.rays_beyond_depth, settings.recursion_depth,
                     is_black ? "count as black" : "see the background");
}

std::string summary(const std::string& name, const Image& image) {
  const RenderStats& stats = image.stats();
  return fmt::format(
      "{}: {} x {} pixels, {} rays, {:.2f} s", name, image.width(), image.height(),
      stats.camera_rays + stats.shadow_rays + stats.reflection_rays + stats.refraction_rays,
      stats.parse_seconds + stats.prepare_seconds + stats.trace_seconds + stats.write_seconds);
}

}  // namespace crt::cli
