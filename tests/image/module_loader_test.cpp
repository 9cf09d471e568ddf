#include "core/image/module_loader.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "crt/error.hpp"
#include "picture_files.hpp"

using namespace crt;
using namespace crt::core;
using namespace crt::test;

TEST_CASE("without the module the error is unsupported and tells every place it looked in") {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory / "broken");
  std::ofstream(directory / "broken/crt_image_files.so") << "not a library";
  const std::vector<std::filesystem::path> places = {directory / "empty", directory / "broken"};
  try {
    load_image_files(places);
    FAIL("nothing was thrown");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::unsupported);
    const std::string message = error.what();
    for (const std::filesystem::path& place : places) {
      CHECK(message.find((place / "crt_image_files.so").string()) != std::string::npos);
    }
    CHECK(message.find("not there") != std::string::npos);
  }
}

TEST_CASE("the module is looked for beside this program first, and found") {
  const auto directories = image_files_directories();
  const auto program = std::filesystem::canonical("/proc/self/exe").parent_path();
  REQUIRE(directories.size() >= 4);
  CHECK(directories[0] == program.parent_path() / "lib/crt");
  CHECK(std::all_of(directories.begin(), directories.end(),
                    [](const auto& path) { return path.is_absolute(); }));
  CHECK(load_image_files(directories).version == image_files_version);
  CHECK(&image_files() == &load_image_files(directories));
}
