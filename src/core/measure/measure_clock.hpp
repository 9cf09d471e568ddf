// What ends a search: its time, or whoever asked for it.
#pragma once

#include <chrono>

#include "core/tasks/workers.hpp"
#include "crt/measure.hpp"

namespace crt::core {

/// Throws Error (invalid_argument) for options that are out of range.
void validate(const MeasureOptions& options);

class MeasureClock {
 public:
  explicit MeasureClock(const MeasureOptions& options)
      : stop_(options.go_on, "measuring"), seconds_(options.seconds), threads_(options.threads) {}

  Workers workers() { return {threads_, &stop_}; }
  /// Asks now and then whether to continue, and returns whether the time is over.
  bool is_over() {
    stop_.poll();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count() >
           seconds_;
  }

 private:
  StopCheck stop_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double seconds_;
  int threads_;
};

}  // namespace crt::core
