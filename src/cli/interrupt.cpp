#include "cli/interrupt.hpp"

#include <atomic>
#include <csignal>
#include <cstdlib>

#include "cli/options.hpp"

namespace crt::cli {

namespace {

// Signal handlers can reach nothing but globals; these belong to the process, as signals do.
std::atomic<bool> signal_came = false;
static_assert(std::atomic<bool>::is_always_lock_free);

constexpr int signals[] = {SIGINT, SIGTERM};

extern "C" void note_signal(int) {
  if (signal_came.exchange(true)) std::_Exit(static_cast<int>(ExitCode::interrupted));
}

extern "C" void end_at_once(int) {
  std::_Exit(static_cast<int>(ExitCode::interrupted));
}

void handle_with(void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : signals) sigaction(signal, &action, nullptr);
}

}  // namespace

InterruptScope::InterruptScope() {
  signal_came = false;
  handle_with(note_signal);
}

InterruptScope::~InterruptScope() {
  handle_with(end_at_once);
}

bool InterruptScope::interrupted() const {
  return signal_came;
}

}  // namespace crt::cli
