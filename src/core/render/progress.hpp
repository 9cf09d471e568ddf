// Tells the caller how far a render is, and the threads when to stop.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <utility>

namespace crt::core {

/// Shared by all threads of one render. The callback is called from one thread at a time with
/// shares that never fall, 0 first and 1 last.
class Progress {
 public:
  /// An empty callback is one that never stops anything.
  explicit Progress(const std::function<bool(double)>& callback);

  /// Before the first and after the last task; both throw Error (cancelled) if the callback says
  /// no.
  void begin();
  void finish();

  /// Before the first of some tasks, with all before them done: how many come, and what share of
  /// everything is done after them.
  void begin_part(std::size_t task_count, double share_after);

  /// Has each thread do this now and then, between rays, from now on; nothing if it is empty. While
  /// no task runs.
  void do_between_rays(std::function<void()> chore) { chore_ = std::move(chore); }

  /// After each task. Throws Error (cancelled) if the callback says no, now or before.
  void task_done();

  /// To be called often during a long task; throws like task_done().
  void poll();

  /// The same from within a ray.
  void poll_in_ray();

  /// Makes every thread's next call throw: the caller has cancelled, or something has gone wrong.
  void stop() { stopped_ = true; }

  /// How much is done: from 0 to 1, never falling.
  double share() const { return share_; }

 private:
  using Clock = std::chrono::steady_clock;

  /// Calls the callback, unless another thread is at it or there is nothing new to say.
  void report(bool even_without_news);
  void call(double share);
  void raise_share(double share);

  std::function<bool(double)> callback_;
  std::function<void()> chore_;
  // Of this part.
  double share_before_ = 0;
  double share_of_part_ = 0;
  double task_count_ = 0;
  std::atomic<std::size_t> tasks_done_ = 0;

  std::atomic<double> share_ = 0;
  std::atomic<bool> stopped_ = false;
  /// Not a mutex: a callback may run other tasks of this very render on its thread.
  std::atomic_flag reporting_;
  /// What was said last, and when; guarded by reporting_.
  double last_share_ = 0;
  Clock::time_point last_call_;
};

}  // namespace crt::core
