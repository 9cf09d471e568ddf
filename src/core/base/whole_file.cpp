#include "core/base/whole_file.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>

#include "core/base/memory_limit.hpp"
#include "core/base/output_place.hpp"
#include "crt/error.hpp"
#include "crt/file.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_to_read(const fs::path& path, const std::string& reason) {
  throw Error(ErrorCode::io, text::format("cannot read '{}': {}", path.string(), reason));
}

/// A Descriptor closes its file when it goes out of scope.
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
  /// Closes the file. Returns whether the system has taken all that was written.
  bool close() { return ::close(std::exchange(value_, -1)) == 0; }

 private:
  int value_;
};

/// Keeps two signals that writing may raise, and that would end the process, from the calling
/// thread as long as it lives. These are SIGPIPE, of a pipe without a reader, and SIGXFSZ, of a
/// file that grows beyond what the process may write. Writing then fails.
class NoWriteSignals {
 public:
  NoWriteSignals() {
    sigemptyset(&raised_);
    for (const int signal : {SIGPIPE, SIGXFSZ}) {
      if (!is_pending(signal)) sigaddset(&raised_, signal);
    }
    pthread_sigmask(SIG_BLOCK, &raised_, &before_);
  }
  NoWriteSignals(const NoWriteSignals&) = delete;
  NoWriteSignals& operator=(const NoWriteSignals&) = delete;
  ~NoWriteSignals() {
    for (const int signal : {SIGPIPE, SIGXFSZ}) {
      // Our own writing has raised it.
      if (sigismember(&raised_, signal) == 1 && is_pending(signal)) take(signal);
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

 private:
  static bool is_pending(int signal) {
    sigset_t pending;
    return sigpending(&pending) == 0 && sigismember(&pending, signal) == 1;
  }
  static void take(int signal) {
    sigset_t one;
    sigemptyset(&one);
    sigaddset(&one, signal);
    sigwait(&one, &signal);
  }

  sigset_t raised_{};  ///< those that were not pending before
  sigset_t before_{};
};

/// Reads some bytes and returns how many there were, 0 at the end.
std::size_t read_some(const Descriptor& file, std::span<std::byte> bytes, const fs::path& path) {
  for (;;) {
    const ssize_t count = ::read(file.get(), bytes.data(), bytes.size());
    if (count >= 0) return static_cast<std::size_t>(count);
    if (errno != EINTR) fail_to_read(path, system_message(errno));
  }
}

/// A RegularFile is open, and was so long when it was opened.
struct RegularFile {
  Descriptor descriptor;
  std::size_t size = 0;
};

RegularFile open_regular(const fs::path& path) {
  // With O_NONBLOCK a pipe without a writer does not hang us. For a regular file it means nothing.
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file.valid()) fail_to_read(path, system_message(errno));
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) fail_to_read(path, system_message(errno));
  if (S_ISDIR(status.st_mode)) fail_to_read(path, "it is a directory");
  if (!S_ISREG(status.st_mode)) fail_to_read(path, "it is not a regular file");
  return {std::move(file), static_cast<std::size_t>(status.st_size)};
}

/// Returns the first `size` bytes, or what there is.
std::vector<std::byte> read_start(const Descriptor& file, std::size_t size, const fs::path& path) {
  std::vector<std::byte> content(size);
  std::size_t filled = 0;
  while (filled < size) {
    const std::size_t count = read_some(file, std::span(content).subspan(filled), path);
    if (count == 0) break;
    filled += count;
  }
  content.resize(filled);
  return content;
}

/// Waits until a file that was opened with O_NONBLOCK takes more.
void wait_to_write(int file) {
  pollfd ready = {.fd = file, .events = POLLOUT, .revents = 0};
  ::poll(&ready, 1, -1);
}

/// Writes all of `content`. `path` is for messages.
void write_all(const Descriptor& file, std::span<const std::byte> content, const fs::path& path) {
  while (!content.empty()) {
    const ssize_t written = ::write(file.get(), content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) {
      wait_to_write(file.get());
      continue;
    }
    if (written < 0) fail_to_write(path, system_message(errno));
    content = content.subspan(static_cast<std::size_t>(written));
  }
}

