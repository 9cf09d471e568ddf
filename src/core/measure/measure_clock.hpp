// What ends a search: its time, or whoever asked for it.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>

#include "core/tasks/workers.hpp"
#include "crt/measure.hpp"

namespace crt::core {

/// Throws Error (invalid_argument) for options that are out of range.
void validate(const MeasureOptions& options);

class MeasureClock {
 public:
  explicit MeasureClock(const MeasureOptions& options)
      : stop_(options.go_on, "measuring"),
        work_(options.work),
        seconds_(options.seconds),
        threads_(options.threads) {}

  Workers workers() { return {threads_, &stop_}; }
  /// Reports looks at leaves of solids. What whoever asked throws comes out.
  void count(std::uint64_t looks) {
    if (work_) work_(looks);
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
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double seconds_;
  int threads_;
};

}  // namespace crt::core
