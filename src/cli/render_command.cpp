#include <fmt/format.h>
#include <unistd.h>

#include <crt/farm.hpp>
#include <crt/file.hpp>
#include <crt/image.hpp>
#include <utility>

#include "cli/commands.hpp"
#include "cli/files.hpp"
#include "cli/film.hpp"
#include "cli/interrupt.hpp"
#include "cli/picture_renderer.hpp"
#include "cli/render_plan.hpp"
#include "cli/stats_json.hpp"

namespace crt::cli {

namespace {

namespace fs = std::filesystem;

/// Renders the pictures of one request, one after the other.
class RenderJob {
 public:
  explicit RenderJob(const RenderRequest& request)
      : request_(request), reporter_(request), style_(progress_style(request)) {}

  ExitCode run() {
    if (request_.output == standard_stream && isatty(STDOUT_FILENO) != 0) {
      reporter_.add(ErrorCode::invalid_argument,
                    "standard output is a terminal, which shows no picture file: send it "
                    "elsewhere, such as by | chafa, which does",
                    ExitCode::usage);
      return reporter_.finish();
    }
    const auto pictures = plan_pictures(request_, reporter_);
    if (!pictures) return reporter_.finish();
    const InterruptScope interrupt;
    interrupt_ = &interrupt;
    bool all_done = true;
    for (const PlannedPicture& picture : *pictures) {
      all_done = render_planned(picture) && all_done;
      if (interrupt.interrupted()) break;
    }
    if (all_done || (pictures->size() > 1 && !reports_.empty())) write_stats(pictures->size() > 1);
    return reporter_.finish();
  }

 private:
  /// Makes a picture, or several frames. Returns false if that failed, which is then reported.
  bool render_planned(const PlannedPicture& picture) {
    has_warned_ = false;
    // The frames of a film are known when its script has run for the first one.
    frames_ = request_.frames.value_or(FrameRange{});
    try {
      if (picture.is_film) return render_film(picture);
      if (!request_.frames) return write_picture(picture, request_.script.t, std::nullopt);
      for (int frame = frames_.first; frame <= frames_.last; ++frame) {
        if (!write_picture(picture, frame, frame)) return false;
      }
      return true;
    } catch (const Error& error) {
      reporter_.add(error);
    }
    return false;
  }

  /// Renders one picture, from script to file.
  bool write_picture(const PlannedPicture& planned, double t, std::optional<int> frame) {
    const fs::path output = frame ? frame_path(planned.output, *frame) : planned.output;
    const bool to_stream = output == standard_stream;
    const std::string name = to_stream ? "standard output" : output.string();
    std::optional<Image> image = render_at(planned, t, name, output);
    if (!image) return false;
    const Stopwatch watch;
    const WriteOptions options{.reproducible = request_.reproducible};
    if (to_stream) {
      const std::vector<std::byte> file = image->encode(usual_ending(request_) + 1, options);
      reporter_.print({reinterpret_cast<const char*>(file.data()), file.size()},
                      Reporter::IfClosed::fails);
    } else {
      image->write(output, options);
    }
    image->stats().write_seconds = watch.seconds();
    finish(planned, *image, name, frame);
    return true;
  }

  bool render_film(const PlannedPicture& planned) {
    std::optional<Film> film;
    FilmShape shape{.frames_per_second = request_.frames_per_second};
    for (int frame = frames_.first; frame <= frames_.last; ++frame) {
      const std::string name = fmt::format("{} ({})", planned.output.string(), frame);
      std::optional<Image> image = render_at(planned, frame, name, "frame.png");
      if (!image) return false;
      const Stopwatch watch;
      if (!film) {
        shape.width = image->width();
        shape.height = image->height();
        film.emplace(planned.output, shape);
      }
      check_frame(*image, shape, frame);
      film->add(*image);
      if (!request_.keep_frames.empty()) {
        const fs::path kept = request_.keep_frames / planned.output.stem();
        image->write(frame_path(kept.string() + ".png", frame),
                     {.reproducible = request_.reproducible});
      }
      image->stats().write_seconds = watch.seconds();
      finish(planned, *image, name, frame);
    }
    film->finish();
    reporter_.note(fmt::format("{}: {} frames, {:g} a second", planned.output.string(),
                               frames_.last - frames_.first + 1, request_.frames_per_second));
    return true;
  }

  static void check_frame(const Image& image, const FilmShape& shape, int frame) {
    if (image.width() == shape.width && image.height() == shape.height) return;
    throw Error(ErrorCode::invalid_argument,
                fmt::format("the frames of a film have one size: that of frame {} has {} x {} "
                            "pixels, and the first {} x {}",
                            frame, image.width(), image.height(), shape.width, shape.height));
  }

