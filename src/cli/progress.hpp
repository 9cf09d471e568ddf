// Progress shows on standard error how far a render is: a bar with the time left on a terminal,
// else a line now and then: at a tenth, and two seconds after the last one or the begin.
#pragma once

#include <chrono>
#include <string>

#include "cli/options.hpp"

namespace crt::cli {

enum class ProgressStyle { none, lines, bar };

/// Returns none if the user wants quiet or JSON. Else it is a bar if standard error is a terminal
/// that can redraw a line, or lines.
ProgressStyle progress_style(const CommonRequest& request);

class Progress {
 public:
  /// `name` says what is being rendered.
  Progress(std::string name, ProgressStyle style);
  /// Takes the bar away.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Takes the share done, in [0, 1], and redraws if that looks different.
  void update(double share);

 private:
  using Clock = std::chrono::steady_clock;

  void draw_bar(double share, Clock::time_point now);
  void print_line(double share, Clock::time_point now);
  std::string time_left(double share, Clock::time_point now) const;

  std::string name_;
  ProgressStyle style_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_drawn_{};
  bool drawn_ = false;
  Clock::time_point last_line_ = start_;
  int last_tenth_ = 0;
};

}  // namespace crt::cli