/// Waits until what was written to a file is on its disk, as far as the file system can say.
void flush_to_disk(const Descriptor& file, const fs::path& path) {
  while (::fsync(file.get()) != 0) {
    if (errno == EINVAL || errno == ENOTSUP || errno == EROFS) return;
    if (errno != EINTR) fail_to_write(path, system_message(errno));
  }
}

/// Writes to the open file directly, without a temporary file.
void write_straight(Descriptor file, const fs::path& path, const FilePieces& produce, Flush flush) {
  if (!file.valid()) fail_to_write(path, system_message(errno));
  const NoWriteSignals no_signals;
  produce([&](std::span<const std::byte> piece) { write_all(file, piece, path); });
  if (flush == Flush::at_once) flush_to_disk(file, path);
  if (!file.close()) fail_to_write(path, system_message(errno));
}

Descriptor open_as_it_is(const OutputPlace& place) {
  return Descriptor(::open(place.path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
}

/// Opens a regular file in order to write over it.
Descriptor open_in_place(const OutputPlace& place) {
  // In a folder that others may change it may have become a link or a pipe by now.
  const int more = place.is_in_folder() ? O_NOFOLLOW | O_NONBLOCK : 0;
  return Descriptor(
      ::openat(place.folder, place.path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY | O_TRUNC | more));
}

/// Returns whether the system refuses to change a folder, which says nothing of the files in it.
bool is_refusal(int error) {
  return error == EACCES || error == EPERM || error == EROFS || error == EBUSY;
}

/// A TemporaryFile is a new file in the folder of a place. It vanishes unless it is moved there.
class TemporaryFile {
 public:
  explicit TemporaryFile(const OutputPlace& place)
      : place_(place), file_(create()), is_made_(file_.valid()) {}
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (is_made_ && !is_moved_) ::unlinkat(place_.folder, name_.c_str(), 0);
  }

  /// Returns whether the file could be made. If not, errno says why.
  bool is_made() const { return is_made_; }

  void write(std::span<const std::byte> content) { write_all(file_, content, place_.path); }

  void move_to_place(Flush flush) {
    if (place_.model) take_owner_and_permissions(*place_.model);
    if (flush == Flush::at_once) flush_to_disk(file_, place_.path);
    if (!file_.close()) fail_to_write(place_.path, system_message(errno));
    is_moved_ = ::renameat(place_.folder, name_.c_str(), place_.folder, place_.path.c_str()) == 0;
    if (is_moved_) {
      if (flush == Flush::at_once) flush_folder();
      return;
    }
    if (!is_replacement() || !is_refusal(errno)) fail_to_write(place_.path, system_message(errno));
    copy_to_place(flush);
  }

 private:
  bool is_replacement() const { return place_.kind == OutputPlace::Kind::regular_file; }

  /// Has the folder's disk know of the move, where a folder can be asked for that.
  void flush_folder() const {
    const fs::path folder = name_.has_parent_path() ? name_.parent_path() : fs::path(".");
    const Descriptor file(
        ::openat(place_.folder, folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (file.valid()) std::ignore = ::fsync(file.get());
  }

  /// Tries names until one is free. O_EXCL makes each attempt safe from other writers.
  Descriptor create() {
    constexpr int max_attempts = 10000;
    constexpr mode_t readable_by_all = 0666;
    // A file that others may not read is not to be read by them while its replacement is written.
    constexpr mode_t private_at_first = 0600;
    for (int attempt = 0; attempt < max_attempts; ++attempt) {
      name_ = place_.path.parent_path() / text::format(".crt-{}-{}.part", ::getpid(), attempt);
      Descriptor file(::openat(place_.folder, name_.c_str(),
                               O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC,
                               place_.model ? private_at_first : readable_by_all));
      if (file.valid() || errno != EEXIST) return file;
    }
    return Descriptor(-1);
  }

  /// Takes owner and permissions from another file. The system may refuse, which is no error, as
  /// the content is what counts. But what a group may do is not given to another one.
  void take_owner_and_permissions(const struct stat& model) const {
    constexpr mode_t permissions = 0777;
    constexpr auto same_owner = static_cast<uid_t>(-1);
    const bool has_group = ::fchown(file_.get(), same_owner, model.st_gid) == 0;
    std::ignore = ::fchown(file_.get(), model.st_uid, model.st_gid);
    const mode_t withheld = has_group || !place_.is_in_folder() ? 0 : S_IRWXG;
    std::ignore = ::fchmod(file_.get(), model.st_mode & permissions & ~withheld);
  }

  /// Copies the content into the file that is there, for places where no file can be replaced.
  void copy_to_place(Flush flush) const {
    const Descriptor source(::openat(place_.folder, name_.c_str(), O_RDONLY | O_CLOEXEC));
    if (!source.valid()) fail_to_write(place_.path, system_message(errno));
    const auto produce = [&](const auto& write) {
      std::array<std::byte, std::size_t{1} << 16> buffer;
      while (const std::size_t count = read_some(source, buffer, place_.path)) {
        write(std::span(buffer).first(count));
      }
    };
    write_straight(open_in_place(place_), place_.path, produce, flush);
  }

  const OutputPlace& place_;
  fs::path name_;
  Descriptor file_;
  bool is_made_;
  bool is_moved_ = false;
};

/// Returns whether to overwrite the file itself, as it may be writable though its folder is not.
bool may_write_in_place(const OutputPlace& place, int refusal) {
  return place.kind == OutputPlace::Kind::regular_file && is_refusal(refusal);
}

/// Throws Error (io) if the file that a new one would replace is protected.
void check_protection(const OutputPlace& place) {
  if (place.kind == OutputPlace::Kind::new_file || place.kind == OutputPlace::Kind::descriptor)
    return;
  if (::faccessat(place.folder, place.path.c_str(), W_OK, AT_EACCESS) != 0) {
    fail_to_write(place.path, system_message(errno));
  }
}

void write_to(const OutputPlace& place, const FilePieces& produce, Flush flush) {
  check_protection(place);
  if (place.kind == OutputPlace::Kind::descriptor) {
    Descriptor file(::fcntl(place.descriptor, F_DUPFD_CLOEXEC, 0));
    return write_straight(std::move(file), place.path, produce, Flush::later);
  }
  if (place.kind == OutputPlace::Kind::special)
    return write_straight(open_as_it_is(place), place.path, produce, Flush::later);
  TemporaryFile file(place);
  if (file.is_made()) {
    const NoWriteSignals no_signals;
    produce([&](std::span<const std::byte> piece) { file.write(piece); });
    return file.move_to_place(flush);
  }
  if (!may_write_in_place(place, errno)) fail_to_write(place.path, system_message(errno));
  write_straight(open_in_place(place), place.path, produce, flush);
}

}  // namespace

std::vector<std::byte> read_whole_file(const fs::path& path, std::size_t max_bytes) {
  const auto [file, size] = open_regular(path);
  constexpr std::size_t few_bytes = std::size_t{1} << 26;  // for which memory is not looked at
  const std::uint64_t most =
      size <= few_bytes ? max_bytes : std::min<std::uint64_t>(max_bytes, memory_limit() / 2);
  if (size > most) fail_to_read(path, text::format("it is longer than {} bytes", most));
  return read_start(file, size, path);
}

std::vector<std::byte> read_file_start(const fs::path& path, std::size_t max_bytes) {
  const auto [file, size] = open_regular(path);
  return read_start(file, std::min(size, max_bytes), path);
}

void write_whole_file(const fs::path& path, std::span<const std::byte> content, Flush flush) {
  write_whole_file(
      path, [&](const auto& write) { write(content); }, flush);
}

void write_whole_file(const fs::path& path, const FilePieces& produce, Flush flush) {
  write_to(output_place(path), produce, flush);
}

}  // namespace crt::core

namespace crt {

void write_file(const std::filesystem::path& path, std::span<const std::byte> content) {
  core::write_whole_file(path, content, core::Flush::at_once);
}

void write_file(const std::filesystem::path& path, std::string_view content) {
  write_file(path, std::as_bytes(std::span(content)));
}

void write_file_in(int folder, const std::string& name, std::string_view content,
                   const std::string& like) {
  core::write_to(
      core::output_place_in(folder, name, like),
      [&](const auto& write) { write(std::as_bytes(std::span(content))); }, core::Flush::at_once);
}

void check_writable(const std::filesystem::path& path) {
  using namespace core;
  const OutputPlace place = output_place(path);
  check_protection(place);
  if (place.kind == OutputPlace::Kind::special || place.kind == OutputPlace::Kind::descriptor)
    return;
  const TemporaryFile probe(place);
  if (!probe.is_made() && !may_write_in_place(place, errno))
    fail_to_write(path, system_message(errno));
}

}  // namespace crt
