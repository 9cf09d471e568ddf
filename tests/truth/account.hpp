// An Account has what a check of many random solids has found so far, and tells how far it is.
#pragma once

#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>

#include "crt/measure.hpp"

namespace crt::truth {

class Account {
 public:
  /// Progress goes to standard error, if it is asked for.
  Account(std::string name, std::uint64_t count, bool tells)
      : name_(std::move(name)), count_(count), tells_(tells) {}

  /// Begins with what has this number: what follows is about it.
  void begin(std::uint64_t number) {
    number_ = number;
    ++begun_;
    const auto now = std::chrono::steady_clock::now();
    if (!tells_ || now - told_ < std::chrono::seconds(10)) return;
    told_ = now;
    fmt::print(stderr, "[{} of {}] {}", begun_, count_, text());
  }
  /// Counts what was asked, or how an answer is.
  void count(const std::string& what, std::uint64_t times = 1) { counts_[what] += times; }
  void fail(const std::string& what) {
    ++failures_;
    constexpr int most_told = 100;
    if (failures_ > most_told) return;
    fmt::print("{} {}: {}\n", name_, number_, what);
    std::fflush(stdout);
  }
  void check(bool holds, const std::string& what) {
    if (!holds) fail(what);
  }

  int failures() const { return failures_; }
  std::string text() const {
    std::string line = fmt::format("{}: {} failures", name_, failures_);
    for (const auto& [what, times] : counts_) line += fmt::format(", {} {}", times, what);
    return line + "\n";
  }

 private:
  std::string name_;
  std::uint64_t count_;
  bool tells_;
  std::uint64_t number_ = 0;
  std::uint64_t begun_ = 0;
  int failures_ = 0;
  std::map<std::string, std::uint64_t> counts_;
  std::chrono::steady_clock::time_point told_ = std::chrono::steady_clock::now();
};

inline std::string text_of(const Interval& x) {
  return fmt::format("[{:.17g}, {:.17g}]", x.lower, x.upper);
}

/// Compares an answer with what is known up to an error.
inline void check_holds(Account& account, const std::string& what, const Interval& answer,
                        double truth, double error) {
  account.count(what);
  account.check(answer.lower <= truth + error && answer.upper >= truth - error,
                fmt::format("{} is {:.17g}, not in {}", what, truth, text_of(answer)));
}

/// Compares two answers of the same number.
inline void check_meet(Account& account, const std::string& what, const Interval& a,
                       const Interval& b, double error) {
  account.count(what);
  account.check(a.lower <= b.upper + error && b.lower <= a.upper + error,
                fmt::format("{} is in {} and in {}", what, text_of(a), text_of(b)));
}

}  // namespace crt::truth
