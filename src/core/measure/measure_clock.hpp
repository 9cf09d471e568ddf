// What ends a search: its time, or whoever asked for it.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <thread>

#include "core/tasks/workers.hpp"
#include "crt/measure.hpp"

namespace crt::core {

/// Throws Error (invalid_argument) for options that are out of range.
void validate(const MeasureOptions& options);

/// What is found of a cell takes as long as so many looks at a leaf.
inline constexpr std::uint64_t looks_of_cell = 4;

class MeasureClock {
 public:
  explicit MeasureClock(const MeasureOptions& options)
      : stop_(options.go_on, "measuring"),
        work_(options.work),
        seconds_(options.seconds),
        threads_(options.threads) {}

  Workers workers() { return {threads_, &stop_}; }
  /// Counts looks at leaves of solids. Any thread may call it. The one that made the clock reports
  /// those of all, and what whoever asked throws comes out.
  void count(std::uint64_t looks) {
    if (!work_) return;
    open_ += looks;
    if (std::this_thread::get_id() != reporter_) return;
    const std::uint64_t all = open_.exchange(0);
    if (all > 0) work_(all);
  }
  /// Asks now and then whether to continue, and returns whether the time is over.
  bool is_over() {
    stop_.poll();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count() >
           seconds_;
  }

 private:
  StopCheck stop_;
  std::function<void(std::uint64_t)> work_;
  std::atomic<std::uint64_t> open_ = 0;
  std::thread::id reporter_ = std::this_thread::get_id();
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double seconds_;
  int threads_;
};

}  // namespace crt::core
