// These tests write files in an open folder, among links and pipes that would lead elsewhere.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <crt/error.hpp>
#include <crt/file.hpp>
#include <fstream>
#include <string>

#include "support/temporary_directory.hpp"

using namespace crt;
using namespace crt::test;

namespace {

namespace fs = std::filesystem;

/// An OpenFolder is new, and known by a descriptor.
struct OpenFolder {
  TemporaryDirectory folder;
  int descriptor = open(folder.path().c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);

  OpenFolder() = default;
  OpenFolder(const OpenFolder&) = delete;
  OpenFolder& operator=(const OpenFolder&) = delete;
  ~OpenFolder() { close(descriptor); }

  fs::path operator/(const std::string& name) const { return folder / name; }
  std::string content_of(const std::string& name) const {
    std::ifstream stream(folder / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  mode_t mode_of(const std::string& name) const {
    struct stat status {};
    REQUIRE(lstat((folder / name).c_str(), &status) == 0);
    return status.st_mode & 07777;
  }
};

}  // namespace

TEST_CASE("a file in a folder is made and replaced, wherever the folder is moved") {
  const OpenFolder open;
  const TemporaryDirectory elsewhere;
  write_file_in(open.descriptor, "a", "first");
  REQUIRE(chmod((open / "a").c_str(), 0640) == 0);
  write_file_in(open.descriptor, "a", "second");
  CHECK(open.content_of("a") == "second");
  CHECK(open.mode_of("a") == 0640);
  fs::rename(open.folder.path(), elsewhere / "moved");
  write_file_in(open.descriptor, "b", "third");
  CHECK(fs::exists(elsewhere / "moved" / "b"));
  fs::rename(elsewhere / "moved", open.folder.path());
  CHECK(open.folder.entries() == 2);
}

TEST_CASE("no link is followed, whether it leads to something or nowhere") {
  const OpenFolder open;
  const TemporaryDirectory elsewhere;
  std::ofstream(elsewhere / "secret") << "old";
  fs::create_symlink(elsewhere / "secret", open / "link");
  fs::create_symlink(elsewhere / "new", open / "dangling");
  for (const char* name : {"link", "dangling"}) {
    CHECK_THROWS_WITH_AS(write_file_in(open.descriptor, name, "x"),
                         doctest::Contains("it is no regular file"), Error);
    CHECK(fs::is_symlink(open / name));
  }
  CHECK(elsewhere.entries() == 1);
  CHECK(open.folder.entries() == 2);
}

TEST_CASE("neither a pipe without a reader nor a folder is written to or waited for") {
  const OpenFolder open;
  REQUIRE(mkfifo((open / "pipe").c_str(), 0600) == 0);
  fs::create_directory(open / "folder");
  for (const char* name : {"pipe", "folder"})
    CHECK_THROWS_AS(write_file_in(open.descriptor, name, "x"), Error);
  CHECK(fs::is_fifo(open / "pipe"));
  CHECK(open.folder.entries() == 2);
}

TEST_CASE("what is no mere name is refused") {
  const OpenFolder open;
  for (const char* name : {"", ".", "..", "a/b", "../a", "/tmp/a"})
    CHECK_THROWS_WITH_AS(write_file_in(open.descriptor, name, "x"),
                         doctest::Contains("no name of a file in a folder"), Error);
  CHECK_THROWS_AS(write_file_in(open.descriptor, std::string("a\0b", 3), "x"), Error);
  CHECK(open.folder.entries() == 0);
}

TEST_CASE("a file gets the permissions of the one that it is to be like, each time") {
  const OpenFolder open;
  write_file_in(open.descriptor, "model", "m");
  for (const mode_t mode : {mode_t{0600}, mode_t{0640}, mode_t{0604}, mode_t{0400}}) {
    REQUIRE(chmod((open / "model").c_str(), mode) == 0);
    if (fs::exists(open / "a")) REQUIRE(chmod((open / "a").c_str(), 0666) == 0);
    write_file_in(open.descriptor, "a", "text", "model");
    CHECK(open.mode_of("a") == mode);
  }
}

TEST_CASE("without a model, or where that is a link, it is for its owner alone") {
  const OpenFolder open;
  fs::create_symlink("/etc/passwd", open / "link");
  write_file_in(open.descriptor, "a", "text", "missing");
  write_file_in(open.descriptor, "b", "text", "link");
  CHECK(open.mode_of("a") == 0600);
  CHECK(open.mode_of("b") == 0600);
}
