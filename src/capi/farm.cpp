// This file implements rendering on many machines through the C interface.
#include "crt/farm.hpp"

#include <algorithm>
#include <array>

#include "capi/structs.hpp"

namespace crt::capi {

static_assert(static_cast<int>(FarmTaskState::waiting) == CRT_FARM_TASK_WAITING);
static_assert(static_cast<int>(FarmTaskState::running) == CRT_FARM_TASK_RUNNING);
static_assert(static_cast<int>(FarmTaskState::lost) == CRT_FARM_TASK_LOST);
static_assert(static_cast<int>(FarmTaskState::done) == CRT_FARM_TASK_DONE);
static_assert(sizeof(crt_farm_task) == 160);

namespace {

FarmOptions to_farm_options(const crt_farm_options* options, const CancelValue& cancel_value) {
  const auto given = taken_or_default(options, "options");
  FarmOptions result{.script = to_options(given.script),
                     .tasks = given.tasks,
                     .tile_width = given.tile_width,
                     .tile_height = given.tile_height,
                     .render = to_options(given.render, cancel_value),
                     .max_primitives = given.max_primitives};
  if (given.has_frames != 0) result.frames = {given.first_frame, given.last_frame};
  if (given.least_seconds != 0) result.least_seconds = given.least_seconds;
  return result;
}

crt_farm_job to_c(const FarmPlan& plan) {
  crt_farm_job out{};
  const FarmFrames frames = plan.frames.value_or(FarmFrames{});
  out.tasks = plan.tasks;
  out.has_frames = plan.frames ? 1 : 0;
  out.first_frame = frames.first;
  out.last_frame = frames.last;
  out.width = plan.width;
  out.height = plan.height;
  out.passes = plan.passes;
  out.has_channels = plan.has_channels ? 1 : 0;
  out.seconds = plan.seconds;
  out.longest_seconds = plan.longest_seconds;
  return out;
}

crt_farm_progress to_c(const FarmStatus& status) {
  crt_farm_progress out{};
  out.waiting = status.count(FarmTaskState::waiting);
  out.running = status.count(FarmTaskState::running);
  out.lost = status.count(FarmTaskState::lost);
  out.done = status.count(FarmTaskState::done);
  out.share = status.share();
  out.seconds_spent = status.seconds_spent();
  out.seconds_left = status.seconds_left();
  return out;
}

crt_farm_task to_c(const FarmTask& task) {
  crt_farm_task out{};
  out.state = static_cast<std::int32_t>(task.state);
  out.seconds = task.seconds;
  out.estimated = task.estimated;
  out.share = task.share;
  task.worker.copy(out.worker, sizeof out.worker - 1);
  return out;
}

FarmMergeOptions to_merge_options(const crt_farm_merge_options& given,
                                  const std::filesystem::path& job,
                                  const CancelValue& cancel_value) {
  FarmMergeOptions result;
  if (given.output != nullptr) {
    result.output = [output = std::filesystem::path(given.output),
                     has_frames = read_farm_plan(job).frames.has_value()](int frame) {
      return has_frames ? frame_path(output, frame) : output;
    };
  }
  if (given.skip_count > 0) {
    require(given.skip, "options->skip");
    result.skip = {given.skip, given.skip + given.skip_count};
  }
  result.go_on = to_go_on(given.poll, given.poll_user, cancel_value);
  return result;
}

void report(const FarmMerge& merged, const crt_farm_merge_options& given) {
  if (given.report == nullptr) return;
  const auto call = [&given](crt_farm_report kind, int number, const std::string& why) {
    given.report(kind, number, why.c_str(), given.report_user);
  };
  for (const int frame : merged.frames) call(CRT_FARM_REPORT_WRITTEN, frame, "");
  for (const int task : merged.missing) call(CRT_FARM_REPORT_MISSING, task, "");
  for (const RefusedPart& part : merged.refused) call(CRT_FARM_REPORT_REFUSED, part.task, part.why);
}

}  // namespace

}  // namespace crt::capi

using namespace crt::capi;

crt_status crt_farm_plan(const char* script, const char* job, const crt_farm_options* options,
                         crt_farm_job* plan) {
  return guarded_with_cancel([&](const CancelValue& cancel_value) {
    require(script, "script");
    require(job, "job");
    given_size(plan, "plan");
    fill_in(plan, "plan",
            to_c(crt::plan_farm(script, job, to_farm_options(options, cancel_value))));
  });
}

crt_status crt_farm_read_plan(const char* job, crt_farm_job* plan) {
  return guarded([&] {
    require(job, "job");
    fill_in(plan, "plan", to_c(crt::read_farm_plan(job)));
  });
}

crt_status crt_farm_work(const char* job, int32_t task, const crt_farm_work_options* options,
                         int32_t* rendered) {
  return guarded_with_cancel([&](const CancelValue& cancel_value) {
    require(job, "job");
    const auto given = taken_or_default(options, "options");
    const bool is_new = crt::work_farm(
        job, task,
        {.threads = given.threads,
         .progress = to_progress(given.progress, given.progress_user, cancel_value)});
    if (rendered != nullptr) *rendered = is_new ? 1 : 0;
  });
}

crt_status crt_farm_merge(const char* job, const crt_farm_merge_options* options,
                          int32_t* complete) {
  return guarded_with_cancel([&](const CancelValue& cancel_value) {
    require(job, "job");
    const auto given = taken_or_default(options, "options");
    const crt::FarmMerge merged = crt::merge_farm(job, to_merge_options(given, job, cancel_value));
    report(merged, given);
    if (complete != nullptr) *complete = merged.complete() ? 1 : 0;
  });
}

crt_status crt_farm_status(const char* job, crt_farm_progress* progress) {
  return guarded([&] {
    require(job, "job");
    given_size(progress, "progress");
    fill_in(progress, "progress", to_c(crt::farm_status(job)));
  });
}

crt_status crt_farm_tasks(const char* job, crt_farm_task* tasks, size_t capacity, size_t* count) {
  return guarded([&] {
    require(job, "job");
    if (capacity > 0) require(tasks, "tasks");
    require(count, "count");
    const crt::FarmStatus status = crt::farm_status(job);
    const std::size_t written = std::min(capacity, status.tasks.size());
    std::transform(status.tasks.begin(),
                   status.tasks.begin() + static_cast<std::ptrdiff_t>(written), tasks,
                   [](const crt::FarmTask& task) { return to_c(task); });
    *count = status.tasks.size();
  });
}

crt_status crt_farm_sheet(const char* job, int32_t cell, crt_image** out) {
  return guarded([&] {
    require(job, "job");
    require(out, "out");
    *out = new crt_image(crt::farm_sheet(job, cell));
  });
}
