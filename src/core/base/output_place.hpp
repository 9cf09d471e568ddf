// Finds out what a path leads to: links are followed, and descriptors, devices and pipes are
// distinguished from regular files.
#pragma once

#include <fcntl.h>
#include <sys/stat.h>

#include <filesystem>
#include <optional>
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
  /// Is of the file whose owner and permissions the new one gets.
  std::optional<struct stat> model{};
  int folder = AT_FDCWD;  ///< a descriptor of the folder that the path begins in

  /// Says whether the path is a mere name in a folder, and no link may be followed.
  bool is_in_folder() const { return folder != AT_FDCWD; }
};

/// Finds the place that a path leads to. Throws Error (io) if it is a folder, if there is no folder
/// to hold it, or if its links lead in a circle.
OutputPlace output_place(const std::filesystem::path& path);

/// Finds the place of a name in an open folder. `like` is empty or the name of a file there. Throws
/// Error (io) if the name is that of no regular file, or no name.
OutputPlace output_place_in(int folder, const std::string& name, const std::string& like);

/// Throws the Error (io) for a file that cannot be written: "cannot write 'x': reason".
[[noreturn]] void fail_to_write(const std::filesystem::path& path, const std::string& reason);

/// Returns the system's message for a value of errno.
std::string system_message(int error);

}  // namespace crt::core
