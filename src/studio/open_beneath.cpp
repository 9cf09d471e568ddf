#include "studio/open_beneath.hpp"

#include <fcntl.h>
#include <sys/syscall.h>

#include <cerrno>
#include <filesystem>
#include <vector>

#if __has_include(<linux/openat2.h>)
#include <linux/openat2.h>
#endif

namespace crt::studio {

namespace {

#if defined(SYS_openat2) && defined(RESOLVE_BENEATH)

/// Asks the kernel. errno is ENOSYS, or says something else that is no answer, if it cannot say.
FileHandle ask_kernel(int folder, const std::string& path, int flags) {
  open_how how{};
  how.flags = static_cast<unsigned>(flags | O_CLOEXEC);
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_SYMLINKS | RESOLVE_NO_MAGICLINKS;
  return FileHandle(static_cast<int>(syscall(SYS_openat2, folder, path.c_str(), &how, sizeof how)));
}

#else

FileHandle ask_kernel(int /*folder*/, const std::string& /*path*/, int /*flags*/) {
  errno = ENOSYS;
  return {};
}

#endif

}  // namespace

FileHandle walk_beneath(int folder, const std::string& path, int flags) {
  const std::filesystem::path parts(path);
  FileHandle at;
  for (auto part = parts.begin(); part != parts.end();) {
    const std::string name = part->string();
    if (name.empty() || name == ".." || name == "/") {
      errno = EXDEV;
      return {};
    }
    const bool is_last = ++part == parts.end();
    const int from = at.is_open() ? at.get() : folder;
    FileHandle next(openat(from, name.c_str(),
                           (is_last ? flags : O_PATH | O_DIRECTORY) | O_NOFOLLOW | O_CLOEXEC));
    if (!next.is_open()) return {};
    at = std::move(next);
  }
  if (!at.is_open()) errno = ENOENT;
  return at;
}

FileHandle open_beneath(int folder, const std::string& path, int flags) {
  FileHandle file = ask_kernel(folder, path, flags);
  // Old kernels do not know it, sandboxes do not let it pass, and where folders are moved about
  // meanwhile it may have no answer.
  if (file.is_open() || (errno != ENOSYS && errno != EPERM && errno != EAGAIN && errno != E2BIG))
    return file;
  return walk_beneath(folder, path, flags);
}

}  // namespace crt::studio
