// These tests write a mesh in each format and read it again.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>

#include "mesh_texts.hpp"
#include "support/temporary_directory.hpp"

using namespace crt;
using namespace crt::test;

namespace {

struct WrittenMesh {
  std::vector<Vec3> positions;
  std::vector<TriangleIndices> triangles;
};

/// Returns a mesh of doubles of all sizes, each vertex of which has a triangle. With `floats` they
/// are floats.
WrittenMesh some_mesh(bool floats) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> mantissa(-2, 2);
  std::uniform_int_distribution<int> exponent(floats ? -120 : -1000, floats ? 120 : 320);
  const auto coordinate = [&] {
    const double value = std::ldexp(mantissa(random), exponent(random));
    return floats ? static_cast<double>(static_cast<float>(value)) : value;
  };
  WrittenMesh mesh;
  for (int i = 0; i < 600; ++i) {
    const double x = coordinate();
    const double y = coordinate();
    mesh.positions.emplace_back(x, y, coordinate());
  }
  mesh.positions[5] = {0.1, 1.0 / 3, 1e-5};
  if (floats) mesh.positions[5] = {0.5, 0.1f, 3};
  mesh.positions[7] = {0, 1e100, std::numeric_limits<double>::denorm_min()};
  if (floats) mesh.positions[7] = {0, 1e30f, std::numeric_limits<float>::denorm_min()};
  for (std::uint32_t i = 0; i + 2 < 600; ++i) mesh.triangles.push_back({i, i + 1, i + 2});
  return mesh;
}

void check_equal(const MeshFile& file, const WrittenMesh& mesh, MeshFormat format) {
  CHECK(file.format == format);
  CHECK(file.positions == mesh.positions);
  CHECK(file.triangles == mesh.triangles);
  CHECK(file.dropped_triangles == 0);
}

std::string obj_text(const WrittenMesh& mesh) {
  std::string text;
  for (const Vec3& p : mesh.positions) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (const auto& [a, b, c] : mesh.triangles)
    text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
  return text;
}

std::string off_text(const WrittenMesh& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.positions.size(), mesh.triangles.size());
  for (const Vec3& p : mesh.positions) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  for (const auto& [a, b, c] : mesh.triangles) text += fmt::format("3 {} {} {}\n", a, b, c);
  return text;
}

std::string ply_header(const WrittenMesh& mesh, const char* format) {
  return fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
      "property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      format, mesh.positions.size(), mesh.triangles.size());
}

std::string ply_text(const WrittenMesh& mesh) {
  std::string text = ply_header(mesh, "ascii");
  for (const Vec3& p : mesh.positions) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  for (const auto& [a, b, c] : mesh.triangles) text += fmt::format("3 {} {} {}\n", a, b, c);
  return text;
}

std::string ply_binary(const WrittenMesh& mesh, std::endian order) {
  std::string bytes =
      ply_header(mesh, order == std::endian::little ? "binary_little_endian" : "binary_big_endian");
  for (const Vec3& p : mesh.positions)
    bytes += packed(p.x, order) + packed(p.y, order) + packed(p.z, order);
  for (const auto& [a, b, c] : mesh.triangles)
    bytes += '\3' + packed(a, order) + packed(b, order) + packed(c, order);
  return bytes;
}

