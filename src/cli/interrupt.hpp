// This file handles SIGINT and SIGTERM. While a picture is rendered the first one asks for an
// orderly end. The second, or one at any other time, ends the process at once. That leaves no
// half-written file, as files are written under another name and then renamed.
#pragma once

namespace crt::cli {

/// While an InterruptScope lives, the first signal is only noted. There is at most one at a time.
class InterruptScope {
 public:
  InterruptScope();
  ~InterruptScope();
  InterruptScope(const InterruptScope&) = delete;
  InterruptScope& operator=(const InterruptScope&) = delete;

  /// Says whether a signal has come since this scope was opened.
  bool interrupted() const;
};

}  // namespace crt::cli
