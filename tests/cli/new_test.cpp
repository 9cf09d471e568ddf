// These tests check `crt new`, which writes a script to begin with.
#include <doctest/doctest.h>

#include <string>

#include "cli/command.hpp"

using namespace crt::test;

namespace {

constexpr int files = 3;  // what the command ends with

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("what crt new writes is a script without a warning, that renders") {
  const TemporaryFolder folder;
  const Outcome made = run_crt(folder, {"new", "first.crt"});
  CHECK(made.exit_code == 0);
  CHECK(made.err.empty());
  CHECK(contains(made.out, "crt render first.crt"));
  const std::string text = folder.read("first.crt");
  for (const char* part :
       {"-- ", "camera -> ", "lights -> ", "Plane {", " - ", "^", "crt render first.crt"})
    CHECK_MESSAGE(contains(text, part), part);
  const Outcome check = run_crt(folder, {"check", "first.crt"});
  CHECK(check.exit_code == 0);
  CHECK(check.err.empty());
  CHECK(run_crt(folder, {"format", "--check", "first.crt"}).exit_code == 0);
  const Outcome render =
      run_crt(folder, {"render", "first.crt", "--width", "32", "--height", "24", "-q"});
  CHECK(render.exit_code == 0);
  CHECK(render.err.empty());
  CHECK(folder.has("first.png"));
}

TEST_CASE("crt new never writes over what is there") {
  const TemporaryFolder folder;
  folder.write("mine.crt", "Scene { }");
  std::filesystem::create_symlink("nowhere", folder.path() / "link.crt");
  std::filesystem::create_directory(folder.path() / "folder.crt");
  for (const char* name : {"mine.crt", "mine", "link.crt", "folder.crt"}) {
    CAPTURE(name);
    const Outcome run = run_crt(folder, {"new", name});
    CHECK(run.exit_code == files);
    CHECK(contains(run.err, "it exists, and is left as it is"));
  }
  CHECK(folder.read("mine.crt") == "Scene { }");
  CHECK_FALSE(folder.has("nowhere"));
}

TEST_CASE("crt new says why it could not write, and needs a name") {
  const TemporaryFolder folder;
  const Outcome run = run_crt(folder, {"new", "no/such/folder.crt"});
  CHECK(run.exit_code == files);
  CHECK(contains(run.err, "No such file or directory"));
  CHECK(run_crt(folder, {"new"}).exit_code == 2);
  CHECK(folder.names().empty());
}

TEST_CASE("crt new gives a name its ending, and is quiet if asked") {
  const TemporaryFolder folder;
  const Outcome run = run_crt(folder, {"new", "scene", "-q"});
  CHECK(run.exit_code == 0);
  CHECK(run.out.empty());
  CHECK(folder.has("scene.crt"));
}
