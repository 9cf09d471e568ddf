// Surface meshes are written in each format, and read again by CRT's own readers.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "core/mesh_files/surface_writers.hpp"
#include "crt/surface_mesh.hpp"
#include "mesh_texts.hpp"
#include "support/temporary_directory.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Returns a tetrahedron whose corners are floats, moved along x.
SurfaceMesh tetrahedron(double x) {
  SurfaceMesh mesh;
  mesh.positions = {{x, 0, 0}, {x + 1, 0, 0}, {x, 1.25, 0}, {x, 0, -0.5}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  mesh.deviation = 0.125;
  return mesh;
}

/// Returns a fan of doubles that no float is.
SurfaceMesh fan() {
  SurfaceMesh mesh;
  mesh.positions.emplace_back(0.1, 1.0 / 3, 1e-5);
  for (std::uint32_t i = 0; i < 100; ++i) {
    mesh.positions.emplace_back(std::cos(0.06 * i), std::sin(0.06 * i), 1e-3 / (1 + i));
    if (i > 0) mesh.triangles.push_back({0, i, i + 1});
  }
  return mesh;
}

std::string encoded(std::span<const SurfaceMeshPart> parts, SurfaceMeshFormat format,
                    const SurfaceMeshFileOptions& options = {}) {
  const std::vector<std::byte> bytes = encode_surface_mesh(parts, format, options);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string encoded(const SurfaceMesh& mesh, SurfaceMeshFormat format,
                    const SurfaceMeshFileOptions& options = {}) {
  const SurfaceMeshPart part{.mesh = &mesh};
  return encoded(std::span(&part, 1), format, options);
}

void check_read(const std::string& bytes, MeshFormat format, const SurfaceMesh& mesh) {
  const MeshFile file = decode(bytes);
  CHECK(file.format == format);
  CHECK(file.positions == mesh.positions);
  CHECK(file.triangles == mesh.triangles);
  CHECK(file.dropped_triangles == 0);
  CHECK(file.warnings.empty());
}

bool has(const std::string& bytes, const std::string& piece) {
  return bytes.find(piece) != std::string::npos;
}

template <class Number>
Number number_of(const std::string& bytes, std::size_t place) {
  REQUIRE(place + sizeof(Number) <= bytes.size());
  Number number;
  std::memcpy(&number, bytes.data() + place, sizeof number);
  return number;
}

/// Returns the code of the Error that a call throws.
ErrorCode code_of(const auto& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.code();
  }
  FAIL("there is no error");
  return ErrorCode::io;
}

constexpr std::array all_formats = {SurfaceMeshFormat::stl, SurfaceMeshFormat::obj,
                                    SurfaceMeshFormat::ply, SurfaceMeshFormat::three_mf,
                                    SurfaceMeshFormat::glb};

}  // namespace

