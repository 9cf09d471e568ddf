#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <crt/draft.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <thread>
#include <utility>

#include "cli/commands.hpp"
#include "cli/files.hpp"
#include "cli/interrupt.hpp"
#include "cli/picture_renderer.hpp"
#include "cli/watched_files.hpp"

namespace crt::cli {

namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

/// Files are looked at in this interval.
constexpr milliseconds interval{100};
/// A draft has a pixel for so many, across and down.
constexpr int draft_step = 8;

/// Shows a draft, which has fewer pixels, where a picture has nothing yet.
void put_behind(Image& picture, const Image& draft) {
  for (int y = 0; y < picture.height(); ++y) {
    const auto from_y = static_cast<int>(std::int64_t{y} * draft.height() / picture.height());
    for (int x = 0; x < picture.width(); ++x) {
      const auto from_x = static_cast<int>(std::int64_t{x} * draft.width() / picture.width());
      if (picture.at(x, y) == Color{0, 0, 0, 0}) picture.set(x, y, draft.at(from_x, from_y));
    }
  }
}

class Watch {
 public:
  explicit Watch(const WatchRequest& request)
      : request_(request), style_(progress_style(request)), output_(request.output) {
    if (output_.empty()) output_ = fs::path(request.scene).replace_extension(".png");
  }

  ExitCode run() {
    Reporter reporter(request_);
    if (!accept(reporter)) return reporter.finish();
    const InterruptScope interrupt;
    interrupt_ = &interrupt;
    while (!interrupt.interrupted()) {
      make_pictures();
      while (!is_over()) std::this_thread::sleep_for(interval);
    }
    return ExitCode::done;
  }

 private:
  /// Says whether there is something to watch and to write. If not, it reports that.
  bool accept(Reporter& reporter) const {
    std::error_code unlike;
    if (request_.scene == standard_stream || request_.output == standard_stream) {
      reporter.add(ErrorCode::invalid_argument, "only files can be watched and written again",
                   ExitCode::usage);
    } else if (fs::equivalent(request_.scene, output_, unlike)) {
      reporter.add(ErrorCode::invalid_argument,
                   fmt::format("the picture would overwrite its script '{}': name another file "
                               "with -o",
                               request_.scene.string()),
                   ExitCode::usage);
    } else {
      return accept_output(reporter);
    }
    return false;
  }

  bool accept_output(Reporter& reporter) const {
    try {
      check_picture(output_, false);
      return true;
    } catch (const Error& error) {
      const bool unknown_format = error.code() == ErrorCode::unsupported;
      reporter.add(error.code(), error.what(), unknown_format ? ExitCode::usage : ExitCode::files);
    }
    return false;
  }

  /// Runs the script once and makes what it shows. Whatever is wrong is reported.
  void make_pictures() {
    Reporter reporter(request_);
    files_.clear();
    last_look_ = Clock::now();
    has_changed_ = false;
    try {
      render_all(reporter);
    } catch (const Error& error) {
      // What has changed meanwhile is rendered next.
      if (error.code() != ErrorCode::cancelled) reporter.add(error);
    }
    reporter.finish();
  }

  void render_all(Reporter& reporter) {
    const Stopwatch watch;
    files_.add(request_.scene);
    if (std::error_code failed; !fs::exists(request_.scene, failed)) {
      reporter.note(fmt::format("waiting for the script '{}'", request_.scene.string()));
      return;
    }
    ScriptOptions options = request_.script;
    options.open_file = [this](const fs::path& file) {
      files_.add(file);
      return std::nullopt;
    };
    options.go_on = [this] { return !interrupt_->interrupted(); };
    const std::optional<Scene> scene =
        run_scene(ScriptSource(request_.scene), options, true, reporter).scene;
    if (!scene) return;
    const double parse_seconds = watch.seconds();
    const Settings& settings = scene->settings;
    const WriteOptions how{.reproducible = request_.reproducible};
    std::function<void(Image)> in_progress;
    if (std::min(settings.width, settings.height) > draft_step) {
      const Image draft = render_one(draft_of(*scene, draft_step), ProgressStyle::none, reporter);
      in_progress = [this, draft, how](Image picture) {
        put_behind(picture, draft);
        picture.write(output_, how);
      };
      Image nothing_yet(settings.width, settings.height);
      std::ranges::fill(nothing_yet.pixels(), 0.0F);
      nothing_yet.set_settings(settings);
      in_progress(std::move(nothing_yet));
      reporter.note(fmt::format("{}: a draft, {:.2f} s", output_.string(), watch.seconds()));
    }
    Image image = render_one(*scene, style_, reporter, in_progress);
    image.stats().parse_seconds = parse_seconds;
    image.write(output_, how);
    reporter.note(summary(output_.string(), image));
    if (const std::optional<std::string> warning = warning_of(image)) reporter.warn(*warning);
  }

  Image render_one(const Scene& scene, ProgressStyle style, Reporter& reporter,
                   std::function<void(Image)> in_progress = {}) {
    return render_scene(scene,
                        {.request = request_,
                         .picture = output_,
                         .name = output_.string(),
                         .style = style,
                         .go_on = [this] { return !is_over(); },
                         .in_progress = std::move(in_progress)},
                        reporter);
  }

  /// Says whether the picture is out of date, or no longer wanted. It looks at the files now and
  /// then. One thread at a time calls it.
  bool is_over() {
    const Clock::time_point now = Clock::now();
    if (!has_changed_ && now - last_look_ >= interval) {
      last_look_ = now;
      has_changed_ = files_.have_changed();
    }
    return has_changed_ || interrupt_->interrupted();
  }

  using Clock = std::chrono::steady_clock;

  const WatchRequest& request_;
  ProgressStyle style_;
  fs::path output_;
  WatchedFiles files_;
  const InterruptScope* interrupt_ = nullptr;
  Clock::time_point last_look_{};
  bool has_changed_ = false;
};

}  // namespace

ExitCode run_watch(const WatchRequest& request) {
  return Watch(request).run();
}

}  // namespace crt::cli
