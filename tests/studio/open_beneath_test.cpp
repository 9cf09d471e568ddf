// These tests open paths beneath a folder that lead out of it, by the kernel's help and without.
#include "studio/open_beneath.hpp"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <string>

#include "support/temporary_directory.hpp"

using namespace crt::studio;
using crt::test::TemporaryDirectory;

namespace {

namespace fs = std::filesystem;

std::string read_all(const FileHandle& file) {
  std::array<char, 64> text{};
  const ssize_t count = read(file.get(), text.data(), text.size());
  return count < 0 ? "failed" : std::string(text.data(), static_cast<std::size_t>(count));
}

}  // namespace

TEST_CASE("what lies beneath a folder is opened, and nothing to which a link or '..' leads") {
  const TemporaryDirectory parent;
  fs::create_directories(parent / "opened/in/deep");
  std::ofstream(parent / "secret") << "secret";
  std::ofstream(parent / "opened/a") << "a";
  std::ofstream(parent / "opened/in/deep/b") << "b";
  fs::create_symlink(parent / "secret", parent / "opened/link");
  fs::create_symlink("a", parent / "opened/inner_link");
  fs::create_directory_symlink(parent.path(), parent / "opened/up");
  fs::create_directory_symlink("in", parent / "opened/other_in");
  const FileHandle folder(open((parent / "opened").c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  for (const auto beneath : {open_beneath, walk_beneath}) {
    CHECK(read_all(beneath(folder.get(), "a", O_RDONLY)) == "a");
    CHECK(read_all(beneath(folder.get(), "in/deep/b", O_RDONLY)) == "b");
    CHECK(beneath(folder.get(), ".", O_PATH | O_DIRECTORY).is_open());
    CHECK(beneath(folder.get(), "in/deep", O_PATH | O_DIRECTORY).is_open());
    for (const char* path :
         {"link", "inner_link", "up", "up/secret", "up/opened/a", "other_in", "other_in/deep/b",
          "../secret", "in/../../secret", "/etc/passwd", "missing", "missing/b", "a/b", ""}) {
      CAPTURE(path);
      errno = 0;
      CHECK(!beneath(folder.get(), path, O_RDONLY).is_open());
      CHECK(errno != 0);
    }
    CHECK(!beneath(folder.get(), "up", O_PATH | O_DIRECTORY).is_open());
  }
}

TEST_CASE("a handle closes its file once") {
  int descriptor = -1;
  {
    FileHandle first(open("/", O_PATH | O_CLOEXEC));
    descriptor = first.get();
    FileHandle second(std::move(first));
    CHECK(second.get() == descriptor);
    CHECK(fcntl(descriptor, F_GETFD) >= 0);
  }
  CHECK(fcntl(descriptor, F_GETFD) == -1);
}
