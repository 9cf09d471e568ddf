#include "core/files/whole_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "crt/error.hpp"

namespace crt::core {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const char* action, const fs::path& path, const std::string& reason) {
  throw Error(ErrorCode::io, fmt::format("cannot {} '{}': {}", action, path.string(), reason));
}

std::string error_text(int error) {
  return std::generic_category().message(error);
}

/// Closes a file on the way out.
class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }

  int get() const { return value_; }
  bool valid() const { return value_ >= 0; }
  /// Whether all that was written has been taken.
  bool close() { return ::close(std::exchange(value_, -1)) == 0; }

 private:
  int value_;
};

/// A new file beside `path` that vanishes unless it is moved to its place.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& path) : target_(path), file_(create()) {}
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (!moved_) ::unlink(name_.c_str());
  }

  void write(std::span<const std::byte> content) {
    while (!content.empty()) {
      const ssize_t written = ::write(file_.get(), content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail("write", target_, error_text(errno));
      content = content.subspan(static_cast<std::size_t>(written));
    }
  }

  void move_to_target() {
    if (!file_.close()) fail("write", target_, error_text(errno));
    if (::rename(name_.c_str(), target_.c_str()) != 0) fail("write", target_, error_text(errno));
    moved_ = true;
  }

 private:
  /// Tries names until there is none of it: O_EXCL makes each attempt safe from other writers.
  Descriptor create() {
    constexpr int most_attempts = 10000;
    constexpr mode_t readable_by_all = 0666;
    for (int attempt = 0; attempt < most_attempts; ++attempt) {
      name_ = target_.parent_path() / fmt::format(".crt-{}-{}.part", ::getpid(), attempt);
      Descriptor file(::open(name_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, readable_by_all));
      if (file.valid()) return file;
      if (errno != EEXIST) break;
    }
    fail("write", target_, error_text(errno));
  }

  fs::path target_;
  fs::path name_;
  Descriptor file_;
  bool moved_ = false;
};

}  // namespace

std::vector<std::byte> read_whole_file(const fs::path& path, std::size_t max_bytes) {
  // O_NONBLOCK: a pipe without a writer must not hang us; for a regular file it means nothing.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file.valid()) fail("read", path, error_text(errno));
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) fail("read", path, error_text(errno));
  if (S_ISDIR(status.st_mode)) fail("read", path, "it is a directory");
  if (!S_ISREG(status.st_mode)) fail("read", path, "it is not a regular file");
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > max_bytes) fail("read", path, fmt::format("it is longer than {} bytes", max_bytes));
  std::vector<std::byte> content(size);
  std::size_t filled = 0;
  while (filled < size) {
    const ssize_t count = ::read(file.get(), content.data() + filled, size - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("read", path, error_text(errno));
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  content.resize(filled);
  return content;
}

void write_whole_file(const fs::path& path, std::span<const std::byte> content) {
  write_whole_file(path, [&](const auto& write) { write(content); });
}

void write_whole_file(const fs::path& path, const FilePieces& produce) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) fail("write", path, "it is a directory");
  TemporaryFile file(path);
  produce([&](std::span<const std::byte> piece) { file.write(piece); });
  file.move_to_target();
}

}  // namespace crt::core
