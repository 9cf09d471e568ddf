
#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>

#include "core/base/whole_file.hpp"
#include "farm/part.hpp"
#include "text/format.hpp"
#include "text/printable.hpp"

namespace crt::farm {

namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds silence_of_lost(60);

/// Returns the beginning of a task's log, or nothing.
std::string log_of(const Job& job, int task) {
  constexpr std::size_t most_bytes = 400;
  try {
    const std::vector<std::byte> log = core::read_file_start(job.log_file(task), most_bytes);
    return {reinterpret_cast<const char*>(log.data()), log.size()};
  } catch (const Error&) {
    return {};
  }
}

FarmTask status_of(const Job& job, int task) {
  FarmTask status{.estimated = job.manifest.tasks[static_cast<std::size_t>(task)].seconds};
  std::istringstream log(log_of(job, task));
  double share = 0;
  double seconds = 0;
  const bool has_log = static_cast<bool>(log >> status.worker >> share >> seconds);
  // Anybody may have written it.
  status.worker = has_log ? text::printable(status.worker) : "";
  if (has_part(job, task)) {
    status.state = FarmTaskState::done;
    status.share = 1;
    if (has_log && std::isfinite(seconds)) status.seconds = std::max(seconds, 0.0);
  } else if (has_log) {
    std::error_code failed;
    const auto written = fs::last_write_time(job.log_file(task), failed);
    const bool is_silent = failed || fs::file_time_type::clock::now() - written > silence_of_lost;
    status.state = is_silent ? FarmTaskState::lost : FarmTaskState::running;
    if (!is_silent && std::isfinite(share)) status.share = std::clamp(share, 0.0, 1.0);
  }
  return status;
}

}  // namespace

}  // namespace crt::farm

namespace crt {

int FarmStatus::count(FarmTaskState state) const {
  return static_cast<int>(std::count_if(tasks.begin(), tasks.end(),
                                        [&](const FarmTask& task) { return task.state == state; }));
}

double FarmStatus::share() const {
  double done = 0;
  double all = 0;
  for (const FarmTask& task : tasks) {
    done += task.share * task.estimated;
    all += task.estimated;
  }
  return all > 0 ? done / all : 0;
}

double FarmStatus::seconds_spent() const {
  double sum = 0;
  for (const FarmTask& task : tasks) sum += task.seconds;
  return sum;
}

double FarmStatus::seconds_left() const {
  double estimated_of_known = 0;
  double left = 0;
  for (const FarmTask& task : tasks) {
    if (task.seconds > 0) estimated_of_known += task.estimated;
    left += (1 - task.share) * task.estimated;
  }
  return estimated_of_known > 0 ? left * seconds_spent() / estimated_of_known : left;
}

FarmStatus farm_status(const std::filesystem::path& job) {
  const farm::Job opened = farm::open_job(job);
  FarmStatus status;
  const auto tasks = static_cast<int>(opened.manifest.tasks.size());
  for (int task = 0; task < tasks; ++task) status.tasks.push_back(farm::status_of(opened, task));
  return status;
}

}  // namespace crt
