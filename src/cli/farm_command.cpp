#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <crt/farm.hpp>
#include <crt/script.hpp>
#include <map>
#include <thread>

#include "cli/commands.hpp"
#include "cli/farm_drivers.hpp"
#include "cli/files.hpp"
#include "cli/progress.hpp"
#include "cli/reporter.hpp"

namespace crt::cli {

namespace {

namespace fs = std::filesystem;

/// Says which options a verb takes beside -o, --threads, --quiet and --diagnostics. Planning takes
/// all that is about the script, too.
const std::map<std::string, std::vector<std::string>> options_of_verbs = {
    {"work", {"--task"}},
    {"merge", {"--follow"}},
    {"status", {"--sheet"}},
    {"submit",
     {"--local", "--slurm", "--parallel", "--processes", "--hosts", "--slurm-option", "--no-wait"}},
};

bool is_of_some_verb(const std::string& option) {
  return std::any_of(options_of_verbs.begin(), options_of_verbs.end(), [&](const auto& verb) {
    return std::find(verb.second.begin(), verb.second.end(), option) != verb.second.end();
  });
}

/// Returns an option that the verb does not take, or "".
std::string senseless_option(const FarmRequest& request) {
  for (const std::string& option : request.given) {
    if (option == "--threads" || option == "-q,--quiet" || option == "--diagnostics") continue;
    if (request.verb == "plan") {
      if (is_of_some_verb(option)) return option;
      continue;
    }
    const std::vector<std::string>& taken = options_of_verbs.at(request.verb);
    if (std::find(taken.begin(), taken.end(), option) == taken.end()) return option;
  }
  return "";
}

class Farm {
 public:
  explicit Farm(const FarmRequest& request) : request_(request), reporter_(request) {}

  ExitCode run() {
    if (const std::string option = senseless_option(request_); !option.empty()) {
      reporter_.add(ErrorCode::invalid_argument,
                    fmt::format("{} is not for crt farm {}", option, request_.verb),
                    ExitCode::usage);
      return reporter_.finish();
    }
    try {
      if (request_.verb == "plan") plan();
      if (request_.verb == "work") work();
      if (request_.verb == "merge") merge();
      if (request_.verb == "status") show_status();
      if (request_.verb == "submit") submit();
    } catch (const Error& error) {
      // A picture's name may have an ending that is no format, or one without channels.
      const bool is_usage =
          error.code() == ErrorCode::invalid_argument || error.code() == ErrorCode::unsupported;
      is_usage ? reporter_.add(error.code(), error.what(), ExitCode::usage) : reporter_.add(error);
    }
    return reporter_.finish();
  }

 private:
  void plan() {
    if (request_.output.empty()) {
      throw Error(ErrorCode::invalid_argument, "name the job's folder with -o");
    }
    FarmOptions options{.script = request_.script,
                        .tasks = request_.tasks,
                        .least_seconds = request_.least_seconds,
                        .tile_width = request_.tile_width,
                        .tile_height = request_.tile_height,
                        .render = request_.render,
                        .max_primitives = request_.max_primitives};
    if (request_.frames) options.frames = {request_.frames->first, request_.frames->last};
    if (request_.film) options.frames = {.first = 0, .last = frames_of_script() - 1};
    options.render.progress = [this](double /*share*/) { return !interrupt_.interrupted(); };
    const FarmPlan planned = plan_farm(request_.target, request_.output, options);
    reporter_.note(
        fmt::format("{}: {} task{} of about {:.3g} s on one core, {:.3g} s at most{}",
                    request_.output.string(), planned.tasks, planned.tasks == 1 ? "" : "s",
                    planned.seconds / planned.tasks, planned.longest_seconds,
                    planned.passes > 0 ? fmt::format(", {} passes", planned.passes) : ""));
  }

  /// Returns how many frames the script's Settings have.
  int frames_of_script() {
    const ScriptResult result = run_script_file(request_.target, request_.script);
    const int frames =
        result.scene ? result.scene->settings.frames : 1;  // planning says what fails
    if (frames > 0) return frames;
    throw Error(ErrorCode::invalid_argument,
                fmt::format("'{}' has no frames: say them by frames -> 48 in its Settings, or such "
                            "as --frames 1-48",
                            request_.target.string()));
  }

  /// Works on one task, or on all that have no part, or one that is damaged.
  void work() {
    if (request_.task) {
      if (!work_on(*request_.task)) say_of(*request_.task, "was done before");
      return;
    }
    const int tasks = read_farm_plan(request_.target).tasks;
    int rendered = 0;
    for (int task = 0; task < tasks; ++task) rendered += work_on(task) ? 1 : 0;
    if (rendered == 0) {
      reporter_.note(fmt::format("{}: all tasks were done before", request_.target.string()));
    }
  }

  void say_of(int task, std::string_view what) {
    reporter_.note(fmt::format("task {}: {}", task, what));
  }

