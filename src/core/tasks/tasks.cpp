#include "core/tasks/tasks.hpp"

#include <algorithm>

#include "crt/error.hpp"

#ifdef CRT_TASKS_THREADS
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>
#else
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>
#endif

namespace crt::core {

namespace {

#ifdef CRT_TASKS_THREADS
int available_threads() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// This is more than any machine has, and few enough to ask for.
int max_threads() {
  return 1024;
}
#else
int available_threads() {
  return tbb::this_task_arena::max_concurrency();
}

/// TBB starts no more threads in this process, and warns on the terminal if it is asked for more.
int max_threads() {
  return static_cast<int>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}
#endif

void run_in_order(std::size_t count, const std::function<void(std::size_t)>& task) {
  for (std::size_t i = 0; i < count; ++i) task(i);
}

#ifdef CRT_TASKS_THREADS

/// A SharedQueue takes tasks one after the other, on every thread that calls work().
class SharedQueue {
 public:
  SharedQueue(std::size_t count, const std::function<void(std::size_t)>& task)
      : count_(count), task_(task) {}

  void work() {
    try {
      for (std::size_t i = next_++; i < count_ && !failed_; i = next_++) task_(i);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failed_.exchange(true)) exception_ = std::current_exception();
    }
  }

  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  std::size_t count_;
  const std::function<void(std::size_t)>& task_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> failed_ = false;
  std::mutex mutex_;
  std::exception_ptr exception_;
};

void run_in_parallel(std::size_t count, int threads, const std::function<void(std::size_t)>& task) {
  SharedQueue queue(count, task);
  const std::size_t others =
      std::min(count, static_cast<std::size_t>(allowed_threads(threads))) - 1;
  {
    std::vector<std::jthread> helpers;
    helpers.reserve(others);
    try {
      while (helpers.size() < others) helpers.emplace_back([&queue] { queue.work(); });
    } catch (const std::system_error&) {
      // The system grants no more threads. Those there are do the work.
    }
    queue.work();
  }
  queue.rethrow();
}

#else

void run_in_this_arena(std::size_t count, const std::function<void(std::size_t)>& task) {
  // The context is isolated: a host that cancels a task group of its own must not cut a picture
  // short.
  tbb::task_group_context context(tbb::task_group_context::isolated);
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) task(i);
      },
      context);
}

void run_in_parallel(std::size_t count, int threads, const std::function<void(std::size_t)>& task) {
  if (threads != 0) {
    tbb::task_arena(allowed_threads(threads)).execute([&] { run_in_this_arena(count, task); });
  } else {
    // This thread is isolated, so that it does not take up foreign work while it waits.
    tbb::this_task_arena::isolate([&] { run_in_this_arena(count, task); });
  }
}

#endif

}  // namespace

int allowed_threads(int threads) {
  if (threads < 0) {
    throw Error(ErrorCode::invalid_argument, "threads must not be negative; 0 means all",
                "threads");
  }
  return threads == 0 ? available_threads() : std::min(threads, max_threads());
}

void run_tasks(std::size_t count, int threads, const std::function<void(std::size_t)>& task) {
  if (allowed_threads(threads) == 1 || count <= 1) {
    run_in_order(count, task);
  } else {
    run_in_parallel(count, threads, task);
  }
}

}  // namespace crt::core
