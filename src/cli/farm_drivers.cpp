#include "cli/farm_drivers.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <crt/error.hpp>
#include <csignal>
#include <set>
#include <string>
#include <thread>

#include "cli/process.hpp"
#include "cli/progress.hpp"

namespace crt::cli {

namespace {

namespace fs = std::filesystem;

/// Processes are the workers on this machine. Those that are left end with it.
class Processes {
 public:
  ~Processes() {
    for (const pid_t process : running_) kill(process, SIGTERM);
    for (const pid_t process : running_) has_succeeded(process);
  }

  std::size_t count() const { return running_.size(); }
  void start(const std::vector<std::string>& words) { running_.insert(start_program(words)); }

  /// Takes away those that have ended, and returns how many.
  std::size_t reap() {
    return std::erase_if(running_, [](pid_t process) {
      int status = 0;
      return waitpid(process, &status, WNOHANG) == process;
    });
  }

 private:
  std::set<pid_t> running_;
};

}  // namespace

void drive_local(const Driving& driving) {
  const FarmRequest& request = driving.request;
  const std::size_t most = request.processes > 0
                               ? static_cast<std::size_t>(request.processes)
                               : std::max(1u, std::thread::hardware_concurrency());
  Progress progress(request.target.string(), progress_style(request));
  Processes processes;
  std::size_t next = 0;
  std::size_t ended = 0;
  while (ended < driving.tasks.size()) {
    if (driving.interrupt.interrupted()) throw Error(ErrorCode::cancelled, "interrupted");
    while (processes.count() < most && next < driving.tasks.size()) {
      processes.start({this_program(), "farm", "work", request.target.string(), "--task",
                       std::to_string(driving.tasks[next++]), "--threads", "1", "--quiet"});
    }
    const std::size_t now = processes.reap();
    ended += now;
    progress.update(static_cast<double>(ended) / static_cast<double>(driving.tasks.size()));
    constexpr std::chrono::milliseconds interval(10);
    if (now == 0) std::this_thread::sleep_for(interval);
  }
}

void drive_parallel(const Driving& driving) {
  const FarmRequest& request = driving.request;
  std::vector<std::string> words = {
      "parallel", "--will-cite", "--retries",
      "3",        "--joblog",    (fs::absolute(request.target) / "log/parallel.txt").string()};
  if (!request.hosts.empty()) words.insert(words.end(), {"--sshlogin", request.hosts});
  if (request.processes > 0)
    words.insert(words.end(), {"--jobs", std::to_string(request.processes)});
  // The path goes through a shell there, which --quote keeps from changing it.
  words.insert(words.end(),
               {"--quote", this_program(), "farm", "work", fs::absolute(request.target).string(),
                "--threads", "1", "--quiet", "--task", "{}", ":::"});
  for (const int task : driving.tasks) words.push_back(std::to_string(task));
  has_succeeded(start_program(words));  // what has failed is seen in the parts
}

}  // namespace crt::cli
