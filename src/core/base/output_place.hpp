// Where what is written to a path goes: links are followed, and what is no regular file is told
// apart.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <string>

namespace crt::core {

struct OutputPlace {
  enum class Kind {
    new_file,      ///< there is nothing yet
    regular_file,  ///< to be replaced
    descriptor,    ///< one that this process has open: /dev/stdout, /dev/fd/3
    special,       ///< a device, a pipe: to be written to as it is
  };
  Kind kind = Kind::new_file;
  std::filesystem::path
      path;  ///< whose last part is no link; of a descriptor the path as it was given
  int descriptor = -1;
  struct stat status {};  ///< of a regular file
};

/// Throws Error (io): a folder, none around it, links that lead in a circle.
OutputPlace output_place(const std::filesystem::path& path);

/// The Error (io) for a file that cannot be written: "cannot write 'x': reason".
[[noreturn]] void fail_to_write(const std::filesystem::path& path, const std::string& reason);

/// What the system says to a value of errno.
std::string system_message(int error);

}  // namespace crt::core
