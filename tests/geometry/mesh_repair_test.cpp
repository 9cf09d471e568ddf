// Meshes are put right before they are made: near vertices become one, and T-junctions are closed.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/geometry/mesh/repair.hpp"
#include "core/geometry/mesh/triangles.hpp"
#include "core/math/vector.hpp"
#include "crt/error.hpp"
#include "crt/mesh.hpp"
#include "crt/prepared_scene.hpp"
#include "crt/query.hpp"
#include "crt/scene.hpp"
#include "geometry/cuboids.hpp"
#include "geometry/meshes.hpp"

using namespace crt;
using namespace crt::test;

namespace {

bool is_solid(const TriangleList& list, const MeshOptions& options) {
  return triangle_mesh(list.positions, list.triangles, {}, options).is_solid();
}

/// Returns triangles whose corners are their own, each moved by up to `shift`.
TriangleList shaken(Random& random, const TriangleList& list, double shift) {
  TriangleList result;
  for (const TriangleIndices& triangle : list.triangles) {
    const auto first = static_cast<std::uint32_t>(result.positions.size());
    for (const std::uint32_t corner : triangle)
      result.positions.push_back(list.positions[corner] + shift * random.in_cube());
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

/// Returns a cube from 0 to 1 whose sides are cut into different numbers of strips, so that their
/// edges have T-junctions. The points there are moved by up to `shift`.
TriangleList strips(Random& random, double shift) {
  TriangleList list;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {0, 1}) {
      const int count = 1 + static_cast<int>(random.bits() % 4);
      for (int i = 0; i < count; ++i) {
        const auto at = [&](double along, double across) {
          Vec3 corner(0.0);
          corner[axis] = side;
          corner[(axis + (side == 1 ? 1 : 2)) % 3] = along;
          corner[(axis + (side == 1 ? 2 : 1)) % 3] = across;
          const bool is_corner = along == 0 || along == 1;
          return is_corner ? corner : corner + shift * random.in_cube();
        };
        const double begin = static_cast<double>(i) / count;
        const double end = static_cast<double>(i + 1) / count;
        list.add_quad(at(begin, 0), at(end, 0), at(end, 1), at(begin, 1));
      }
    }
  }
  return list;
}

}  // namespace

TEST_CASE("weld makes one of vertices within the tolerance, and of no others") {
  Random random(31);
  for (int round = 0; round < 40; ++round) {
    const TriangleList ball = ball_mesh(random, 4, 0.1);
    const double shift = random.power_of_ten(-12, -4);
    const TriangleList loose = shaken(random, ball, shift);
    CHECK_FALSE(loose.entity().is_solid());
    // Corners of one vertex are at most 2 sqrt(3) shifts apart.
    CHECK(is_solid(loose, {.weld = 4 * shift}));
    CHECK_FALSE(is_solid(loose, {.weld = 0.01 * shift}));
    const MeshReport report = report_of(loose, {.weld = 4 * shift});
    CHECK(report.welded_vertices == loose.positions.size() - ball.positions.size());
    CHECK(report.welded_triangles == 0);
    REQUIRE(report.warnings.size() == 1);
    CHECK(report.warnings[0].starts_with("weld has made "));
  }
  TriangleList sliver = ball_mesh(random, 2, 0);
  sliver.add_quad({5, 0, 0}, {5, 1e-9, 0}, {6, 0, 0}, {6, 1, 0});
  CHECK(report_of(sliver, {.weld = 1e-6}).welded_triangles == 1);
}

TEST_CASE("no vertex is welded farther than the tolerance, and none that is left is as near") {
  Random random(32);
  for (int round = 0; round < 60; ++round) {
    std::vector<Vec3> places;
    const double size = random.power_of_ten(-20, 20);
    const Vec3 middle = (random.one_in(2) ? 0 : 100) * size * random.in_cube();
    for (int i = 0; i < 300; ++i) places.push_back(middle + size * random.in_cube());
    for (int i = 0; i < 30; ++i) places.push_back(places[random.bits() % places.size()]);
    const double tolerance = size * random.power_of_ten(-3, 0.5);
    const std::vector<std::uint32_t> first = core::first_within(places, tolerance);
    const auto distance = [&](std::size_t a, std::size_t b) {
      const Vec3 offset = (places[a] - places[b]) / size;
      return std::sqrt(offset.x * offset.x + offset.y * offset.y + offset.z * offset.z) * size;
    };
    for (std::size_t i = 0; i < places.size(); ++i) {
      REQUIRE(first[i] <= i);
      REQUIRE(first[first[i]] == first[i]);
      REQUIRE(distance(i, first[i]) <= tolerance * (1 + 1e-9));
      for (std::size_t k = 0; k < i; ++k) {
        if (first[k] != k) continue;
        if (first[i] == i) REQUIRE(distance(i, k) > tolerance * (1 - 1e-9));
        if (k < first[i]) REQUIRE(distance(i, k) > tolerance * (1 - 1e-9));
      }
    }
  }
}

