#include "core/tasks/workers.hpp"

#include <string>

#include "core/math/float_environment.hpp"
#include "crt/error.hpp"

namespace crt::core {

void StopCheck::poll() {
  if (!go_on_) return;
  if (!stopped_) ask();
  if (stopped_) throw Error(ErrorCode::cancelled, std::string(what_) + " was cancelled");
}

void StopCheck::ask() {
  constexpr std::chrono::milliseconds longest_silence{20};
  if (asking_.test_and_set(std::memory_order_acquire)) return;
  struct Release {
    std::atomic_flag& flag;
    ~Release() { flag.clear(std::memory_order_release); }
  } release{asking_};
  const Clock::time_point now = Clock::now();
  if (now - last_ < longest_silence) return;
  last_ = now;
  const HostFloatEnvironment host;
  if (!go_on_()) stopped_ = true;
}

}  // namespace crt::core
