// These tests write files, and check what is replaced and what stays as it is.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <crt/error.hpp>
#include <crt/file.hpp>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

#include "core/base/whole_file.hpp"
#include "support/temporary_directory.hpp"

using namespace crt;
using namespace crt::test;

namespace fs = std::filesystem;

namespace {

std::string content_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void put(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

struct stat status_of(const fs::path& path) {
  struct stat status {};
  REQUIRE(lstat(path.c_str(), &status) == 0);
  return status;
}

mode_t permissions_of(const fs::path& path) {
  constexpr mode_t all = 07777;
  return status_of(path).st_mode & all;
}

/// Returns the message of write_file() and check_writable(), or "" if both succeed.
std::string failure(const fs::path& path) {
  std::string of_writing;
  std::string of_check;
  try {
    check_writable(path);
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::io);
    of_check = error.what();
  }
  try {
    write_file(path, "new");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::io);
    of_writing = error.what();
  }
  CHECK(of_check == of_writing);
  return of_writing;
}

/// Says whether `works` returns true in a process of a user who is not root, and with this umask.
bool as_common_user(const std::function<bool()>& works, mode_t mask = 022) {
  const pid_t child = fork();
  if (child == 0) {
    constexpr uid_t nobody = 65534;
    umask(mask);
    const bool is_common = geteuid() != 0 || (setgid(nobody) == 0 && setuid(nobody) == 0);
    bool is_fine = false;
    try {
      is_fine = is_common && works();
    } catch (const std::exception&) {
      is_fine = false;
    }
    _exit(is_fine ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// Says whether users who are not root reach temporary files at all. In a chroot whose root is
/// closed to them they do not, and then there is nothing to test.
bool common_users_reach_files() {
  const bool they_do =
      as_common_user([] { return access(fs::temp_directory_path().c_str(), W_OK | X_OK) == 0; });
  if (!they_do) MESSAGE("only root reaches temporary files here");
  return they_do;
}

/// A Reader reads a pipe to its end on a thread of its own.
class Reader {
 public:
  explicit Reader(const fs::path& pipe) : thread_([this, pipe] { read_ = content_of(pipe); }) {}
  std::string read() {
    thread_.join();
    return read_;
  }

 private:
  std::string read_;
  std::thread thread_;
};

}  // namespace

TEST_CASE("a file is replaced at once, and nothing else is left") {
  const TemporaryDirectory folder;
  write_file(folder / "a", "first");
  const int old = open((folder / "a").c_str(), O_RDONLY);
  write_file(folder / "a", "second, longer");
  CHECK(content_of(folder / "a") == "second, longer");
  std::array<char, 16> still{};
  CHECK(read(old, still.data(), still.size()) ==
        5);  // a reader that has the old file open sees it whole
  close(old);
  CHECK(folder.entries() == 1);
}

TEST_CASE(
    "a new file has the permissions that the process gives, one that is replaced keeps its own") {
  if (!common_users_reach_files()) return;
  const TemporaryDirectory folder;
  fs::permissions(folder.path(), fs::perms::all);
  for (const mode_t mask : {mode_t{022}, mode_t{077}, mode_t{002}}) {
    const fs::path path = folder / ("new" + std::to_string(mask));
    REQUIRE(as_common_user(
        [&] {
          write_file(path, "x");
          return true;
        },
        mask));
    CHECK(permissions_of(path) == (0666u & ~mask));
  }
  for (const mode_t mode : {mode_t{0600}, mode_t{0640}, mode_t{0666}, mode_t{0755}}) {
    const fs::path path = folder / ("old" + std::to_string(mode));
    put(path, "x");
    REQUIRE(chmod(path.c_str(), mode) == 0);
    write_file(path, "y");
    CHECK(content_of(path) == "y");
    CHECK(permissions_of(path) == mode);
  }
}

TEST_CASE("a file that is replaced keeps its owner and group if we may give it to them" *
          doctest::skip(geteuid() != 0)) {
  const TemporaryDirectory folder;
  put(folder / "a", "x");
  REQUIRE(chown((folder / "a").c_str(), 4321, 1234) == 0);
  write_file(folder / "a", "y");
  CHECK(status_of(folder / "a").st_uid == 4321);
  CHECK(status_of(folder / "a").st_gid == 1234);
}

TEST_CASE("a symbolic link stays one, and what it leads to is written") {
  const TemporaryDirectory folder;
  fs::create_directory(folder / "sub");
  put(folder / "sub/target", "old");
  fs::create_symlink("sub/target", folder / "direct");
  fs::create_symlink(folder / "direct", folder / "by_another");
  fs::create_symlink("../later", folder / "sub/dangling");
  write_file(folder / "direct", "one");
  CHECK(content_of(folder / "sub/target") == "one");
  write_file(folder / "by_another", "two");
  CHECK(content_of(folder / "sub/target") == "two");
  CHECK(fs::is_regular_file(fs::symlink_status(folder / "sub/target")));
  write_file(folder / "sub/dangling", "three");
  CHECK(content_of(folder / "later") == "three");
  for (const char* link : {"direct", "by_another", "sub/dangling"}) {
    CHECK(fs::is_symlink(folder / link));
  }
  CHECK(folder.entries() == 4);
}

TEST_CASE("links that lead nowhere are an error that says so, and change nothing") {
  const TemporaryDirectory folder;
  fs::create_symlink("b", folder / "a");
  fs::create_symlink("a", folder / "b");
  CHECK(failure(folder / "a").find("circle") != std::string::npos);
  fs::create_symlink("missing/file", folder / "c");
  CHECK(failure(folder / "c").find("there is no folder") != std::string::npos);
  fs::create_symlink(".", folder / "d");
  CHECK(failure(folder / "d").find("it is a folder") != std::string::npos);
  CHECK(failure("").find("cannot write ''") != std::string::npos);
  CHECK(folder.entries() == 4);
}

TEST_CASE("another hard link of a file keeps what was in it") {
  const TemporaryDirectory folder;
  put(folder / "a", "old");
  fs::create_hard_link(folder / "a", folder / "b");
  write_file(folder / "a", "new");
  CHECK(content_of(folder / "a") == "new");
  CHECK(content_of(folder / "b") == "old");
}

TEST_CASE("a named pipe is written to and stays one") {
  const TemporaryDirectory folder;
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  fs::create_symlink("pipe", folder / "link");
  const std::string text(200000, 'x');  // more than a pipe holds
  for (const char* name : {"pipe", "link"}) {
    Reader reader(folder / "pipe");
    write_file(folder / name, text);
    CHECK(reader.read() == text);
  }
  CHECK(S_ISFIFO(status_of(folder / "pipe").st_mode));
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(folder.entries() == 2);
}

TEST_CASE("a pipe whose reader goes away is an error, and no signal ends the process") {
  const TemporaryDirectory folder;
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  std::thread reader([&] {
    const int pipe = open((folder / "pipe").c_str(), O_RDONLY);
    char byte = 0;
    CHECK(read(pipe, &byte, 1) == 1);
    close(pipe);
  });
  std::string message;
  try {
    write_file(folder / "pipe", std::string(10000000, 'x'));
  } catch (const Error& error) {
    message = error.what();
  }
  reader.join();
  CHECK(message.find("Broken pipe") != std::string::npos);
}

TEST_CASE("a file beyond what the process may write is an error that leaves nothing") {
  CHECK(as_common_user([] {
    // The folder is of this user, whoever that is.
    const TemporaryDirectory own;
    const fs::path file = own / "large";
    rlimit limit{};
    if (getrlimit(RLIMIT_FSIZE, &limit) != 0) return false;
    limit.rlim_cur = 1000;
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return false;
    bool is_error = false;
    try {
      write_file(file, std::string(5000, 'x'));
    } catch (const Error& error) {
      is_error = error.code() == ErrorCode::io;
    }
    write_file(own / "small", "x");
    return is_error && std::distance(fs::directory_iterator(own.path()), {}) == 1;
  }));
}

TEST_CASE("a file that is longer than memory allows is refused before it is read") {
  const TemporaryDirectory directory;
  const fs::path file = directory / "sparse";
  put(file, "start");
  std::error_code failed;
  constexpr std::uintmax_t terabyte = std::uintmax_t{1} << 40;
  fs::resize_file(file, terabyte, failed);
  if (failed) return;  // this file system has no such files
  CHECK_THROWS_AS(core::read_whole_file(file, 2 * terabyte), Error);
  CHECK(core::read_file_start(file, 5).size() == 5);
}

TEST_CASE("a device is written to and stays one") {
  const TemporaryDirectory folder;
  const fs::path null = folder / "null";
  const fs::path full = folder / "full";
  // This never uses the machine's own devices, which a fault here would replace.
  if (mknod(null.c_str(), S_IFCHR | 0666, makedev(1, 3)) != 0 ||
      mknod(full.c_str(), S_IFCHR | 0666, makedev(1, 7)) != 0) {
    MESSAGE("this user may make no devices");
    return;
  }
  const int opened = open(null.c_str(), O_WRONLY);
  if (opened < 0) {
    MESSAGE("this file system has no devices");
    return;
  }
  close(opened);
  write_file(null, "gone");
  CHECK(S_ISCHR(status_of(null).st_mode));
  CHECK_THROWS_WITH_AS(write_file(full, "too much"), doctest::Contains("No space left"), Error);
  CHECK(S_ISCHR(status_of(full).st_mode));
  CHECK(folder.entries() == 2);
}

TEST_CASE("a descriptor of the process is written to where it stands" *
          doctest::skip(!fs::exists("/dev/fd"))) {
  const TemporaryDirectory folder;
  const int file = open((folder / "a").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  REQUIRE(write(file, "before ", 7) == 7);
  const std::string name = "/dev/fd/" + std::to_string(file);
  write_file(name, "here");
  REQUIRE(write(file, " after", 6) == 6);
  close(file);
  CHECK(content_of(folder / "a") == "before here after");
  CHECK_THROWS_WITH_AS(write_file(name, "x"), doctest::Contains("Bad file descriptor"), Error);
  CHECK(folder.entries() == 1);
}

TEST_CASE("a file that may be written is, though its folder may not: in place") {
  if (!common_users_reach_files()) return;
  const TemporaryDirectory folder;
  put(folder / "a", "an old and longer text");
  REQUIRE(chmod((folder / "a").c_str(), 0666) == 0);
  fs::permissions(folder.path(), fs::perms(0555));
  CHECK(as_common_user([&] {
    check_writable(folder / "a");
    write_file(folder / "a", "new");
    return content_of(folder / "a") == "new";
  }));
  CHECK(as_common_user(
      [&] { return failure(folder / "b").find("Permission denied") != std::string::npos; }));
  fs::permissions(folder.path(), fs::perms(0755));
  CHECK(folder.entries() == 1);
}

TEST_CASE(
    "in a folder where nobody replaces what is another's, a file that all may write is written in "
    "place" *
    doctest::skip(geteuid() != 0)) {
  if (!common_users_reach_files()) return;
  const TemporaryDirectory folder;
  put(folder / "a", "old");
  REQUIRE(chmod((folder / "a").c_str(), 0666) == 0);
  REQUIRE(chmod(folder.path().c_str(), 01777) == 0);
  CHECK(as_common_user([&] {
    write_file(folder / "a", "new");
    return true;
  }));
  CHECK(content_of(folder / "a") == "new");
  CHECK(status_of(folder / "a").st_uid == 0);
  CHECK(folder.entries() == 1);
}

TEST_CASE("a file that may not be written is not replaced, though its folder would allow it") {
  if (!common_users_reach_files()) return;
  const TemporaryDirectory folder;
  put(folder / "a", "old");
  REQUIRE(chmod((folder / "a").c_str(), 0444) == 0);
  fs::permissions(folder.path(), fs::perms::all);
  CHECK(as_common_user(
      [&] { return failure(folder / "a").find("Permission denied") != std::string::npos; }));
  CHECK(content_of(folder / "a") == "old");
  CHECK(folder.entries() == 1);
}
