// These tests ask meshes for their normals, (u, v) and materials. Where these are an affine
// function of the place, every point of a facet has to have its value.
#include "core/geometry/mesh/facet_attributes.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/geometry/mesh/mesh.hpp"
#include "core/geometry/mesh/triangles.hpp"
#include "crt/error.hpp"
#include "crt/prepared_scene.hpp"
#include "crt/query.hpp"
#include "crt/scene.hpp"
#include "crt/transform.hpp"
#include "geometry/meshes.hpp"
#include "support/scene_of.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr double float_rounding = 1e-6;
constexpr double degree = std::numbers::pi / 180;
using Uv = std::array<double, 2>;

std::shared_ptr<const MeshTriangles> mesh_of(const TriangleList& list,
                                             const MeshAttributes& attributes) {
  return mesh_triangles(list.positions, list.triangles, attributes);
}

/// Returns a facet's normal for shading at one of its corners.
Vec3 corner_normal(const MeshTriangles& mesh, std::uint32_t facet, std::uint32_t corner) {
  const Triangle triangle = mesh.triangle(facet);
  const Vec3 plain = glm::normalize(glm::cross(triangle.b - triangle.a, triangle.c - triangle.a));
  const double u = corner == 1 ? 1 : 0;
  const double v = corner == 2 ? 1 : 0;
  return mesh.attributes()->normal(facet, u, v, plain).direction;
}

Vec3 corner_place(const MeshTriangles& mesh, std::uint32_t facet, std::uint32_t corner) {
  const Triangle triangle = mesh.triangle(facet);
  return corner == 0 ? triangle.a : (corner == 1 ? triangle.b : triangle.c);
}

/// Calls with each facet and each of its corners.
template <class Use>
void for_each_corner(const MeshTriangles& mesh, const Use& use) {
  for (std::uint32_t facet = 0; facet < mesh.size(); ++facet) {
    for (const std::uint32_t corner : {0u, 1u, 2u}) use(facet, corner);
  }
}

/// Returns the same triangles the other way round.
TriangleList turned(TriangleList list) {
  for (TriangleIndices& triangle : list.triangles) std::swap(triangle[1], triangle[2]);
  return list;
}

Uv affine_uv(const Vec3& place) {
  return {0.25 + 0.5 * place.x - 2 * place.y, 3 + place.z + 0.125 * place.x};
}

/// Returns attributes whose (u, v) are an affine function of the place.
MeshAttributes with_affine_uv(const TriangleList& list) {
  MeshAttributes attributes;
  for (const Vec3& place : list.positions) attributes.uv.push_back(affine_uv(place));
  return attributes;
}

/// Checks (u, v) of all hits by rays through places near the origin, where `is_of_mesh` says so.
/// The mesh has been scaled.
template <class IsOfMesh>
void check_affine_uv(const Entity& entity, Precision precision, const Vec3& scale,
                     const IsOfMesh& is_of_mesh) {
  Random random(7);
  const PreparedScene scene = scene_of(entity, precision);
  int checked = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 aim = random.in_cube();
    const Vec3 direction = random.in_cube();
    for (const Hit& hit :
         crossings(scene, {.origin = aim - 4.0 * direction, .direction = direction})) {
      if (!is_of_mesh(hit)) continue;
      const Uv expected = affine_uv(hit.position / scale);
      REQUIRE(std::abs(hit.u - expected[0]) < 1e-5);
      REQUIRE(std::abs(hit.v - expected[1]) < 1e-5);
      ++checked;
    }
  }
  CHECK(checked > 100);
}

std::string fault_of(const TriangleList& list, const MeshAttributes& attributes) {
  try {
    mesh_of(list, attributes);
    return {};
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::invalid_argument);
    CHECK(std::string(error.what()).starts_with(error.argument()));
    return error.what();
  }
}

const TriangleList one_triangle = {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                   .triangles = {{0, 1, 2}}};

}  // namespace

TEST_CASE("a corner has the normal that was given for its vertex, whichever way triangles go") {
  Random random(1);
  TriangleList list = ball_mesh(random, 5, 0.1);
  MeshAttributes attributes;
  attributes.normals = list.positions;  // the origin is within the ball
  for (const bool turns : {false, true}) {
    const auto mesh = mesh_of(turns ? turned(list) : list, attributes);
    for_each_corner(*mesh, [&](std::uint32_t facet, std::uint32_t corner) {
      const Vec3 expected = glm::normalize(corner_place(*mesh, facet, corner));
      REQUIRE(glm::distance(corner_normal(*mesh, facet, corner), expected) < float_rounding);
    });
  }
}

TEST_CASE("normals that point into the solid are turned out of it") {
  Random random(2);
  const TriangleList list = ball_mesh(random, 4, 0);
  MeshAttributes attributes;
  for (const Vec3& place : list.positions) attributes.normals.push_back(-3.0 * place);
  const auto mesh = mesh_of(list, attributes);
  for_each_corner(*mesh, [&](std::uint32_t facet, std::uint32_t corner) {
    const Vec3 place = corner_place(*mesh, facet, corner);
    REQUIRE(glm::distance(corner_normal(*mesh, facet, corner), place) < float_rounding);
  });
}

