#include "cli/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "cli/console.hpp"

namespace crt::cli {

namespace {

using std::chrono::duration;
using std::chrono::milliseconds;

constexpr milliseconds redraw_interval{100};
/// Lines are not for what is done soon, and keep a distance.
constexpr milliseconds line_interval{2000};
/// Before this share is done, an estimate of the time left is worth nothing.
constexpr double least_share_to_estimate = 0.02;
constexpr std::string_view erase_line = "\r\033[K";
/// These columns of a terminal are not for the bar: the name's ends, the percentage, the time left.
constexpr int width_besides_bar = 32;
constexpr int widest_bar = 40;

int terminal_width() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  constexpr int usual_width = 80;
  return known ? size.ws_col : usual_width;
}

std::string clock_text(double seconds) {
  // A longer time is of no use to anyone. This one fits a whole number.
  constexpr double a_thousand_hours = 3.6e6;
  const int whole = static_cast<int>(std::ceil(std::clamp(seconds, 0.0, a_thousand_hours)));
  const int hours = whole / 3600;
  if (hours > 0) return fmt::format("{}:{:02}:{:02}", hours, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

ProgressStyle progress_style(const CommonRequest& request) {
  if (request.quiet || request.diagnostics != DiagnosticsFormat::text) return ProgressStyle::none;
  if (isatty(STDERR_FILENO) == 0) return ProgressStyle::lines;
  const char* terminal = std::getenv("TERM");
  const bool can_redraw = terminal != nullptr && std::string_view(terminal) != "dumb";
  return can_redraw ? ProgressStyle::bar : ProgressStyle::lines;
}

Progress::Progress(std::string name, ProgressStyle style) : name_(std::move(name)), style_(style) {}

Progress::~Progress() {
  if (!drawn_) return;
  write_text(stderr, erase_line);
}

void Progress::update(double share) {
  const Clock::time_point now = Clock::now();
  if (style_ == ProgressStyle::bar) draw_bar(share, now);
  if (style_ == ProgressStyle::lines) print_line(share, now);
}

void Progress::draw_bar(double share, Clock::time_point now) {
  if (drawn_ && now - last_drawn_ < redraw_interval) return;
  last_drawn_ = now;
  drawn_ = true;
  const int columns = terminal_width() - width_besides_bar - static_cast<int>(name_.size());
  const int width = std::clamp(columns, 0, widest_bar);
  const int filled = static_cast<int>(share * width);
  const std::string bar =
      width == 0 ? "" : fmt::format(" [{:#<{}}{:.<{}}]", "", filled, "", width - filled);
  write_text(stderr, fmt::format("{}{}{} {:3.0f} %{}", erase_line, name_, bar,
                                 std::floor(100 * share), time_left(share, now)));
}

void Progress::print_line(double share, Clock::time_point now) {
  const int tenth = static_cast<int>(10 * share);
  if (tenth <= last_tenth_ || now - last_line_ < line_interval) return;
  last_tenth_ = tenth;
  last_line_ = now;
  write_text(stderr, fmt::format("{}: {} %{}\n", name_, 10 * tenth, time_left(share, now)));
}

std::string Progress::time_left(double share, Clock::time_point now) const {
  if (share < least_share_to_estimate || share >= 1) return "";
  const double elapsed = duration<double>(now - start_).count();
  return fmt::format(", {} left", clock_text(elapsed * (1 - share) / share));
}

}  // namespace crt::cli
