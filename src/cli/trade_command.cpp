#include <fmt/format.h>

#include <chrono>
#include <crt/file.hpp>
#include <crt/image.hpp>
#include <crt/prepared_scene.hpp>
#include <exception>
#include <set>
#include <utility>

#include "cli/commands.hpp"
#include "cli/interrupt.hpp"
#include "cli/picture_renderer.hpp"
#include "cli/progress.hpp"
#include "cli/reporter.hpp"
#include "cli/script_source.hpp"
#include "cli/trade_ladder.hpp"
#include "cli/trade_measure.hpp"
#include "cli/trade_report.hpp"
#include "cli/trade_solids.hpp"

namespace crt::cli {

namespace {

namespace fs = std::filesystem;

/// Holds the parts that stand for the whole picture, rendered with one setting.
struct RenderedParts {
  std::vector<Image> images;
  double seconds = 0;
  double samples = 0;  ///< a pixel, on average
  double cutoff = 0;   ///< a pixel, on average, in display units
  int threads = 0;
  bool bounces = false;  ///< there are mirrors or transparent things
};

double pixels_of(const Region& region) {
  return double{1} * region.width * region.height;
}

/// Returns the share of the camera rays that is for the part itself. Adaptive rendering samples its
/// margin, too, which a whole picture has not got.
double share_within(const RenderStats& stats) {
  return stats.samples_mean * static_cast<double>(stats.pixels) /
         static_cast<double>(stats.camera_rays);
}

/// A pixel of a reference gets about this many samples. This is for planning.
constexpr double expected_reference_samples = 400;

/// Is thrown where a setting takes longer than it may.
struct TooSlow : std::exception {};

class Trade {
 public:
  explicit Trade(const TradeRequest& request)
      : request_(request), reporter_(request), style_(progress_style(request)) {}

  ExitCode run() {
    if (request_.scene == standard_stream && request_.output.empty()) {
      reporter_.add(ErrorCode::invalid_argument,
                    "a script from standard input has no name to call the table by: name it with "
                    "-o",
                    ExitCode::usage);
      return reporter_.finish();
    }
    try {
      check_writable(with_ending(".csv"));
      if (request_.measure) {
        trade_solids(request_, with_ending(""), reporter_);
      } else if (prepare_scene()) {
        measure_and_tell();
      }
    } catch (const Error& error) {
      reporter_.add(error);
    }
    return reporter_.finish();
  }

 private:
  using Clock = std::chrono::steady_clock;

  fs::path with_ending(const char* ending) const {
    fs::path path = request_.output;
    if (path.empty()) {
      path = request_.scene;
      path.replace_extension();
      path += "-trade";
    }
    path += ending;
    return path;
  }

  /// Says whether there is a scene and a part of it to measure. If not, it reports what is wrong.
  bool prepare_scene() {
    ScriptOptions options = request_.script;
    const ScriptSource script(request_.scene, options.limits);
    ScriptResult result = run_scene(script, options, false, reporter_);
    if (!result.scene) return false;
    scene_ = std::move(*result.scene);
    scene_.settings.denoise = false;  // What is measured is what rendering brings.
    const Settings& settings = scene_.settings;
    if (!request_.region) {
      parts_ = bands_of(settings.width, settings.height, request_.pixels);
      return true;
    }
    parts_ = {*request_.region};
    return reporter_.accept_region(*request_.region, settings);
  }

  void measure_and_tell() {
    TradeReport report;
    {
      const InterruptScope interrupt;
      interrupt_ = &interrupt;
      Progress progress(request_.scene.filename().string(), style_);
      progress_ = &progress;
      measure(report);
      progress_ = nullptr;
      interrupt_ = nullptr;
    }
    if (report.rungs.empty()) {
      reporter_.add(
          ErrorCode::limit,
          fmt::format(
              "nothing is done within {} s: give it more by --most-seconds, or less to do by "
              "--pixels, --region or --width and --height",
              request_.max_seconds),
          ExitCode::usage);
      return;
    }
    if (!request_.quiet) reporter_.print(report_text(report, {request_.budget, request_.error}));
    write(report);
  }

  void write(const TradeReport& report) {
    write_file(with_ending(".csv"), report_csv(report));
    write_file(with_ending(".svg"), report_plot(report));
    reporter_.note(fmt::format("{}: the table; {}: the plot", with_ending(".csv").string(),
                               with_ending(".svg").string()));
  }

  void measure(TradeReport& report) {
    prepared_ = prepare(scene_);
    for (const Region& part : parts_) measured_pixels_ += pixels_of(part);
    const double all_pixels = double{1} * scene_.settings.width * scene_.settings.height;
    const double to_whole = all_pixels / measured_pixels_;

    // One sample a pixel shows how long one takes, and whether depths matter.
    plan(ladder_of(scene_, true));
    Settings single = scene_.settings;
    single.target_error = single.time_budget = 0;
    single.supersampling = single.dof_samples = 1;
    const RenderedParts probe = render_parts(single);
    Scene measured = scene_;
    measured.settings.time_budget /= to_whole;
    const std::vector<Rung> ladder = ladder_of(measured, probe.bounces);
    plan(ladder);
    work_done_ = 1;

    const std::vector<Image> reference = render_reference(report);
    std::set<Family> too_slow;
    for (const Rung& rung : ladder) {
      const bool is_hopeless = too_slow.contains(rung.family) ||
                               rung.expected_samples * probe.seconds > 2 * request_.max_seconds;
      const std::optional<RenderedParts> rendered = is_hopeless ? std::nullopt : render_often(rung);
      if (rendered) {
        report.rungs.push_back({.family = rung.family,
                                .options = rung.options,
                                .seconds = to_whole * rendered->seconds,
                                .samples = rendered->samples,
                                .error = displayed_difference(rendered->images, reference)});
      } else {
        report.left_out.push_back(rung.options.empty() ? "(as the script says)" : rung.options);
        too_slow.insert(rung.family);
      }
      work_done_ += rung.expected_samples;
    }
    report.scene = request_.scene.string();
    report.width = scene_.settings.width;
    report.height = scene_.settings.height;
    report.measured_pixels = static_cast<std::size_t>(measured_pixels_);
    report.parts = parts_.size();
    report.threads = probe.threads;
  }