TEST_CASE("corners may have indices of their own, and triangles without an area take none along") {
  TriangleList list = one_triangle;
  list.positions.emplace_back(2, 0, 0);
  list.triangles = {{0, 1, 3}, {1, 1, 2}, {0, 1, 2}};
  MeshAttributes attributes;
  attributes.normals = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {-1, 0, 1}};
  attributes.normal_indices = {{0, 0, 0}, {0, 0, 0}, {3, 2, 1}};
  attributes.uv = {{1, 2}, {3, 4}, {5, 6}};
  attributes.uv_indices = {{0, 0, 0}, {1, 1, 1}, {2, 1, 0}};
  attributes.materials = {Material{}, Material{}, Material{}};
  attributes.material_of_triangle = {0, 1, 2};
  const auto mesh = mesh_of(list, attributes);
  REQUIRE(mesh->size() == 1);
  CHECK(glm::distance(corner_normal(*mesh, 0, 0), glm::normalize(Vec3(-1, 0, 1))) < 1e-6);
  CHECK(glm::distance(corner_normal(*mesh, 0, 2), glm::normalize(Vec3(1, 0, 1))) < 1e-6);
  double u = 0.5;
  double v = 0.25;
  mesh->attributes()->weights_to_uv(0, u, v);
  CHECK(u == 0.25 * 5 + 0.5 * 3 + 0.25 * 1);
  CHECK(v == 0.25 * 6 + 0.5 * 4 + 0.25 * 2);
  CHECK(mesh->attributes()->material(0) == 3);
}

TEST_CASE("a normal of 0 and no normal at all are that of the triangle, and so is no mean") {
  MeshAttributes attributes;
  attributes.normals = {{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}};
  attributes.normal_indices = {{0, no_index, 1}};
  const auto mesh = mesh_of(one_triangle, attributes);
  CHECK(corner_normal(*mesh, 0, 0) == Vec3(0, 0, 1));
  CHECK(corner_normal(*mesh, 0, 1) == Vec3(0, 0, 1));
  CHECK(corner_normal(*mesh, 0, 2) == Vec3(1, 0, 0));
  attributes.normal_indices = {{1, 2, 2}};
  const auto opposite = mesh_of(one_triangle, attributes);
  CHECK(opposite->attributes()->normal(0, 0.5, 0, {0, 0, 1}).direction == Vec3(0, 0, 1));
}

TEST_CASE(
    "smooth normals of a ball are nearly its own, and those of a cube only beyond 90 degrees") {
  Random random(3);
  const TriangleList ball = ball_mesh(random, 12, 0);
  const auto smooth = mesh_of(ball, {.smooth = 30 * degree});
  for_each_corner(*smooth, [&](std::uint32_t facet, std::uint32_t corner) {
    const Vec3 place = corner_place(*smooth, facet, corner);
    REQUIRE(glm::distance(corner_normal(*smooth, facet, corner), place) < 0.03);
  });

  // A corner of the cube has one or two triangles of a face, which weigh what their angles do.
  const TriangleList cube = Voxels(random, 1).mesh();
  const auto rounded = mesh_of(cube, {.smooth = 91 * degree});
  const auto creased = mesh_of(cube, {.smooth = 89 * degree});
  for_each_corner(*rounded, [&](std::uint32_t facet, std::uint32_t corner) {
    const Triangle triangle = rounded->triangle(facet);
    const Vec3 plain = glm::normalize(glm::cross(triangle.b - triangle.a, triangle.c - triangle.a));
    const Vec3 outwards = glm::normalize(corner_place(*rounded, facet, corner) - Vec3(0.5));
    REQUIRE(glm::distance(corner_normal(*rounded, facet, corner), outwards) < float_rounding);
    REQUIRE(glm::distance(corner_normal(*creased, facet, corner), plain) < float_rounding);
  });
}

TEST_CASE("a mesh that is smoothed by 0, or has nothing beyond triangles, keeps nothing") {
  MeshAttributes attributes;
  attributes.normals = one_triangle.positions;
  attributes.smooth = 0;
  CHECK(mesh_of(one_triangle, attributes)->attributes() == nullptr);
  CHECK(mesh_of(one_triangle, {})->attributes() == nullptr);
  CHECK(mesh_of(one_triangle, {})->bytes() ==
        mesh_triangles(one_triangle.positions, one_triangle.triangles)->bytes());
}