TEST_CASE("surfaces are read again as they were written, to the bit where the format has doubles") {
  for (const SurfaceMesh& mesh : {fan(), tetrahedron(0)}) {
    check_read(encoded(mesh, SurfaceMeshFormat::obj), MeshFormat::obj, mesh);
    check_read(encoded(mesh, SurfaceMeshFormat::ply), MeshFormat::ply, mesh);
    check_read(encoded(mesh, SurfaceMeshFormat::three_mf), MeshFormat::three_mf, mesh);
  }
  check_read(encoded(tetrahedron(3), SurfaceMeshFormat::stl), MeshFormat::stl, tetrahedron(3));
  // Of others STL has the nearest floats.
  const MeshFile rounded = decode(encoded(fan(), SurfaceMeshFormat::stl));
  REQUIRE(rounded.triangles == fan().triangles);
  for (std::size_t i = 0; i < rounded.positions.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      CHECK(rounded.positions[i][axis] ==
            static_cast<double>(static_cast<float>(fan().positions[i][axis])));
}

TEST_CASE("normals of STL point out of what its triangles enclose") {
  const std::string bytes = encoded(tetrahedron(0), SurfaceMeshFormat::stl);
  REQUIRE(bytes.size() == 84 + 4 * 50);
  CHECK(!bytes.starts_with("solid"));
  CHECK(has(bytes.substr(0, 80), "deviation at most 0.125"));
  CHECK(number_of<std::uint32_t>(bytes, 80) == 4);
  CHECK(number_of<float>(bytes, 84) == 0);
  CHECK(number_of<float>(bytes, 88) == 0);
  CHECK(number_of<float>(bytes, 92) == 1);
}

TEST_CASE("several parts are in one file, with names, colours and the unit where it has them") {
  const SurfaceMesh first = tetrahedron(0);
  const SurfaceMesh second = tetrahedron(5);
  const SurfaceMesh none;
  const std::vector<SurfaceMeshPart> parts = {
      {.mesh = &first, .name = "a \"lid\" & <more>\n", .color = Color{1, 0.5, 0}},
      {.mesh = &none, .name = "nothing"},
      {.mesh = &second, .name = "base\\", .color = {}}};
  SurfaceMesh both = first;
  both.positions.insert(both.positions.end(), second.positions.begin(), second.positions.end());
  for (const auto& [a, b, c] : second.triangles) both.triangles.push_back({a + 4, b + 4, c + 4});
  const SurfaceMeshFileOptions options{.unit = Unit::mm};
  check_read(encoded(parts, SurfaceMeshFormat::stl, options), MeshFormat::stl, both);
  check_read(encoded(parts, SurfaceMeshFormat::three_mf, options), MeshFormat::three_mf, both);
  const std::string obj = encoded(parts, SurfaceMeshFormat::obj, options);
  check_read(obj, MeshFormat::obj, both);
  CHECK(has(obj, "\no a_\"lid\"_&_<more>_\n"));
  CHECK(has(obj, "\no base_\n"));
  CHECK(has(obj, "unit: mm"));
  CHECK(!has(obj, "nothing"));
  const std::string ply = encoded(parts, SurfaceMeshFormat::ply, options);
  check_read(ply, MeshFormat::ply, both);
  CHECK(has(ply, "property uchar red"));
  // Half of the light is 188 of 255 in sRGB.
  CHECK(has(ply, "\xff\xbc" + std::string(1, '\0')));
  CHECK(!has(encoded(first, SurfaceMeshFormat::ply), "red"));
}

TEST_CASE("a glTF file has its chunks, and positions in metres within the bounds that it says") {
  const SurfaceMesh mesh = tetrahedron(2);
  const std::string bytes =
      encoded(mesh, SurfaceMeshFormat::glb,
              {.unit = Unit::cm, .color = Color{0.25, 0.5, 1, 0.5}, .name = "a \"b\" \\c"});
  CHECK(bytes.starts_with("glTF"));
  CHECK(number_of<std::uint32_t>(bytes, 4) == 2);
  CHECK(number_of<std::uint32_t>(bytes, 8) == bytes.size());
  const auto json_size = number_of<std::uint32_t>(bytes, 12);
  CHECK(json_size % 4 == 0);
  CHECK(bytes.substr(16, 4) == "JSON");
  const std::string json = bytes.substr(20, json_size);
  CHECK(has(json, R"("baseColorFactor":[0.25,0.5,1,0.5])"));
  CHECK(has(json, R"("alphaMode":"BLEND")"));
  CHECK(has(json, R"("name":"a \"b\" \\c")"));
  CHECK(has(json, R"("extras":{"deviation":0.00125})"));
  CHECK(has(json, R"("min":[0.02,0,-0.005],"max":[0.03,0.0125,0])"));
  const std::size_t chunk = 20 + json_size;
  CHECK(number_of<std::uint32_t>(bytes, chunk) == 4 * 12 + 4 * 12);
  CHECK(bytes.substr(chunk + 4, 4) == std::string("BIN\0", 4));
  CHECK(bytes.size() == chunk + 8 + 96);
  CHECK(number_of<float>(bytes, chunk + 8 + 12) == 0.03f);
  CHECK(number_of<std::uint32_t>(bytes, chunk + 8 + 48 + 8) == 2);
}

TEST_CASE("a file says its deviation where one is proved, and none else") {
  SurfaceMesh mesh = tetrahedron(0);
  CHECK(has(encoded(mesh, SurfaceMeshFormat::obj), "deviation at most 0.125"));
  mesh.deviation = std::numeric_limits<double>::infinity();
  for (const SurfaceMeshFormat format : all_formats)
    CHECK(!has(encoded(mesh, format), "deviation"));
}

TEST_CASE("what no file can have is refused, with what is wrong") {
  SurfaceMesh broken = tetrahedron(0);
  broken.triangles[2][1] = 4;
  SurfaceMesh infinite = tetrahedron(0);
  infinite.positions[1].y = std::numeric_limits<double>::infinity();
  SurfaceMesh unknown = tetrahedron(0);
  unknown.positions[3].z = std::numeric_limits<double>::quiet_NaN();
  const SurfaceMesh none;
  for (const SurfaceMeshFormat format : all_formats) {
    for (const SurfaceMesh& mesh : {broken, infinite, unknown, none})
      CHECK(code_of([&] { encoded(mesh, format); }) == ErrorCode::invalid_argument);
    const SurfaceMesh good = tetrahedron(0);
    CHECK(code_of([&] {
            encoded(good, format, {.color = Color{2, 0, 0}});
          }) == ErrorCode::invalid_argument);
    const SurfaceMeshPart no_mesh;
    CHECK(code_of([&] { encoded(std::span(&no_mesh, 1), format); }) == ErrorCode::invalid_argument);
    CHECK(code_of([&] { encode_surface_mesh({}, format); }) == ErrorCode::invalid_argument);
  }
  CHECK_THROWS_WITH_AS(encoded(broken, SurfaceMeshFormat::stl),
                       doctest::Contains("triangle 2 of a mesh has a corner"), Error);
  // Doubles go farther than floats.
  SurfaceMesh large = tetrahedron(0);
  large.positions[0].x = 1e39;
  CHECK(!encoded(large, SurfaceMeshFormat::ply).empty());
  CHECK(code_of([&] { encoded(large, SurfaceMeshFormat::stl); }) == ErrorCode::invalid_argument);
  CHECK(code_of([&] { encoded(large, SurfaceMeshFormat::glb); }) == ErrorCode::invalid_argument);
}

TEST_CASE("more than 32 bits count is an error before anything is made") {
  constexpr std::uint64_t many = std::uint64_t{1} << 32U;
  for (const SurfaceMeshFormat format : all_formats) {
    CHECK_NOTHROW(core::check_room(format, {.positions = 1000, .triangles = 2000, .parts = 1}));
    CHECK(code_of([&] {
            core::check_room(format, {.positions = 3, .triangles = many, .parts = 1});
          }) == ErrorCode::limit);
    CHECK(code_of([&] {
            core::check_room(format, {.positions = many, .triangles = 1, .parts = 1});
          }) == ErrorCode::limit);
  }
  CHECK(code_of([&] {
          core::check_room(SurfaceMeshFormat::glb,
                           {.positions = many / 24, .triangles = many / 20, .parts = 1});
        }) == ErrorCode::limit);
  CHECK_NOTHROW(core::check_bytes("3MF", many - 1));
  CHECK(code_of([&] { core::check_bytes("3MF", many); }) == ErrorCode::limit);
}

TEST_CASE("the ending of a name says the format, and a file is written whole or not at all") {
  const TemporaryDirectory folder;
  const SurfaceMesh mesh = tetrahedron(0);
  for (const char* const name : {"a.stl", "a.OBJ", "a.ply", "a.3mf"}) {
    write_surface_mesh(folder / name, mesh);
    CHECK(read_mesh_file(folder / name).triangles == mesh.triangles);
  }
  write_surface_mesh(folder / "a.glb", mesh);
  CHECK(std::filesystem::file_size(folder / "a.glb") % 4 == 0);
  CHECK_THROWS_WITH_AS(write_surface_mesh(folder / "a.step", mesh), doctest::Contains(".3mf"),
                       Error);
  CHECK(code_of([&] { write_surface_mesh(folder / "a", mesh); }) == ErrorCode::unsupported);
  CHECK(code_of([&] { write_surface_mesh(folder / "none" / "a.stl", mesh); }) == ErrorCode::io);
  std::ofstream(folder / "kept.stl") << "as it was";
  CHECK_THROWS_AS(write_surface_mesh(folder / "kept.stl", SurfaceMesh{}), Error);
  std::ifstream kept(folder / "kept.stl");
  CHECK(std::string(std::istreambuf_iterator<char>(kept), {}) == "as it was");
}