  void plan(const std::vector<Rung>& ladder) {
    expected_work_ = 1 + 2 * expected_reference_samples;
    for (const Rung& rung : ladder) expected_work_ += rung.expected_samples;
  }

  /// Returns the mean of two renders that have no random number in common, with each other or with
  /// the ladder.
  std::vector<Image> render_reference(TradeReport& report) {
    std::vector<RenderedParts> renders;
    for (const std::uint64_t further : {std::uint64_t{1}, std::uint64_t{2}}) {
      Settings settings = reference_settings(scene_.settings, request_.reference_samples,
                                             scene_.settings.seed + further);
      settings.time_budget = request_.max_seconds;
      report.reference_depth = settings.recursion_depth;
      work_of_this_ = expected_reference_samples;
      renders.push_back(render_parts(settings));
      work_done_ += work_of_this_;
    }
    std::vector<Image> means;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      means.push_back(mean_of(renders[0].images[i], renders[1].images[i]));
    }
    // Two estimates that differ by d have a mean that is off by about d/2.
    const PictureError difference = displayed_difference(renders[0].images, renders[1].images);
    report.uncertainty = {.rmse = difference.rmse / 2, .p999 = difference.p999 / 2};
    report.reference_samples = renders[0].samples + renders[1].samples;
    report.reference_most_samples = 2 * request_.reference_samples;
    report.reference_cutoff = steps_of_8_bits * renders[0].cutoff;
    return means;
  }

  /// Renders once, or again if it is fast. The fastest run counts, as the machine may have had
  /// other things to do.
  std::optional<RenderedParts> render_often(const Rung& rung) {
    constexpr int max_renders = 3;
    const double long_enough = request_.max_seconds / 4;
    work_of_this_ = rung.expected_samples;
    deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                   std::chrono::duration<double>(request_.max_seconds));
    std::optional<RenderedParts> first = render_in_time(rung.settings);
    deadline_.reset();
    if (!first) return std::nullopt;
    RenderedParts best = std::move(*first);
    double seconds = best.seconds;
    for (int i = 1; i < max_renders && seconds < long_enough; ++i) {
      RenderedParts again = render_parts(rung.settings);
      seconds += again.seconds;
      if (again.seconds < best.seconds) best = std::move(again);
    }
    return best;
  }

  /// Returns nothing if it is not done before the deadline.
  std::optional<RenderedParts> render_in_time(const Settings& settings) {
    try {
      return render_parts(settings);
    } catch (const TooSlow&) {
      return std::nullopt;
    }
  }

  RenderedParts render_parts(const Settings& settings) {
    Scene scene = scene_;
    scene.settings = settings;
    RenderedParts result;
    double share_before = 0;
    for (const Region& part : parts_) {
      const double share = pixels_of(part) / measured_pixels_;
      // The time budget is shared among the parts.
      scene.settings.time_budget = share * settings.time_budget;
      const PreparedScene prepared = prepare(scene, *prepared_);
      Image image = render_part(prepared, part, share_before, share);
      const RenderStats& stats = image.stats();
      result.seconds += stats.trace_seconds * share_within(stats);
      result.samples += share * stats.samples_mean;
      result.cutoff += share * stats.cutoff_mean;
      result.bounces = result.bounces || stats.reflection_rays > 0 || stats.refraction_rays > 0 ||
                       stats.rays_beyond_depth > 0 || stats.rays_below_min_weight > 0;
      result.threads = stats.threads;
      result.images.push_back(std::move(image));
      share_before += share;
    }
    return result;
  }

  Image render_part(const PreparedScene& prepared, const Region& part, double share_before,
                    double share) {
    RenderOptions options{.region = part, .threads = request_.threads};
    options.progress = [&](double done) {
      progress_->update((work_done_ + (share_before + share * done) * work_of_this_) /
                        expected_work_);
      return !interrupt_->interrupted() && !(deadline_ && Clock::now() > *deadline_);
    };
    try {
      Image image = render(prepared, options);
      if (!interrupt_->interrupted()) return image;
    } catch (const Error& error) {
      if (error.code() != ErrorCode::cancelled) throw;
      if (!interrupt_->interrupted()) throw TooSlow();
    }
    throw Error(ErrorCode::cancelled, "interrupted: nothing is written");
  }

  const TradeRequest& request_;
  Reporter reporter_;
  ProgressStyle style_;
  Scene scene_;
  std::optional<PreparedScene> prepared_;
  std::vector<Region> parts_;
  double measured_pixels_ = 0;
  const InterruptScope* interrupt_ = nullptr;
  Progress* progress_ = nullptr;
  /// At this time what is rendered is given up.
  std::optional<Clock::time_point> deadline_;
  // The expected work is in samples a pixel.
  double expected_work_ = 1;
  double work_done_ = 0;
  double work_of_this_ = 1;
};

}  // namespace

ExitCode run_trade(const TradeRequest& request) {
  return Trade(request).run();
}

}  // namespace crt::cli