  /// Returns whether there was something to do.
  bool work_on(int task) {
    Progress progress(fmt::format("task {}", task), progress_style(request_));
    const bool rendered = work_farm(
        request_.target, task, {.threads = request_.render.threads, .progress = [&](double share) {
                                  progress.update(share);
                                  return !interrupt_.interrupted();
                                }});
    if (rendered) say_of(task, "done");
    return rendered;
  }

  /// Merges what has not been merged before.
  FarmMerge merge_what_is_there() {
    const FarmPlan planned = read_farm_plan(request_.target);
    FarmMergeOptions options{
        .output = {}, .skip = merged_, .go_on = [this] { return !interrupt_.interrupted(); }};
    if (!request_.output.empty()) {
      check_picture(request_.output, planned.has_channels);
      options.output = [&](int frame) {
        return planned.frames ? frame_path(request_.output, frame) : request_.output;
      };
    }
    FarmMerge merged = merge_farm(request_.target, options);
    merged_.insert(merged.frames.begin(), merged.frames.end());
    return merged;
  }

  void merge() {
    FarmMerge merged = merge_what_is_there();
    while (request_.follow && !merged.complete()) {
      constexpr std::chrono::seconds interval(1);
      std::this_thread::sleep_for(interval);
      if (interrupt_.interrupted()) throw Error(ErrorCode::cancelled, "interrupted");
      merged = merge_what_is_there();
    }
    report(merged);
  }

  /// Reports what merging has found. What is missing is an error.
  void report(const FarmMerge& merged) {
    reporter_.note(fmt::format("{}: {} picture{} merged", request_.target.string(), merged_.size(),
                               merged_.size() == 1 ? "" : "s"));
    for (const RefusedPart& refused : merged.refused) {
      reporter_.add(ErrorCode::io,
                    fmt::format("{}: work on task {} again", refused.why, refused.task),
                    ExitCode::files);
    }
    if (merged.missing.empty()) return;
    constexpr std::size_t max_named = 20;
    const std::size_t count = merged.missing.size();
    const auto* const first = merged.missing.data();
    reporter_.add(ErrorCode::io,
                  fmt::format("{} of {} tasks have no part: {}{}", count,
                              read_farm_plan(request_.target).tasks,
                              fmt::join(first, first + std::min(count, max_named), ", "),
                              count > max_named ? ", ..." : ""),
                  ExitCode::files);
  }

  void show_status() {
    if (!request_.sheet.empty()) check_picture(request_.sheet, false);
    const FarmStatus status = farm_status(request_.target);
    reporter_.print(
        fmt::format("{} tasks: {} done, {} running, {} lost, {} waiting\n"
                    "{:.0f} % done, {:.1f} s spent, about {:.1f} s of one worker left\n",
                    status.tasks.size(), status.count(FarmTaskState::done),
                    status.count(FarmTaskState::running), status.count(FarmTaskState::lost),
                    status.count(FarmTaskState::waiting), 100 * status.share(),
                    status.seconds_spent(), status.seconds_left()));
    for (std::size_t i = 0; i < status.tasks.size(); ++i) {
      const FarmTask& task = status.tasks[i];
      if (task.state == FarmTaskState::running || task.state == FarmTaskState::lost) {
        reporter_.print(fmt::format("task {}: {} on {}, {:.0f} %\n", i,
                                    task.state == FarmTaskState::lost ? "lost" : "running",
                                    task.worker, 100 * task.share));
      }
    }
    if (!request_.sheet.empty()) farm_sheet(request_.target).write(request_.sheet);
  }

  void submit() {
    const int drivers = int{request_.local} + int{request_.slurm} + int{request_.parallel};
    if (drivers != 1) {
      throw Error(ErrorCode::invalid_argument,
                  "say who does the work: one of --local, --slurm and --parallel");
    }
    // Who was lost has left no part. So a task gets some more chances.
    constexpr int rounds = 3;
    FarmMerge merged = merge_what_is_there();
    for (int round = 0; round < rounds && !merged.complete(); ++round) {
      std::vector<int> tasks = merged.missing;
      for (const RefusedPart& refused : merged.refused) tasks.push_back(refused.task);
      std::sort(tasks.begin(), tasks.end());
      const Driving driving{.request = request_, .tasks = tasks, .interrupt = interrupt_};
      if (request_.local) drive_local(driving);
      if (request_.parallel) drive_parallel(driving);
      if (request_.slurm) drive_slurm(driving);
      if (request_.no_wait) return;
      merged = merge_what_is_there();
    }
    report(merged);
  }

  const FarmRequest& request_;
  Reporter reporter_;
  InterruptScope interrupt_;
  std::set<int> merged_;
};

}  // namespace

ExitCode run_farm(const FarmRequest& request) {
  return Farm(request).run();
}

}  // namespace crt::cli
