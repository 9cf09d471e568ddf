// These tests stand between the library and the system, and see when what is written goes to disk.
#include <dlfcn.h>
#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <crt/error.hpp>
#include <crt/file.hpp>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "core/base/state_file.hpp"
#include "core/base/whole_file.hpp"
#include "support/temporary_directory.hpp"

using namespace crt;
using namespace crt::test;

namespace {

thread_local std::vector<std::string> calls;
/// fsync() fails with this, if it is not 0.
thread_local int failure_of_fsync = 0;

std::string content_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Makes fsync() fail as long as it lives.
struct FailingFsync {
  explicit FailingFsync(int error) { failure_of_fsync = error; }
  ~FailingFsync() { failure_of_fsync = 0; }
  FailingFsync(const FailingFsync&) = delete;
  FailingFsync& operator=(const FailingFsync&) = delete;
};

const std::vector<std::string> safely = {"fsync", "renameat", "fsync"};

}  // namespace

// The library calls these instead of those of the system, which they call.
extern "C" int fsync(int file) {
  calls.emplace_back("fsync");
  if (failure_of_fsync != 0) {
    errno = failure_of_fsync;
    return -1;
  }
  static const auto real = reinterpret_cast<int (*)(int)>(dlsym(RTLD_NEXT, "fsync"));
  return real(file);
}

extern "C" int renameat(int from, const char* name, int to, const char* other) noexcept {
  calls.emplace_back("renameat");
  static const auto real =
      reinterpret_cast<int (*)(int, const char*, int, const char*)>(dlsym(RTLD_NEXT, "renameat"));
  return real(from, name, to, other);
}

TEST_CASE("a text is on its disk before it takes the old one's place, and so is the folder after") {
  const TemporaryDirectory folder;
  for (const char* text : {"first", "second"}) {
    calls.clear();
    write_file(folder / "a", text);
    CHECK(calls == safely);
  }
  const int place = open(folder.path().c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  calls.clear();
  write_file_in(place, "b", "third");
  CHECK(calls == safely);
  close(place);
}

TEST_CASE("a checkpoint is on its disk before it takes the place of the one before") {
  const TemporaryDirectory folder;
  calls.clear();
  core::write_state_file(folder / "a", [](core::StateWriter& out) { out.put(7); });
  CHECK(calls == safely);
}

TEST_CASE("what can be rendered again does not wait for its disk") {
  const TemporaryDirectory folder;
  calls.clear();
  core::write_whole_file(folder / "a", std::as_bytes(std::span("picture")), core::Flush::later);
  CHECK(calls == std::vector<std::string>{"renameat"});
}

TEST_CASE("where the disk fails, the old text stays and the error says why") {
  const TemporaryDirectory folder;
  write_file(folder / "a", "old");
  calls.clear();
  const FailingFsync failing(EIO);
  CHECK_THROWS_WITH_AS(write_file(folder / "a", "new"), doctest::Contains("Input/output error"),
                       Error);
  CHECK(calls == std::vector<std::string>{"fsync"});
  CHECK(content_of(folder / "a") == "old");
  CHECK(folder.entries() == 1);
}

TEST_CASE("a file system that knows no disk takes the text") {
  const TemporaryDirectory folder;
  const FailingFsync failing(EINVAL);
  write_file(folder / "a", "new");
  CHECK(content_of(folder / "a") == "new");
}
