// SIGINT and SIGTERM. While a picture is rendered the first one asks for an orderly end; the
// second, or one at any other time, ends the process at once (no half-written file can be left:
// files are written under another name and then renamed).
#pragma once

namespace crt::cli {

/// While one lives, the first signal is only noted. At most one at a time.
class InterruptScope {
 public:
  InterruptScope();
  ~InterruptScope();
  InterruptScope(const InterruptScope&) = delete;
  InterruptScope& operator=(const InterruptScope&) = delete;

  /// Whether a signal has come since this scope was opened.
  bool interrupted() const;
};

}  // namespace crt::cli
