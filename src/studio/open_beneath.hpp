// Files of the opened folder are opened from its descriptor, and never by a link. So nobody who may
// change the folder leads the studio out of it, not even between a look and a use.
#pragma once

#include <unistd.h>

#include <string>
#include <utility>

namespace crt::studio {

/// A FileHandle closes its descriptor at its end.
class FileHandle {
 public:
  FileHandle() = default;
  explicit FileHandle(int descriptor) : descriptor_(descriptor) {}
  FileHandle(FileHandle&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FileHandle& operator=(FileHandle&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~FileHandle() {
    if (is_open()) close(descriptor_);
  }

  bool is_open() const { return descriptor_ >= 0; }
  int get() const { return descriptor_; }
  /// Leaves the descriptor to whoever calls it.
  int release() { return std::exchange(descriptor_, -1); }

 private:
  int descriptor_ = -1;
};

/// Opens a path beneath a folder, which has no "..", with flags of open(). Where it leads over a
/// link or out of the folder, nothing is opened, and errno says so. The kernel sees to that where
/// it can (openat2 of Linux 5.6).
FileHandle open_beneath(int folder, const std::string& path, int flags);

/// Does the same one component after the other, as other kernels have it.
FileHandle walk_beneath(int folder, const std::string& path, int flags);

}  // namespace crt::studio
