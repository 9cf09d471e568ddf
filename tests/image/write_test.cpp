// These tests check what writing leaves behind, above all when it fails.
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include "core/base/whole_file.hpp"
#include "crt/error.hpp"
#include "crt/file.hpp"
#include "crt/image.hpp"
#include "picture_files.hpp"

using namespace crt;
using namespace crt::test;

namespace {

struct WriteError {
  ErrorCode code = ErrorCode::internal;
  std::string message;
};

WriteError write_error(const Image& image, const std::filesystem::path& path) {
  try {
    image.write(path);
    return {};
  } catch (const Error& error) {
    return {error.code(), error.what()};
  }
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a name without a known ending is unsupported, and the message lists the endings") {
  const TemporaryDirectory directory;
  for (const char* name : {"picture", "picture.", "picture.xyz", "png", ".png.gif"}) {
    const WriteError error = write_error(smooth_picture(2, 2), directory / name);
    CHECK(error.code == ErrorCode::unsupported);
    CHECK(contains(error.message, name));
    CHECK(contains(error.message, "png, tif"));
  }
  CHECK(directory.entries() == 0);
}

TEST_CASE("a name is checked before there is a picture, for channels too") {
  check_picture_name("a.png");
  check_picture_name("folder.jpg/a.exr", true);
  for (const auto& refused :
       {std::pair{"a.xyz", false}, std::pair{"png", false}, std::pair{"a.png", true}}) {
    const std::string name = refused.first;
    CAPTURE(name);
    try {
      check_picture_name(name, refused.second);
      FAIL("nothing was thrown");
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::unsupported);
      CHECK(contains(error.what(), "'" + name + "'"));
      CHECK(contains(error.what(), "exr"));
    }
  }
}

TEST_CASE("a picture without pixels cannot be written") {
  const TemporaryDirectory directory;
  CHECK(write_error(Image(), directory / "a.png").code == ErrorCode::invalid_argument);
  CHECK(directory.entries() == 0);
}

TEST_CASE("a directory as the target or none around it is an error that names the path") {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory / "a.png");
  WriteError error = write_error(smooth_picture(2, 2), directory / "a.png");
  CHECK(error.code == ErrorCode::io);
  CHECK(contains(error.message, (directory / "a.png").string()));
  CHECK(contains(error.message, "it is a folder"));

  error = write_error(smooth_picture(2, 2), directory / "missing/a.png");
  CHECK(error.code == ErrorCode::io);
  CHECK(contains(error.message, "there is no folder"));

  smooth_picture(2, 2).write(directory / "file.png");
  CHECK(write_error(smooth_picture(2, 2), directory / "file.png/a.png").code == ErrorCode::io);
  CHECK(directory.entries() == 2);
}

TEST_CASE("a write that fails half-way leaves the old file and nothing else") {
  const TemporaryDirectory directory;
  const Image old_picture = smooth_picture(4, 4);
  old_picture.write(directory / "a.ppm");
  const std::string old_file = file_text(directory / "a.ppm");

  // Files may not grow beyond 100 bytes, so that the next write gets that far and fails.
  rlimit limit{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &limit) == 0);
  const rlimit small = {100, limit.rlim_max};
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
  const WriteError error = write_error(smooth_picture(100, 100), directory / "a.ppm");
  REQUIRE(setrlimit(RLIMIT_FSIZE, &limit) == 0);
  std::signal(SIGXFSZ, old_handler);

  CHECK(error.code == ErrorCode::io);
  CHECK(contains(error.message, "a.ppm"));
  CHECK(file_text(directory / "a.ppm") == old_file);
  CHECK(directory.entries() == 1);
}

TEST_CASE(
    "writing replaces what was there, leaves no other file, and takes odd names and relative "
    "paths") {
  const TemporaryDirectory directory;
  const std::string name = "a %d {} '\"? \xc3\xa9\n.png";
  smooth_picture(9, 9).write(directory / name);
  smooth_picture(3, 5).write(directory / name);
  CHECK(Image::read(directory / name).height() == 5);
  CHECK(directory.entries() == 1);

  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(directory.path());
  smooth_picture(2, 2).write("here.png");
  std::filesystem::current_path(before);
  CHECK(Image::read(directory / "here.png").width() == 2);
  CHECK(directory.entries() == 2);
}

TEST_CASE("many threads may write at once, into one directory and to one file") {
  const TemporaryDirectory directory;
  std::vector<std::thread> threads;
  threads.reserve(4);
  for (int thread = 0; thread < 4; ++thread) {
    threads.emplace_back([&, thread] {
      for (int i = 0; i < 10; ++i) {
        smooth_picture(20 + thread, 20).write(directory / "same.png");
        smooth_picture(20 + thread, 20).write(directory / (std::to_string(thread) + ".exr"));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(Image::read(directory / "same.png").height() == 20);
  for (int thread = 0; thread < 4; ++thread) {
    CHECK(Image::read(directory / (std::to_string(thread) + ".exr")).width() == 20 + thread);
  }
  CHECK(directory.entries() == 5);
}

TEST_CASE("a part file that a killed program left is no obstacle") {
  const TemporaryDirectory directory;
  std::ofstream(directory / (".crt-" + std::to_string(getpid()) + "-0.part")) << "left over";
  core::write_whole_file(directory / "a.txt", to_bytes("content"), core::Flush::later);
  CHECK(file_text(directory / "a.txt") == "content");
  CHECK(directory.entries() == 2);
}