TEST_CASE("stitch closes T-junctions, and moves nothing") {
  Random random(33);
  int divided = 0;
  for (int round = 0; round < 60; ++round) {
    const double shift = round % 2 == 0 ? 0 : 1e-9;
    const TriangleList cube = strips(random, shift);
    MeshOptions options{.weld = round % 2 == 0 ? 0 : 1e-8, .stitch = 1e-7};
    const auto mesh = mesh_triangles(cube.positions, cube.triangles, {}, options);
    REQUIRE(mesh->is_closed());
    REQUIRE(mesh->is_oriented());
    const MeshReport& report = mesh_report(*mesh);
    divided += static_cast<int>(report.stitched_vertices);
    CHECK(mesh->size() == cube.triangles.size() + report.stitched_vertices);
    CHECK(report.warnings.back() ==
          "stitch has put " + std::to_string(report.stitched_vertices) + " vertices into edges");
    Scene scene;
    scene.entities = {Entity(Mesh{.triangles = mesh})};
    const PreparedScene prepared = prepare(scene);
    for (int i = 0; i < 20; ++i) {
      const Vec3 aim{random.uniform(0.01, 0.99), random.uniform(0.01, 0.99), -1};
      const std::vector<Hit> hits = crossings(prepared, {.origin = aim, .direction = {0, 0, 1}});
      REQUIRE(hits.size() == 2);
      CHECK(hits[0].t == doctest::Approx(1).epsilon(1e-8));
      CHECK(hits[1].t == doctest::Approx(2).epsilon(1e-8));
    }
  }
  CHECK(divided > 300);
}

TEST_CASE("what is divided off has the attributes in between") {
  // Two triangles above an edge from (0, 0, 0) to (4, 0, 0), and one below.
  TriangleList list;
  list.positions = {{0, 0, 0}, {4, 0, 0}, {1, 0, 0}, {2, 3, 0}, {2, -3, 0}};
  list.triangles = {{0, 2, 3}, {2, 1, 3}, {1, 0, 4}};
  MeshAttributes attributes;
  attributes.uv = {{0, 0}, {4, 8}, {1, 2}, {2, 3}, {2, -3}};
  attributes.normals = {{0, 0, 1}, {0, 1, 0}, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}};
  attributes.materials = {SharedMaterial(Material{}),
                          SharedMaterial(Material{.reflectivity = 0.5})};
  attributes.material_of_triangle = {0, 0, 1};
  core::RepairedMesh mesh{
      .positions = list.positions, .triangles = list.triangles, .attributes = attributes};
  mesh.attributes.normal_indices = mesh.attributes.uv_indices = list.triangles;
  CHECK(core::stitch(mesh, 1e-9) == 1);
  // The part towards the begin of the edge stays, and the other one is appended.
  REQUIRE(mesh.triangles.size() == 4);
  CHECK(mesh.triangles[2] == TriangleIndices{1, 2, 4});
  CHECK(mesh.triangles[3] == TriangleIndices{2, 0, 4});
  CHECK(mesh.attributes.material_of_triangle == std::vector<std::uint32_t>{0, 0, 1, 1});
  const std::uint32_t uv = mesh.attributes.uv_indices[2][1];
  CHECK(mesh.attributes.uv_indices[3][0] == uv);
  CHECK(mesh.attributes.uv[uv] == std::array<double, 2>{1, 2});
  const Vec3 normal = mesh.attributes.normals[mesh.attributes.normal_indices[3][0]];
  CHECK(normal == Vec3(0, 0.25, 0.75));
  // The whole way through the interface.
  CHECK(mesh_triangles(list.positions, list.triangles, attributes, {.stitch = 1e-9})->size() == 4);
}

TEST_CASE("vertices beyond the tolerance, and those of closed edges, stay out of edges") {
  TriangleList list;
  list.positions = {{0, 0, 0}, {4, 0, 0}, {1, 1e-3, 0}, {2, 3, 0}, {2, -3, 0}};
  list.triangles = {{0, 2, 3}, {2, 1, 3}, {1, 0, 4}};
  CHECK(report_of(list, {.stitch = 1e-4}).stitched_vertices == 0);
  CHECK(report_of(list, {.stitch = 1e-2}).stitched_vertices == 1);
  Random random(34);
  const TriangleList ball = ball_mesh(random, 4, 0.1);
  CHECK(report_of(ball, {.stitch = 10}).stitched_vertices == 0);
}

TEST_CASE("many vertices on one edge are put into it in order") {
  constexpr int count = 20000;
  TriangleList list;
  list.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, -1, 0}, {0.5, 1, 0}};
  list.triangles = {{1, 0, 2}};
  std::uint32_t before = 0;
  for (int i = 1; i < count; ++i) {
    list.positions.emplace_back(static_cast<double>(i) / count, 0, 0);
    const auto here = static_cast<std::uint32_t>(list.positions.size() - 1);
    list.triangles.push_back({before, here, 3});
    before = here;
  }
  list.triangles.push_back({before, 1, 3});
  const auto mesh = mesh_triangles(list.positions, list.triangles, {}, {.stitch = 1e-9});
  CHECK(mesh_report(*mesh).stitched_vertices == count - 1);
  // What is open then are the four outer edges.
  CHECK(mesh->fault().starts_with("4 of its "));
}

TEST_CASE("edges that lie on one another by the thousand are refused, and take no time") {
  TriangleList list;
  for (int i = 0; i < 2000; ++i) {
    const auto first = static_cast<std::uint32_t>(list.positions.size());
    list.positions.insert(list.positions.end(),
                          {{-1.0 - i, 0, 0}, {1.0 + i, 0, 0}, {0, 1.0 + i, 0}});
    list.triangles.push_back({first, first + 1, first + 2});
  }
  try {
    report_of(list, {.stitch = 1e-9});
    FAIL("four million vertices on edges");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::limit);
    CHECK(error.argument() == "stitch");
  }
}

TEST_CASE("options that are no distances are refused by name") {
  TriangleList list;
  list.add_quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  for (const double wrong : {-1.0, 1e101, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()}) {
    try {
      report_of(list, {.weld = wrong});
      FAIL("weld");
    } catch (const Error& error) {
      CHECK(error.argument() == "weld");
    }
    try {
      report_of(list, {.stitch = wrong});
      FAIL("stitch");
    } catch (const Error& error) {
      CHECK(error.argument() == "stitch");
    }
  }
  CHECK(report_of(list, {.weld = 1e-300, .stitch = 1e-300}).stitched_vertices == 0);
}
