// Surfaces of solids as triangles through the C interface, and files of them.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "support.hpp"
#include "support/temporary_directory.hpp"

using namespace crt::test;

namespace {

struct ReleaseSurface {
  void operator()(crt_surface_mesh* mesh) const { crt_surface_mesh_release(mesh); }
};
using SurfaceHandle = std::unique_ptr<crt_surface_mesh, ReleaseSurface>;

SurfaceHandle surface_of(crt_entity* entity, double deviation) {
  crt_surface_mesh* mesh = nullptr;
  REQUIRE(crt_entity_tessellate(entity, deviation, &mesh) == CRT_OK);
  return SurfaceHandle(mesh);
}

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

/// Returns the volume that triangles enclose, by their corners.
double enclosed_volume(const crt_surface_mesh* mesh) {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  const double* const positions = crt_surface_mesh_positions(mesh, &vertices);
  const std::uint32_t* const indices = crt_surface_mesh_indices(mesh, &triangles);
  double six_volumes = 0;
  for (std::size_t i = 0; i < triangles; ++i) {
    const double* const a = positions + 3 * std::size_t{indices[3 * i]};
    const double* const b = positions + 3 * std::size_t{indices[3 * i + 1]};
    const double* const c = positions + 3 * std::size_t{indices[3 * i + 2]};
    for (int axis = 0; axis < 3; ++axis) REQUIRE(indices[3 * i + axis] < vertices);
    six_volumes += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                   a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return six_volumes / 6;
}

}  // namespace

TEST_CASE("triangles of a ball enclose it as nearly as was asked") {
  const EntityHandle ball = sphere({1, 2, 3}, 2);
  const SurfaceHandle surface = surface_of(ball.get(), 0.05);
  CHECK(crt_surface_mesh_deviation(surface.get()) <= 0.05);
  const double volume = enclosed_volume(surface.get());
  CHECK(volume == doctest::Approx(33.51).epsilon(0.08));
  CHECK(volume > 0);
}

TEST_CASE("what the mesh lends is there as long as a reference is") {
  const EntityHandle plate = box({0, 0, 0}, {1, 2, 3});
  const SurfaceHandle surface = surface_of(plate.get(), 0.1);
  crt_surface_mesh* const kept = crt_surface_mesh_retain(surface.get());
  CHECK(kept == surface.get());
  CHECK(enclosed_volume(kept) == doctest::Approx(6));
  crt_surface_mesh_release(kept);
  CHECK(enclosed_volume(surface.get()) == doctest::Approx(6));
  std::size_t count = 7;
  CHECK(crt_surface_mesh_positions(nullptr, &count) == nullptr);
  CHECK(count == 0);
  CHECK(crt_surface_mesh_indices(nullptr, nullptr) == nullptr);
  CHECK(crt_surface_mesh_deviation(nullptr) == infinity);
  crt_surface_mesh_release(nullptr);
}

TEST_CASE("a surface is written in each format, and read again as the same solid") {
  const crt::test::TemporaryDirectory folder;
  const EntityHandle plate = box({0, 0, 0}, {1, 2, 3});
  const SurfaceHandle surface = surface_of(plate.get(), 0.1);
  for (const char* const name : {"a.stl", "a.obj", "a.ply", "a.3mf"}) {
    CAPTURE(name);
    const std::string path = (folder / name).string();
    REQUIRE(crt_surface_mesh_write(surface.get(), path.c_str()) == CRT_OK);
    const EntityHandle read = made<EntityHandle>(
        [&](crt_entity** out) { return crt_mesh_load(path.c_str(), nullptr, out); });
    CHECK(crt_entity_is_solid(read.get()) != 0);
    crt_interval volume;
    REQUIRE(crt_entity_volume(read.get(), 1e-6, 0, &volume) == CRT_OK);
    CHECK(volume.lower == doctest::Approx(6));
  }
  CHECK(crt_surface_mesh_write(surface.get(), (folder / "a.glb").c_str()) == CRT_OK);
  CHECK(crt_surface_mesh_write(surface.get(), (folder / "a.step").c_str()) ==
        CRT_ERROR_UNSUPPORTED);
  CHECK(crt_surface_mesh_write(surface.get(), "/nowhere/a.stl") == CRT_ERROR_IO);
}

TEST_CASE("parts have names and colours, and the unit is that of the file") {
  const crt::test::TemporaryDirectory folder;
  const EntityHandle plate = box({0, 0, 0}, {1, 2, 3});
  const SurfaceHandle surface = surface_of(plate.get(), 0.1);
  const crt_surface_mesh* const parts[2] = {surface.get(), surface.get()};
  const char* const names[2] = {"lid", nullptr};
  const double colors[8] = {1, 0.5, 0, 1, 0, 0, 1, 1};
  const std::string path = (folder / "a.glb").string();
  REQUIRE(crt_surface_meshes_write(parts, 2, names, colors, CRT_UNIT_MM, path.c_str()) == CRT_OK);
  const std::string content = content_of(path);
  CHECK(content.find("\"name\":\"lid\"") != std::string::npos);
  CHECK(content.find("\"name\":\"part 2\"") != std::string::npos);
  CHECK(content.find("\"baseColorFactor\":[1,0.5,0,1]") != std::string::npos);
  CHECK(content.find("\"max\":[0.001,0.002,0.003]") != std::string::npos);
  const double wrong[4] = {2, 0, 0, 1};
  CHECK(crt_surface_meshes_write(parts, 1, nullptr, wrong, CRT_UNIT_MM, path.c_str()) ==
        CRT_ERROR_INVALID_ARGUMENT);
  CHECK(crt_surface_meshes_write(parts, 1, nullptr, nullptr, 4, path.c_str()) ==
        CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("unit"));
  CHECK(content_of(path) == content);
}

TEST_CASE("what has no surface to be made of is refused") {
  crt_surface_mesh* mesh = nullptr;
  const EntityHandle ball = sphere({0, 0, 0}, 1);
  for (const double wrong : {0.0, -1.0, not_a_number})
    CHECK(crt_entity_tessellate(ball.get(), wrong, &mesh) == CRT_ERROR_INVALID_ARGUMENT);
  const EntityHandle half = made<EntityHandle>([](crt_entity** out) {
    return crt_plane_create(Numbers{0, 1, 0}.data(), Numbers{0, 3, 0}.data(), out);
  });
  CHECK(crt_entity_tessellate(half.get(), 0.1, &mesh) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(mesh == nullptr);
}
