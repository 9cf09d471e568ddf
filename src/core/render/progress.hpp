// A Progress reports to the caller how far a render is, and tells the threads when to stop.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <utility>

namespace crt::core {

/// A Progress is shared by all threads of one render. The callback is called from one thread at a
/// time with shares that never decrease, 0 first and 1 last.
class Progress {
 public:
  /// An empty callback never stops anything.
  explicit Progress(const std::function<bool(double)>& callback);

  /// These are to be called before the first and after the last task. Both throw Error (cancelled)
  /// if the callback says no.
  void begin();
  void finish();

  /// Begins some tasks, with all before them done. It takes how many there are, and what share of
  /// everything is done after them.
  void begin_part(std::size_t task_count, double share_after);

  /// Has each thread run `chore` from time to time, between rays. An empty one stops that. It must
  /// be called while no task runs.
  void do_between_rays(std::function<void()> chore) { chore_ = std::move(chore); }

  /// Counts a task as done. Throws Error (cancelled) if the callback says or has said no.
  void task_done();

  /// Looks whether to stop, and is to be called often during a long task. Throws like task_done().
  void poll();

  /// Looks whether to stop, and is to be called often within a long ray. Throws like task_done().
  void poll_in_ray();

  /// Makes every thread's next call throw, as the caller has cancelled, or something has gone
  /// wrong.
  void stop() { stopped_ = true; }

  /// Returns how much is done: from 0 to 1, never decreasing.
  double share() const { return share_; }

 private:
  using Clock = std::chrono::steady_clock;

  /// Calls the callback, unless another thread does or there is nothing new to report.
  void report(bool even_without_news);
  void call(double share);
  void raise_share(double share);

  std::function<bool(double)> callback_;
  std::function<void()> chore_;
  // These are of this part.
  double share_before_ = 0;
  double share_of_part_ = 0;
  double task_count_ = 0;
  std::atomic<std::size_t> tasks_done_ = 0;

  std::atomic<double> share_ = 0;
  std::atomic<bool> stopped_ = false;
  /// This is no mutex, as a callback may run other tasks of this very render on its thread.
  std::atomic_flag reporting_;
  /// These are what was reported last, and when. They are guarded by reporting_.
  double last_share_ = 0;
  Clock::time_point last_call_;
};

}  // namespace crt::core
