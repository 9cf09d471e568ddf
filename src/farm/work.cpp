#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>

#include "core/render/accuracy.hpp"
#include "core/render/passes.hpp"
#include "crt/file.hpp"
#include "farm/part.hpp"
#include "farm/scene_files.hpp"
#include "text/format.hpp"

namespace crt::farm {

namespace {

using Clock = std::chrono::steady_clock;

/// A WorkLog says in a file of its own who works on a task, and how far that is. Nothing depends on
/// it but what a status shows. So it does not matter if it cannot be written.
class WorkLog {
 public:
  WorkLog(const Job& job, int task) : file_(job.log_file(task)) {
    std::array<char, 256> host{};
    if (gethostname(host.data(), host.size() - 1) != 0) host = {'?'};
    worker_ = text::format("{}:{}", host.data(), getpid());
    write(0, 0);
  }

  /// Takes the share done, and writes it now and then.
  void update(double share) {
    constexpr std::chrono::seconds interval(10);
    if (Clock::now() - written_ >= interval) write(share, 0);
  }
  void finish() { write(1, std::chrono::duration<double>(Clock::now() - begin_).count()); }

 private:
  void write(double share, double seconds) {
    written_ = Clock::now();
    try {
      check_replaceable(file_);
      write_file(file_, text::format("{} {:.3f} {:.6f}\n", worker_, share, seconds));
    } catch (const Error&) {
      return;
    }
  }

  std::filesystem::path file_;
  std::string worker_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point written_;
};

/// A TaskRenderer renders the pieces of a task. Those of one frame share what is prepared for it.
class TaskRenderer {
 public:
  TaskRenderer(const Job& job, const FarmWorkOptions& options) : job_(job), options_(options) {}

  std::vector<RenderedPiece> render_all(const Task& task, WorkLog& log) {
    std::int64_t pixels = 0;
    for (const Piece& piece : task.pieces) pixels += pixels_of(piece);
    std::int64_t done = 0;
    std::vector<RenderedPiece> rendered;
    for (const Piece& piece : task.pieces) {
      const auto progress = [&](double share) {
        const double of_task =
            (static_cast<double>(done) + share * static_cast<double>(pixels_of(piece))) /
            static_cast<double>(pixels);
        log.update(of_task);
        share_ = of_task;
        return go_on();
      };
      rendered.push_back(render_piece(piece, progress));
      done += pixels_of(piece);
    }
    return rendered;
  }

 private:
  static std::int64_t pixels_of(const Piece& piece) {
    return std::int64_t{piece.region.width} * piece.region.height;
  }

  bool go_on() const { return !options_.progress || options_.progress(share_); }

  void prepare_frame(int frame) {
    if (prepared_ && frame == frame_) return;
    const Manifest& manifest = job_.manifest;
    const auto go_on = [this] { return this->go_on(); };
    ScriptResult result = run_job_script(
        manifest, manifest.frames ? frame : manifest.t,
        [this](const std::string& name) { return open_job_file(job_, name); }, go_on);
    const Settings& settings = result.scene->settings;
    if (settings.width != manifest.width || settings.height != manifest.height) {
      throw Error(
          ErrorCode::invalid_argument,
          text::format("the frames of a job have one size: that of frame {} is {} x {}, and "
                       "that of the first {} x {}",
                       frame, settings.width, settings.height, manifest.width, manifest.height));
    }
    prepared_ = prepare(*result.scene, {.go_on = go_on, .max_primitives = manifest.max_primitives});
    by_passes_ = core::asks_for_passes(settings, manifest.passes);
    brightest_ = core::brightest_of(result.scene->background);
    frame_ = frame;
  }

  RenderedPiece render_piece(const Piece& piece, const std::function<bool(double)>& progress) {
    const Manifest& manifest = job_.manifest;
    prepare_frame(piece.frame);
    RenderOptions options{.region = piece.region,
                          .threads = options_.threads,
                          .progress = progress,
                          .seed = manifest.seed,
                          .passes = manifest.passes,
                          .max_ray_steps = manifest.max_ray_steps,
                          .aovs = manifest.aovs};
    // What is known of the whole picture is found from these.
    if (by_passes_) options.aovs.samples = options.aovs.error = true;
    RenderedPiece rendered{
        .piece = piece, .image = render(*prepared_, options), .brightest = brightest_};
    const RenderStats& stats = rendered.image.stats();
    rendered.cutoff_units = core::cutoff_units(stats.cutoff_mean, brightest_, stats.pixels);
    return rendered;
  }

  const Job& job_;
  const FarmWorkOptions& options_;
  std::optional<PreparedScene> prepared_;
  int frame_ = 0;
  bool by_passes_ = false;
  double brightest_ = 1;
  double share_ = 0;
};

bool is_whole(const Job& job, int task) {
  if (!has_part(job, task)) return false;
  try {
    read_part(job, task);
    return true;
  } catch (const Error& error) {
    if (error.code() == ErrorCode::out_of_memory) throw;
    return false;
  }
}

}  // namespace

}  // namespace crt::farm

namespace crt {

bool work_farm(const std::filesystem::path& job, int task, const FarmWorkOptions& options) {
  const farm::Job opened = farm::open_job(job);
  const auto tasks = static_cast<int>(opened.manifest.tasks.size());
  if (task < 0 || task >= tasks) {
    throw Error(ErrorCode::invalid_argument,
                text::format("there is no task {}: the job has 0 to {}", task, tasks - 1), "task");
  }
  if (farm::is_whole(opened, task)) return false;
  farm::check_replaceable(opened.part_file(task));
  farm::WorkLog log(opened, task);
  farm::TaskRenderer renderer(opened, options);
  farm::write_part(opened, task,
                   renderer.render_all(opened.manifest.tasks[static_cast<std::size_t>(task)], log));
  log.finish();
  return true;
}

}  // namespace crt
