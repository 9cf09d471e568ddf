#include "core/render/progress.hpp"

#include "core/math/float_environment.hpp"
#include "crt/error.hpp"

namespace crt::core {

namespace {

/// A share is reported if it has grown by this.
constexpr double news = 0.01;
/// Without news the callback is called this often, for callers who want to cancel.
constexpr std::chrono::milliseconds longest_silence{50};

[[noreturn]] void throw_cancelled() {
  throw Error(ErrorCode::cancelled, "the render was cancelled");
}

}  // namespace

Progress::Progress(const std::function<bool(double)>& callback) : callback_(callback) {}

void Progress::begin() {
  if (stopped_) throw_cancelled();
  last_call_ = Clock::now();
  if (callback_) call(0);
}

void Progress::begin_part(std::size_t task_count, double share_after) {
  share_before_ = share_;
  share_of_part_ = share_after - share_before_;
  task_count_ = static_cast<double>(task_count);
  tasks_done_ = 0;
}

void Progress::finish() {
  share_ = 1;
  if (callback_) call(1);
}

void Progress::raise_share(double share) {
  double before = share_;
  while (before < share && !share_.compare_exchange_weak(before, share)) {
  }
}

void Progress::task_done() {
  const auto done = static_cast<double>(++tasks_done_);
  raise_share(share_before_ + share_of_part_ * (done / task_count_));
  if (stopped_) throw_cancelled();
  if (chore_) chore_();
  if (callback_) report(false);
}

void Progress::poll() {
  if (stopped_) throw_cancelled();
  if (chore_) chore_();
  if (callback_) report(true);
}

void Progress::poll_in_ray() {
  if (stopped_) throw_cancelled();
  if (callback_) report(true);
}

void Progress::report(bool even_without_news) {
  if (reporting_.test_and_set(std::memory_order_acquire)) return;
  struct Release {
    std::atomic_flag& flag;
    ~Release() { flag.clear(std::memory_order_release); }
  } release{reporting_};

  const double share = this->share();
  const bool is_news = share >= last_share_ + news && share < 1;
  const bool is_silent = even_without_news && Clock::now() - last_call_ >= longest_silence;
  if (!is_news && !is_silent) return;
  call(share);
  last_share_ = share;
  last_call_ = Clock::now();
}

void Progress::call(double share) {
  const bool go_on = [&] {
    const HostFloatEnvironment host;
    return callback_(share);
  }();
  if (go_on) return;
  stopped_ = true;
  throw_cancelled();
}

}  // namespace crt::core
