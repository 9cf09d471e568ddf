// Manifests that somebody has changed are refused where nobody may follow them.
#include <doctest/doctest.h>

#include "farm/manifest.hpp"

using namespace crt;
using namespace crt::farm;

namespace {

Manifest small_manifest() {
  Manifest manifest{.script = "scene/a.crt", .max_steps = 1000, .width = 8, .height = 4};
  manifest.files["scene/a.crt"] = std::string(64, 'a');
  manifest.tasks = {{.seconds = 1, .pieces = {{0, {0, 0, 5, 4}}}},
                    {.seconds = 2, .pieces = {{0, {5, 0, 3, 4}}}}};
  return manifest;
}

bool is_refused(const Manifest& manifest) {
  try {
    parse_manifest(to_text(manifest));
    return false;
  } catch (const Error& error) {
    return error.code() == ErrorCode::io;
  }
}

bool is_refused(const std::string& text) {
  try {
    parse_manifest(text);
    return false;
  } catch (const Error& error) {
    return error.code() == ErrorCode::io;
  }
}

}  // namespace

TEST_CASE("a manifest is read as it was written") {
  Manifest manifest = small_manifest();
  manifest.seed = ~std::uint64_t{0};
  manifest.max_image_pixels = 12;
  manifest.variables = {{"n", "2 + 2"}};
  manifest.aovs = {.depth = true, .error = true};
  const Manifest read = parse_manifest(to_text(manifest));
  CHECK(to_text(read) == to_text(manifest));
  CHECK(read.seed == manifest.seed);
  CHECK(read.max_image_pixels == 12);
  CHECK(read.aovs == manifest.aovs);
}

TEST_CASE("a path that leads out of the job is refused") {
  for (const char* path : {"/etc/passwd", "../a.crt", "scene/../../a.crt", "", "a//b", "./a"}) {
    Manifest manifest = small_manifest();
    manifest.files[path] = std::string(64, 'b');
    CHECK_MESSAGE(is_refused(manifest), path);
    manifest = small_manifest();
    manifest.script = path;
    CHECK_MESSAGE(is_refused(manifest), path);
  }
  Manifest manifest = small_manifest();
  manifest.files["scene/b"] = "../../etc/passwd";
  CHECK(is_refused(manifest));
}

TEST_CASE("pieces that do not make the picture are refused") {
  Manifest manifest = small_manifest();
  manifest.tasks[1].pieces[0].region.width = 2;
  CHECK(is_refused(manifest));
  manifest.tasks[1].pieces[0].region.width = 4;
  CHECK(is_refused(manifest));
  manifest = small_manifest();
  manifest.tasks[1].pieces[0].frame = 1;
  CHECK(is_refused(manifest));
  manifest = small_manifest();
  manifest.width = 1 << 30;
  CHECK(is_refused(manifest));
}

TEST_CASE("what is no manifest is refused") {
  CHECK(is_refused(std::string()));
  CHECK(is_refused(std::string("{}")));
  CHECK(is_refused(std::string("[1, 2]")));
  CHECK(is_refused(std::string(1'000'000, '[')));
  const std::string text = to_text(small_manifest());
  for (std::size_t length = 0; length + 2 < text.size(); length += 7)
    CHECK(is_refused(text.substr(0, length)));
}