std::string stl_text(const WrittenMesh& mesh) {
  std::string text = "solid some name\n";
  for (const TriangleIndices& triangle : mesh.triangles) {
    text += "  facet normal 0 0 1\n    outer loop\n";
    for (const std::uint32_t corner : triangle) {
      const Vec3& p = mesh.positions[corner];
      text += fmt::format("      vertex {} {} {}\n", p.x, p.y, p.z);
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid some name\n";
}

std::string stl_binary(const WrittenMesh& mesh) {
  std::string bytes = "solid as many programs begin it";
  bytes.resize(80, ' ');
  bytes += packed(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const TriangleIndices& triangle : mesh.triangles) {
    bytes += repeated(packed(0.0f), 3);
    for (const std::uint32_t corner : triangle) {
      for (int axis = 0; axis < 3; ++axis)
        bytes += packed(static_cast<float>(mesh.positions[corner][axis]));
    }
    bytes += packed(std::uint16_t{0});
  }
  return bytes;
}

std::string three_mf_file(const WrittenMesh& mesh) {
  std::string object = "<object id=\"1\" type=\"model\"><mesh><vertices>\n";
  for (const Vec3& p : mesh.positions)
    object += fmt::format("<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>\n", p.x, p.y, p.z);
  object += "</vertices><triangles>\n";
  for (const auto& [a, b, c] : mesh.triangles)
    object += fmt::format("<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/>\n", a, b, c);
  object += "</triangles></mesh></object>\n";
  return three_mf(model(object, "<item objectid=\"1\"/>\n"));
}

}  // namespace

TEST_CASE("what is written in each format is read again, with the same doubles") {
  const WrittenMesh mesh = some_mesh(false);
  check_equal(decode(obj_text(mesh)), mesh, MeshFormat::obj);
  check_equal(decode(off_text(mesh)), mesh, MeshFormat::off);
  check_equal(decode(ply_text(mesh)), mesh, MeshFormat::ply);
  check_equal(decode(ply_binary(mesh, std::endian::little)), mesh, MeshFormat::ply);
  check_equal(decode(ply_binary(mesh, std::endian::big)), mesh, MeshFormat::ply);
  check_equal(decode(stl_text(mesh)), mesh, MeshFormat::stl);
  check_equal(decode(three_mf_file(mesh)), mesh, MeshFormat::three_mf);
  const WrittenMesh floats = some_mesh(true);
  check_equal(decode(stl_binary(floats)), floats, MeshFormat::stl);
}

TEST_CASE("equal vertices are one, in the order of the file, and -0 is 0") {
  const MeshFile file = decode(
      "v 1 0 0\nv 0 0 0\nv 0 1 0\nv -0 -0.0 0\nv 0 0 1\nv 1 0 1e-300\n"
      "f 1 2 3\nf 4 5 6\nf 1 4 3\nf 2 4 3\nf 2 4 3 3\n");
  const std::vector<Vec3> positions = {{1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1e-300}};
  const std::vector<TriangleIndices> triangles = {{0, 1, 2}, {1, 3, 4}, {0, 1, 2}};
  CHECK(file.positions == positions);
  CHECK(file.triangles == triangles);
  CHECK(file.dropped_triangles == 2);
  CHECK_FALSE(std::signbit(file.positions[1].x));
}

TEST_CASE("a file is recognised by its content first and its ending second") {
  const WrittenMesh mesh = some_mesh(true);
  check_equal(decode(off_text(mesh), "mesh.obj"), mesh, MeshFormat::off);
  check_equal(decode(ply_text(mesh), "mesh.stl"), mesh, MeshFormat::ply);
  check_equal(decode(three_mf_file(mesh), "mesh.off"), mesh, MeshFormat::three_mf);
  check_equal(decode("\xef\xbb\xbf" + obj_text(mesh), "mesh.ply"), mesh, MeshFormat::obj);
  CHECK(decode_error("hello", "mesh.txt") == "it is no OBJ, PLY, STL, 3MF or OFF file");
  CHECK(decode_error("hello", "mesh.ObJ") ==
        "line 1: a line begins with 'hello', which is no statement of OBJ files");
  CHECK(decode_error("hello", "mesh.ply") == "line 1: it does not begin with a line 'ply'");
  CHECK(decode_error("hello", "mesh.off") == "line 1: it does not begin with the word OFF");
  CHECK(decode_error("hello", "mesh.stl").starts_with("it has 5 bytes; a binary STL file begins"));
  CHECK(decode_error("hello", "mesh.3mf").starts_with("it is a ZIP archive without its end"));
  CHECK(decode_error("", "mesh.obj") == "it is empty");
  CHECK_THROWS_AS(decode_mesh_file(bytes_of(obj_text(mesh)), "x", MeshFormat::ply), Error);
}

TEST_CASE("a mesh file is read from disk and becomes an entity") {
  const TemporaryDirectory folder;
  const auto path = folder / "one.off";
  std::ofstream(path) << "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  CHECK(read_mesh_file(path).triangles.size() == 1);
  CHECK_FALSE(load_mesh(path).is_empty());
  CHECK_THROWS_WITH_AS(read_mesh_file(folder / "none.off"),
                       doctest::Contains("No such file or directory"), Error);
  CHECK_THROWS_WITH_AS(load_mesh(bytes_of("v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3"), "flat.obj"),
                       doctest::Contains("flat.obj"), Error);
}
