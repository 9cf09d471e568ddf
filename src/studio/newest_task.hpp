// What takes long and is of use to the newest question alone is done in a thread of its own, and
// ends when something newer is asked.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace crt::studio {

class NewestTask {
 public:
  /// Says whether somebody still waits for a task. Any thread may ask.
  using GoesOn = std::function<bool()>;
  /// A Task runs in the thread, once, and must not throw. It is run, too, if something newer came
  /// before it could begin: then nobody waits for it from its start, and it only has to answer.
  using Task = std::function<void(const GoesOn& goes_on)>;

  NewestTask() : thread_([this] { work(); }) {}
  /// Ends the task that runs.
  ~NewestTask();
  NewestTask(const NewestTask&) = delete;
  NewestTask& operator=(const NewestTask&) = delete;

  /// Ends what is done, and does this.
  void start(Task task);

 private:
  void work();

  std::mutex mutex_;
  std::condition_variable changed_;
  Task waiting_;  ///< empty if none waits
  unsigned newest_ = 0;
  unsigned running_ = 0;
  bool is_ended_ = false;
  std::thread thread_;
};

}  // namespace crt::studio
