// WatchedFiles notice that one of the files which a script read has changed.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <map>

namespace crt::cli {

/// Files are compared by what the system knows of them, a few times a second. That works on every
/// file system and for every way in which editors replace files.
class WatchedFiles {
 public:
  void clear() { states_.clear(); }

  /// Adds a file as it is now, which may be that it is not there. One that was added stays as it
  /// was then. It must be called before the file is read.
  void add(const std::filesystem::path& file);

  /// Says whether some file is not as it was when it was added.
  bool have_changed() const;

 private:
  struct State {
    bool exists = false;
    ino_t number = 0;
    off_t size = 0;
    std::int64_t seconds = 0;
    std::int64_t nanoseconds = 0;

    bool operator==(const State&) const = default;
  };

  static State state_of(const std::filesystem::path& file);

  std::map<std::filesystem::path, State> states_;
};

}  // namespace crt::cli
