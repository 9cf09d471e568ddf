// Workers are the threads that do some work, with what may stop it.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <utility>

namespace crt::core {

/// A StopCheck asks the caller of a long piece of work whether to continue. Any thread may ask.
class StopCheck {
 public:
  /// `go_on` is called from one thread at a time. An empty one never stops anything. `what` names
  /// the work in the error.
  StopCheck(std::function<bool()> go_on, const char* what)
      : go_on_(std::move(go_on)), what_(what) {}

  /// Throws Error (cancelled) if the answer is or was no. It is to be called often, and asks only
  /// from time to time.
  void poll();

 private:
  using Clock = std::chrono::steady_clock;

  void ask();

  std::function<bool()> go_on_;
  const char* what_;
  std::atomic<bool> stopped_ = false;
  std::atomic_flag asking_;
  Clock::time_point last_;  ///< guarded by asking_
};

/// Says how many threads may work, as run_tasks() takes it, and what may stop them.
struct Workers {
  int threads = 0;
  StopCheck* stop = nullptr;

  // NOLINTNEXTLINE(google-explicit-constructor): a number of threads is enough to say
  Workers(int max_threads = 0, StopCheck* stop_check = nullptr)
      : threads(max_threads), stop(stop_check) {}

  void poll() const {
    if (stop != nullptr) stop->poll();
  }
  /// Polls if item `index` of many small items is one of every 4096.
  void poll_at(std::size_t index) const {
    constexpr std::size_t items_per_poll = 4096;
    if (index % items_per_poll == 0) poll();
  }
};

}  // namespace crt::core