  /// Returns the script's picture at a time, or nothing after a report. Throws Error (cancelled) if
  /// it was interrupted.
  std::optional<Image> render_at(const PlannedPicture& planned, double t, const std::string& name,
                                 const fs::path& output) {
    try {
      std::optional<Image> image = render_uninterrupted(planned, t, name, output);
      if (!interrupt_->interrupted()) return image;
    } catch (const Error& error) {
      if (error.code() != ErrorCode::cancelled) throw;
    }
    throw Error(ErrorCode::cancelled,
                fmt::format("interrupted: '{}' is not written{}",
                            planned.is_film ? planned.output.string() : name, where_to_go_on()));
  }

  std::optional<Image> render_uninterrupted(const PlannedPicture& planned, double t,
                                            const std::string& name, const fs::path& output) {
    const auto go_on = [this] { return !interrupt_->interrupted(); };
    const Stopwatch watch;
    ScriptOptions options = request_.script;
    options.t = t;
    options.go_on = go_on;
    // Standard output belongs to what was asked for there.
    const bool is_free = request_.stats != standard_stream && planned.output != standard_stream;
    ScriptResult result = run_scene(planned.script, options, is_free, reporter_);
    std::optional<Scene>& scene = result.scene;
    const double parse_seconds = watch.seconds();
    if (!scene || !take_frames(planned, scene->settings)) return std::nullopt;
    warn_of_still(planned, result);
    const std::optional<Region>& region = request_.render.region;
    if (region && !reporter_.accept_region(*region, scene->settings)) return std::nullopt;
    if (request_.section) {
      scene->camera.section_normal = request_.section->normal;
      scene->camera.section_offset = request_.section->offset;
    }
    projection_ = scene->camera.projection;
    const PictureTask task{.request = request_,
                           .picture = output == standard_stream ? usual_name() : output,
                           .name = name,
                           .style = style_,
                           .go_on = go_on};
    Image image = render_scene(*scene, task, reporter_);
    image.stats().parse_seconds = parse_seconds;
    return image;
  }

  /// Takes the frames of a film from its script, if no others are asked for. Returns false if it
  /// says none, which is then reported.
  bool take_frames(const PlannedPicture& planned, const Settings& settings) {
    if (!planned.is_film || request_.frames) return true;
    frames_.last = settings.frames - 1;
    if (settings.frames > 0) return true;
    reporter_.add(
        ErrorCode::invalid_argument,
        fmt::format("'{}' is a film: say of which frames, by frames -> 48 in the Settings "
                    "of '{}', or such as --frames 1-48",
                    planned.output.string(), planned.script.name()),
        ExitCode::usage);
    return false;
  }

  /// Warns of frames that will be the same.
  void warn_of_still(const PlannedPicture& planned, const ScriptResult& result) {
    if (frames_.first < frames_.last && !result.reads_time)
      reporter_.warn(fmt::format("all frames of '{}' are the same, as it does not read t",
                                 planned.script.name()));
  }

  /// Warns of what a picture lacks. One of a film stands for all.
  void warn_of_picture(const Image& image) {
    const std::optional<std::string> warning = warning_of(image);
    if (warning && !std::exchange(has_warned_, true)) reporter_.warn(*warning);
  }

  fs::path usual_name() const { return std::string("picture") + usual_ending(request_); }

  /// Reports a picture that is done.
  void finish(const PlannedPicture& planned, const Image& image, const std::string& name,
              std::optional<int> frame) {
    reporter_.note(summary(name, image));
    warn_of_picture(image);
    reports_.push_back({.script = planned.script.name(),
                        .output = planned.is_film ? planned.output.string() : name,
                        .frame = frame,
                        .region = request_.render.region,
                        .settings = image.settings(),
                        .projection = projection_,
                        .stats = image.stats()});
    if (interrupt_->interrupted()) throw Error(ErrorCode::cancelled, "interrupted");
  }

  std::string where_to_go_on() const {
    const fs::path& checkpoint = request_.render.checkpoint;
    std::error_code ignored;
    if (checkpoint.empty() || !fs::exists(checkpoint, ignored)) return "";
    return fmt::format("; the same command goes on from its --checkpoint '{}'",
                       checkpoint.string());
  }

  /// Writes one object for one picture, and a list for frames or several scripts.
  void write_stats(bool several_scripts) try {
    if (request_.stats.empty()) return;
    const bool is_list = several_scripts || reports_.front().frame;
    const std::string json = is_list ? to_json(reports_) : to_json(reports_.front());
    if (request_.stats == standard_stream) {
      reporter_.print(json, Reporter::IfClosed::fails);
    } else {
      write_file(request_.stats, json);
    }
  } catch (const Error& error) {
    reporter_.add(error);
  }

  const RenderRequest& request_;
  Reporter reporter_;
  ProgressStyle style_;
  const InterruptScope* interrupt_ = nullptr;
  Projection projection_{};
  FrameRange frames_{};
  bool has_warned_ = false;
  std::vector<PictureReport> reports_;
};

}  // namespace

ExitCode run_render(const RenderRequest& request) {
  return RenderJob(request).run();
}

}  // namespace crt::cli
