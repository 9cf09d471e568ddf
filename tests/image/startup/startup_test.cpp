// A program pays nothing for image files that it does not use. This is a program of its own, as
// what was loaded once stays loaded.
#include <doctest/doctest.h>

#include <filesystem>
#include <iterator>
#include <string>

#include "core/image/module_loader.hpp"
#include "crt/file.hpp"
#include "crt/image.hpp"
#include "image/picture_files.hpp"

using namespace crt::test;

namespace {

bool is_loaded(const char* library) {
  return file_text("/proc/self/maps").find(library) != std::string::npos;
}

long threads() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
}

}  // namespace

TEST_CASE("OpenImageIO is loaded by the first file that needs it, and starts no threads") {
  crt::Image image = smooth_picture(300, 300, true);
  CHECK(image.to_rgba8().size() == 4 * 300 * 300);
  CHECK(image.encode("png").size() > 300);
  crt::check_picture_name("a.exr", true);
  CHECK_FALSE(is_loaded("libOpenImageIO"));
  CHECK_FALSE(is_loaded("libOpenEXR"));

  // Some builds of OpenImageIO come with a library that starts threads when it is loaded. Reading
  // and writing start no more.
  crt::core::image_files();
  const long threads_before = threads();

  const TemporaryDirectory directory;
  for (const char* name : {"a.exr", "a.png", "a.jpg"}) {
    image.write(directory / name);
    CHECK(crt::Image::read(directory / name).width() == 300);
  }
  CHECK(is_loaded("libOpenImageIO"));
  CHECK(is_loaded("crt_image_files.so"));
  CHECK(threads() == threads_before);
}
