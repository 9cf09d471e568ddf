// This file implements rendering through the C interface, at once or as a job.
#include <string>

#include "capi/structs.hpp"
#include "crt/render.hpp"

namespace crt::capi {

namespace {

Aovs to_aovs(std::uint32_t bits) {
  constexpr std::uint32_t all_bits = CRT_AOV_DEPTH | CRT_AOV_NORMAL | CRT_AOV_ID | CRT_AOV_ALBEDO |
                                     CRT_AOV_SAMPLES | CRT_AOV_ERROR | CRT_AOV_PART;
  if ((bits & ~all_bits) != 0) reject("options->aovs", "has a bit that no CRT_AOV_* is");
  return {.depth = (bits & CRT_AOV_DEPTH) != 0,
          .normal = (bits & CRT_AOV_NORMAL) != 0,
          .id = (bits & CRT_AOV_ID) != 0,
          .part = (bits & CRT_AOV_PART) != 0,
          .albedo = (bits & CRT_AOV_ALBEDO) != 0,
          .samples = (bits & CRT_AOV_SAMPLES) != 0,
          .error = (bits & CRT_AOV_ERROR) != 0};
}

}  // namespace

std::function<bool(double)> to_progress(crt_progress_fn call, void* user,
                                        const CancelValue& cancel_value) {
  if (call == nullptr) return {};
  return [call, user, cancel_value](double fraction) {
    const int answer = call(fraction, user);
    if (answer != 0) *cancel_value = answer;
    return answer == 0;
  };
}

RenderOptions to_options(const crt_render_options* options, const CancelValue& cancel_value) {
  const auto given = taken_or_default(options, "options");
  RenderOptions result;
  result.threads = given.threads;
  if (given.region_x != 0 || given.region_y != 0 || given.region_width != 0 ||
      given.region_height != 0) {
    result.region = Region{given.region_x, given.region_y, given.region_width, given.region_height};
  }
  if (given.seed != 0) result.seed = given.seed;
  result.passes = given.passes;
  result.aovs = to_aovs(given.aovs);
  result.max_ray_steps = given.max_ray_steps;
  if (given.checkpoint != nullptr) result.checkpoint = given.checkpoint;
  result.progress = to_progress(given.progress, given.progress_user, cancel_value);
  if (given.log != nullptr) {
    result.log = [call = given.log, user = given.log_user](LogLevel level, std::string_view line) {
      call(level == LogLevel::warning ? CRT_LOG_WARNING : CRT_LOG_INFO, std::string(line).c_str(),
           user);
    };
  }
  return result;
}

}  // namespace crt::capi

using namespace crt::capi;

crt_status crt_render(crt_prepared* prepared, const crt_render_options* options, crt_image** out) {
  return guarded_with_cancel([&](const CancelValue& cancel_value) {
    require(prepared, "prepared");
    require(out, "out");
    *out = new crt_image(crt::render(prepared->value, to_options(options, cancel_value)));
  });
}

crt_status crt_render_start(crt_prepared* prepared, const crt_render_options* options,
                            crt_job** out) {
  return guarded([&] {
    require(prepared, "prepared");
    require(out, "out");
    const CancelValue cancel_value = new_cancel_value();
    *out = new crt_job(crt::RenderJob(prepared->value, to_options(options, cancel_value)),
                       cancel_value);
  });
}

crt_status crt_job_progress(crt_job* job, double* fraction) {
  return guarded([&] {
    require(job, "job");
    require(fraction, "fraction");
    *fraction = job->value.progress();
  });
}

int32_t crt_job_is_finished(const crt_job* job) {
  return job != nullptr && job->value.finished() ? 1 : 0;
}

crt_status crt_job_snapshot(crt_job* job, crt_image** out) {
  return guarded([&] {
    require(job, "job");
    require(out, "out");
    *out = new crt_image(job->value.snapshot());
  });
}

crt_status crt_job_cancel(crt_job* job) {
  return guarded([&] {
    require(job, "job");
    job->value.cancel();
  });
}

crt_status crt_job_wait(crt_job* job, crt_image** out) {
  const crt_status there = guarded([&] { require(job, "job"); });
  if (there != CRT_OK) return there;
  return guarded(*job->cancel_value, [&] {
    crt::Image image = job->value.wait();
    if (out != nullptr) *out = new crt_image(std::move(image));
  });
}
