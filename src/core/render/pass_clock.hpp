// A PassClock decides whether there is time for another pass. It is the one place where a clock may
// change a picture.
#pragma once

#include <cstdint>
#include <functional>

namespace crt::core {

class PassClock {
 public:
  /// Returns seconds since anything.
  using Seconds = std::function<double()>;

  /// Starts the clock. A budget of 0 is none.
  PassClock(double budget, Seconds seconds)
      : budget_(budget), seconds_(std::move(seconds)), start_(seconds_()), last_(start_) {}

  bool has_budget() const { return budget_ > 0; }

  /// Measures a pass that has ended, with the number of samples that it traced.
  void pass_done(std::uint64_t samples) {
    const double now = seconds_();
    per_sample_ = samples > 0 ? (now - last_) / static_cast<double>(samples) : 0;
    last_ = now;
  }

  /// Returns whether the end with a pass of so many samples is nearer to the budget than without.
  bool has_time_for(std::uint64_t samples) const {
    if (!has_budget()) return true;
    return used() + 0.5 * per_sample_ * static_cast<double>(samples) <= budget_;
  }

  /// Returns the share of the budget that is used after such a pass, at most 1.
  double share_after(std::uint64_t samples) const {
    const double share = (used() + per_sample_ * static_cast<double>(samples)) / budget_;
    return share < 1 ? share : 1;
  }

 private:
  /// Between passes nothing but the last decision takes time, which counts for the next pass.
  double used() const { return last_ - start_; }

  double budget_;
  Seconds seconds_;
  double start_;
  double last_;
  double per_sample_ = 0;
};

}  // namespace crt::core
