// Finds out what a path leads to: links are followed, and descriptors, devices and pipes are
// distinguished from regular files.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <string>

namespace crt::core {

struct OutputPlace {
  enum class Kind {
    new_file,      ///< there is nothing yet
    regular_file,  ///< to be replaced
    descriptor,    ///< one that this process has open, such as /dev/stdout or /dev/fd/3
    special,       ///< a device or a pipe, to be written to as it is
  };
  Kind kind = Kind::new_file;
  std::filesystem::path
      path;  ///< the path with all links followed, or as it was given for a descriptor
  int descriptor = -1;
  struct stat status {};  ///< of a regular file only
};

/// Finds the place that a path leads to. Throws Error (io) if it is a folder, if there is no folder
/// to hold it, or if its links lead in a circle.
OutputPlace output_place(const std::filesystem::path& path);

/// Throws the Error (io) for a file that cannot be written: "cannot write 'x': reason".
[[noreturn]] void fail_to_write(const std::filesystem::path& path, const std::string& reason);

/// Returns the system's message for a value of errno.
std::string system_message(int error);

}  // namespace crt::core
