// All pictures of a script together have a limit, which their files' headers are compared with.
#include <doctest/doctest.h>

#include <map>
#include <string>

#include "crt/image.hpp"
#include "run.hpp"

namespace {

using crt::ErrorCode;
using crt::ScriptOptions;
using crt::test::Run;
using crt::test::run_statements;

using Bytes = std::vector<std::byte>;

Bytes to_bytes(std::string_view text) {
  const auto* const first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

crt::Image grey(int width, int height) {
  crt::Image image(width, height);
  for (float& value : image.pixels()) value = 0.5f;
  return image;
}

/// Returns options by which a script finds two pictures of 10 x 10 pixels, and a mesh with a third.
ScriptOptions with_pixels(std::uint64_t most) {
  std::map<std::string, Bytes> files;
  for (const char* name : {"a.png", "b.png", "c.png"}) files[name] = grey(10, 10).encode("png");
  files["short.png"] = files["a.png"];
  // The header still says 10 x 10.
  files["short.png"].resize(files["short.png"].size() - 20);
  files["mesh.obj"] = to_bytes(
      "mtllib mesh.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl m\n"
      "f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
  files["mesh.mtl"] = to_bytes("newmtl m\nmap_Kd c.png\n");
  ScriptOptions options;
  options.limits.image_pixels = most;
  options.open_file = [files](const std::filesystem::path& path) -> std::optional<Bytes> {
    const auto found = files.find(path.string());
    return found == files.end() ? std::nullopt : std::optional(found->second);
  };
  return options;
}

bool passes_limit(const std::string& statements, std::uint64_t most) {
  const Run run = run_statements(statements, with_pixels(most));
  if (!run.failed_with(ErrorCode::limit)) return false;
  const std::string message = run.errors()[0].message;
  INFO(message);
  CHECK(message.find(std::to_string(most) + " pixels together") != std::string::npos);
  return true;
}

bool runs(const std::string& statements, std::uint64_t most) {
  return run_statements(statements, with_pixels(most)).ok();
}

std::string map_of(const std::string& file) {
  return "m_" + file.substr(0, 1) + " = Material { color -> ImageMap { image -> \"" + file +
         "\" } }\n";
}

std::string field_of(const std::string& attribute) {
  return "h = HeightField { " + attribute +
         " cornerA -> vec3(0, 0, 0) cornerB -> vec3(1, 1, 1) }\n";
}

const std::string mesh = "mesh = Mesh { file -> \"mesh.obj\" }\n";

}  // namespace

TEST_CASE("pictures of a script have a limit together, and each file counts once") {
  CHECK(runs(map_of("a.png") + map_of("b.png"), 200));
  CHECK(passes_limit(map_of("a.png") + map_of("b.png"), 199));
  CHECK(passes_limit(map_of("a.png"), 99));
  CHECK(runs(map_of("a.png") + map_of("a.png"), 100));
}

TEST_CASE("a picture beyond the limit is refused before it is decoded") {
  CHECK(passes_limit(map_of("short.png"), 99));
  CHECK(run_statements(map_of("short.png"), with_pixels(100)).failed_with(ErrorCode::io));
}

TEST_CASE("heights count like pixels, from a file as from lists") {
  CHECK(runs(field_of("image -> \"a.png\""), 100));
  CHECK(passes_limit(field_of("image -> \"a.png\""), 99));
  const std::string row = "row = range(0, 1, 0.1)\n";
  CHECK(runs(row + field_of("heights -> [row, row, row]"), 30));
  CHECK(passes_limit(row + field_of("heights -> [row, row, row]"), 29));
  CHECK(passes_limit(row + "for (i in range(4)) {" + field_of("heights -> [row, row, row]") + "}",
                     119));
}

TEST_CASE("pictures of meshes count with those of the script") {
  CHECK(runs(mesh + map_of("a.png"), 200));
  CHECK(passes_limit(mesh + map_of("a.png"), 199));
  CHECK(passes_limit(map_of("a.png") + mesh, 199));
  CHECK(runs(mesh + map_of("c.png"), 100));
}

TEST_CASE("a mesh that a program loads has the limit of its options") {
  CHECK_NOTHROW(crt::load_mesh("mesh.obj", with_pixels(100)));
  CHECK_THROWS_AS(crt::load_mesh("mesh.obj", with_pixels(99)), crt::Error);
}