TEST_CASE("(u, v) are interpolated, in both tiers, through CSG and in any place") {
  Random random(4);
  const TriangleList list = ball_mesh(random, 4, 0.2);
  const Entity mesh = triangle_mesh(list.positions, list.triangles, with_affine_uv(list));
  const Vec3 one(1);
  const Vec3 uneven(1, 3, 0.5);
  const auto all = [](const Hit&) { return true; };
  for (const Precision precision : tiers) {
    check_affine_uv(mesh, precision, one, all);
    check_affine_uv(mesh.transformed(scale(uneven)), precision, uneven, all);
    const Entity ball = Sphere{.center = {0.5, 0, 0}, .radius = 0.4};
    const auto is_cut = [](const Hit& hit) {
      return std::abs(glm::distance(hit.position, Vec3(0.5, 0, 0)) - 0.4) < 1e-9;
    };
    check_affine_uv(mesh - ball, precision, one, [&](const Hit& hit) { return !is_cut(hit); });
    const Entity cutter = Entity(Sphere{.radius = 3}) - mesh;
    check_affine_uv(cutter, precision, one,
                    [&](const Hit& hit) { return glm::length(hit.position) < 2; });
  }
}

TEST_CASE("a triangle with a corner without (u, v) has its weights") {
  MeshAttributes attributes;
  attributes.uv = {{7, 7}};
  attributes.uv_indices = {{0, no_index, 0}};
  const Entity entity = triangle_mesh(one_triangle.positions, one_triangle.triangles, attributes);
  const auto hit = intersect(scene_of(entity, Precision::standard),
                             {.origin = {0.25, 0.5, -1}, .direction = {0, 0, 1}});
  REQUIRE(hit.has_value());
  CHECK(hit->u == 0.25);
  CHECK(hit->v == 0.5);
}

TEST_CASE("normals change no answer of queries") {
  Random random(5);
  const TriangleList list = ball_mesh(random, 3, 0.2);
  const Entity plain = list.entity();
  const Entity smooth = triangle_mesh(list.positions, list.triangles, {.smooth = 3});
  for (const Precision precision : tiers) {
    const PreparedScene one = scene_of(plain, precision);
    const PreparedScene other = scene_of(smooth, precision);
    for (int i = 0; i < 200; ++i) {
      const Ray ray = {.origin = 3.0 * random.in_cube(), .direction = random.in_cube()};
      const std::vector<Hit> expected = crossings(one, ray);
      const std::vector<Hit> hits = crossings(other, ray);
      REQUIRE(hits.size() == expected.size());
      for (std::size_t k = 0; k < hits.size(); ++k) {
        REQUIRE(hits[k].t == expected[k].t);
        REQUIRE(hits[k].normal == expected[k].normal);
        REQUIRE(hits[k].u == expected[k].u);
      }
    }
  }
}

TEST_CASE("attributes that do not fit are refused by name") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto fault = [](const MeshAttributes& attributes) {
    return fault_of(one_triangle, attributes);
  };
  CHECK(fault({.normals = {{0, 0, 1}, {0, 0, 1}}}) ==
        "normals has 2 items; without normal_indices it must have one for each of the 3 positions");
  CHECK(fault({.normals = {{0, 0, infinity}}, .normal_indices = {{0, 0, 0}}}) ==
        "normals[0] is not finite");
  CHECK(fault({.normals = {{0, std::nan(""), 1}}, .normal_indices = {{0, 0, 0}}}) ==
        "normals[0] is not finite");
  CHECK(fault({.normals = {{0, 0, 1}}, .normal_indices = {{0, 0, 1}}}) ==
        "normal_indices[0] has the index 1, but there are 1 normals");
  CHECK(fault({.normals = {{0, 0, 1}}, .normal_indices = {{0, 0, 0}, {0, 0, 0}}}) ==
        "normal_indices has 2 items; it must have one for each of the 1 triangles");
  CHECK(fault({.uv = {{0, 1e31}}, .uv_indices = {{0, 0, 0}}}) ==
        "uv[0] is not finite or above 1e30 in magnitude");
  CHECK(fault({.uv_indices = {{0, 0, 0}}}) == "uv_indices[0] has the index 0, but there are 0 uv");
  CHECK(fault({.materials = {Material{}}, .material_of_triangle = {1}}) ==
        "material_of_triangle[0] is 1, but there are 1 materials");
  CHECK(fault({.materials = {Material{}}, .material_of_triangle = {0, 0}}) ==
        "material_of_triangle has 2 items; it must have one for each of the 1 triangles");
  CHECK(fault({.smooth = 4}) == "smooth must be an angle in [0, pi]");
  CHECK(fault({.smooth = -0.1}) == "smooth must be an angle in [0, pi]");
  CHECK(fault({.smooth = std::nan("")}) == "smooth must be an angle in [0, pi]");
}

TEST_CASE("normals and shading of the smallest and the largest meshes are finite") {
  for (const double size : {1e-90, 1e-30, 1e30, 1e90}) {
    Random random(6);
    const TriangleList list = ball_mesh(random, 2, 0, Vec3(size));
    for (const MeshAttributes& attributes :
         {MeshAttributes{.smooth = 2}, MeshAttributes{.normals = list.positions}}) {
      const auto mesh = mesh_of(list, attributes);
      for_each_corner(*mesh, [&](std::uint32_t facet, std::uint32_t corner) {
        const Vec3 expected = corner_place(*mesh, facet, corner) / size;
        REQUIRE(glm::distance(corner_normal(*mesh, facet, corner), expected) < 0.3);
      });
    }
  }
}
