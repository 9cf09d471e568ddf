#include "core/base/output_place.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <optional>
#include <system_error>

#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

namespace fs = std::filesystem;

/// Linux itself follows as many symbolic links.
constexpr int max_links = 40;

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// Returns the number of the descriptor of this process that the file system shows under `path`.
/// The name there is a link to the file that is open. But whoever names the descriptor means what
/// is open, with its place in the file.
std::optional<int> own_descriptor(const fs::path& path) {
  const std::string name = path.filename().string();
  int number = -1;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (name.empty() || error != std::errc{} || end != name.data() + name.size()) return std::nullopt;
  std::error_code failed;
  const fs::path folder = fs::canonical(folder_of(path), failed);
  if (failed) return std::nullopt;
  for (const char* own : {"/proc/self/fd", "/proc/thread-self/fd"}) {
    if (folder == fs::canonical(own, failed) && !failed) return number;
  }
  return std::nullopt;
}

/// Checks that a file can be made at a path where there is nothing. Throws Error (io) otherwise.
void check_folder(const fs::path& path) {
  if (path.empty()) fail_to_write(path, "a file needs a name");
  const fs::path folder = folder_of(path);
  std::error_code unreachable;
  if (fs::is_directory(folder, unreachable)) return;
  fail_to_write(path, text::format("there is no folder '{}'; make it first, or name another",
                                   folder.string()));
}

/// Returns what a file in a folder is like, or one for its owner alone if there is none.
struct stat model_in(int folder, const std::string& name) {
  struct stat model {};
  if (::fstatat(folder, name.c_str(), &model, AT_SYMLINK_NOFOLLOW) == 0 && S_ISREG(model.st_mode))
    return model;
  model.st_mode = S_IRUSR | S_IWUSR;
  model.st_uid = ::geteuid();
  model.st_gid = ::getegid();
  return model;
}

}  // namespace

std::string system_message(int error) {
  return std::generic_category().message(error);
}

void fail_to_write(const fs::path& path, const std::string& reason) {
  throw Error(ErrorCode::io, text::format("cannot write '{}': {}", path.string(), reason));
}

OutputPlace output_place(const fs::path& path) {
  using Kind = OutputPlace::Kind;
  fs::path at = path;
  for (int links = 0; links <= max_links; ++links) {
    if (const std::optional<int> number = own_descriptor(at))
      return {Kind::descriptor, path, *number};
    struct stat status {};
    if (::lstat(at.c_str(), &status) != 0) {
      if (errno != ENOENT && errno != ENOTDIR) fail_to_write(path, system_message(errno));
      check_folder(at);
      return {Kind::new_file, at};
    }
    if (S_ISDIR(status.st_mode)) fail_to_write(path, "it is a folder; add a file's name to it");
    if (S_ISREG(status.st_mode)) return {.kind = Kind::regular_file, .path = at, .model = status};
    if (!S_ISLNK(status.st_mode)) return {Kind::special, at};
    std::error_code failed;
    const fs::path target = fs::read_symlink(at, failed);
    if (failed) fail_to_write(path, failed.message());
    at = at.parent_path() / target;
  }
  fail_to_write(path, "its symbolic links lead in a circle");
}

OutputPlace output_place_in(int folder, const std::string& name, const std::string& like) {
  if (name.empty() || name == "." || name == ".." || name.find('/') != std::string::npos ||
      name.find('\0') != std::string::npos)
    fail_to_write(name, "it is no name of a file in a folder");
  OutputPlace place{.kind = OutputPlace::Kind::new_file, .path = name, .folder = folder};
  struct stat status {};
  if (::fstatat(folder, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0) {
    if (!S_ISREG(status.st_mode)) fail_to_write(name, "it is no regular file");
    place.kind = OutputPlace::Kind::regular_file;
    place.model = status;
  } else if (errno != ENOENT) {
    fail_to_write(name, system_message(errno));
  }
  if (!like.empty()) place.model = model_in(folder, like);
  return place;
}

}  // namespace crt::core
