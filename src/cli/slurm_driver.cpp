// Slurm does the tasks of a job as an array job, whose script this file writes.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <crt/farm.hpp>
#include <crt/file.hpp>
#include <sstream>
#include <thread>

#include "cli/farm_drivers.hpp"
#include "cli/process.hpp"
#include "cli/progress.hpp"

namespace crt::cli {

namespace {

namespace fs = std::filesystem;

/// Returns how many tasks an array job may have. Slurm takes this number for the first too many.
int max_in_array() {
  constexpr int usual = 1000;
  const Answer answer = ask_program({"scontrol", "show", "config"});
  std::istringstream lines(answer.text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name;
    std::string equals;
    int value = 0;
    if (words >> name >> equals >> value && name == "MaxArraySize") return std::max(1, value - 1);
  }
  return usual;
}

class Slurm {
 public:
  explicit Slurm(const Driving& driving)
      : driving_(driving), job_(fs::absolute(driving.request.target).lexically_normal()) {}

  void drive() {
    write_scripts();
    std::string id = submit_array();
    if (driving_.request.no_wait) {
      submit_merge(id);
      return;
    }
    try {
      follow(id);
    } catch (...) {
      ask_program({"scancel", id});
      throw;
    }
  }

 private:
  /// Writes the script of the array's elements. Each takes every so many-th line of the list.
  void write_scripts() {
    const auto count = static_cast<int>(driving_.tasks.size());
    elements_ = std::min(count, max_in_array());
    write_file(job_ / "log/tasks.txt", fmt::format("{}\n", fmt::join(driving_.tasks, "\n")));
    const std::string work =
        fmt::format("{} farm work {} --quiet --threads \"${{SLURM_CPUS_PER_TASK:-1}}\"",
                    shell_quoted(this_program()), shell_quoted(job_.string()));
    write_file(job_ / "log/work.sh",
               fmt::format("#!/bin/sh\n"
                           "# crt farm submit --slurm wrote this script: it works on tasks of a "
                           "job.\n"
                           "failed=0\n"
                           "for task in $(awk -v n=\"$SLURM_ARRAY_TASK_ID\" "
                           "'(NR - 1) % {} == n' {}); do\n"
                           "  {} --task \"$task\" || failed=1\n"
                           "done\n"
                           "exit $failed\n",
                           elements_, shell_quoted((job_ / "log/tasks.txt").string()), work));
    const fs::path& output = driving_.request.output;
    write_file(
        job_ / "log/merge.sh",
        fmt::format("#!/bin/sh\n"
                    "# crt farm submit --slurm wrote this script: it merges the pictures of "
                    "a job.\n"
                    "exec {} farm merge {}{}\n",
                    shell_quoted(this_program()), shell_quoted(job_.string()),
                    output.empty() ? "" : " -o " + shell_quoted(fs::absolute(output).string())));
  }

  /// Submits a script, and returns the number of the job.
  std::string submit(const std::vector<std::string>& options, const char* script) const {
    std::vector<std::string> words = {"sbatch", "--parsable", "--chdir=" + job_.string(),
                                      "--job-name=crt-farm"};
    words.insert(words.end(), options.begin(), options.end());
    const std::vector<std::string>& more = driving_.request.slurm_options;
    words.insert(words.end(), more.begin(), more.end());
    words.push_back((job_ / "log" / script).string());
    const Answer answer = ask_program(words);
    std::string id = answer.text.substr(0, answer.text.find_first_of(";\n"));
    if (!answer.succeeded || id.empty())
      throw Error(ErrorCode::io, "Slurm did not take the job; sbatch says why");
    return id;
  }

  std::string submit_array() const {
    return submit({"--requeue", fmt::format("--array=0-{}", elements_ - 1),
                   "--output=" + (job_ / "log/slurm-%A-%a.out").string()},
                  "work.sh");
  }

  void submit_merge(const std::string& array) const {
    submit({"--dependency=afterany:" + array, "--output=" + (job_ / "log/merge.out").string()},
           "merge.sh");
  }

  /// Waits for the end of the array.
  void follow(const std::string& id) const {
    const FarmRequest& request = driving_.request;
    Progress progress(request.target.string(), progress_style(request));
    constexpr std::chrono::milliseconds interval(500);
    int unanswered = 0;
    constexpr int max_unanswered = 120;
    while (true) {
      if (driving_.interrupt.interrupted()) throw Error(ErrorCode::cancelled, "interrupted");
      const Answer answer = ask_program({"squeue", "--noheader", "--jobs=" + id});
      // Slurm forgets a job some minutes after its end, and then says that there is none.
      unanswered = answer.succeeded ? 0 : unanswered + 1;
      if (answer.succeeded && answer.text.empty()) return;
      const bool is_forgotten = !answer.succeeded && ask_program({"scontrol", "ping"}).succeeded;
      if (is_forgotten) return;
      if (unanswered > max_unanswered)
        throw Error(ErrorCode::io, "Slurm does not answer; the job may still run");
      progress.update(farm_status(request.target).share());
      std::this_thread::sleep_for(interval);
    }
  }

  const Driving& driving_;
  fs::path job_;
  int elements_ = 1;
};

}  // namespace

void drive_slurm(const Driving& driving) {
  Slurm(driving).drive();
}

}  // namespace crt::cli
