#include "studio/newest_task.hpp"

#include <utility>

namespace crt::studio {

NewestTask::~NewestTask() {
  {
    const std::lock_guard lock(mutex_);
    is_ended_ = true;
    ++newest_;
  }
  changed_.notify_all();
  thread_.join();
}

void NewestTask::start(Task task) {
  Task replaced;
  {
    const std::lock_guard lock(mutex_);
    ++newest_;
    replaced = std::exchange(waiting_, std::move(task));
  }
  changed_.notify_all();
  if (replaced) replaced([] { return false; });
}

void NewestTask::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return is_ended_ || waiting_; });
    if (is_ended_) return;
    const Task task = std::exchange(waiting_, {});
    running_ = newest_;
    lock.unlock();
    task([this] {
      const std::lock_guard guard(mutex_);
      return running_ == newest_;
    });
    lock.lock();
  }
}

}  // namespace crt::studio
