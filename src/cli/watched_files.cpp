#include "cli/watched_files.hpp"

#include <sys/stat.h>

#include <algorithm>

namespace crt::cli {

void WatchedFiles::add(const std::filesystem::path& file) {
  states_.emplace(file, state_of(file));
}

bool WatchedFiles::have_changed() const {
  return std::any_of(states_.begin(), states_.end(),
                     [](const auto& entry) { return state_of(entry.first) != entry.second; });
}

WatchedFiles::State WatchedFiles::state_of(const std::filesystem::path& file) {
  struct stat found = {};
  if (stat(file.c_str(), &found) != 0) return {};
  return {.exists = true,
          .number = found.st_ino,
          .size = found.st_size,
          .seconds = found.st_mtim.tv_sec,
          .nanoseconds = found.st_mtim.tv_nsec};
}

}  // namespace crt::cli
