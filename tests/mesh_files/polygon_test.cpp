// These tests cut polygons into triangles.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <random>

#include "core/mesh_files/polygon.hpp"
#include "mesh_texts.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Returns twice the area of a polygon as a vector: the sum of its corners' cross products.
Vec3 area_vector(const std::vector<Vec3>& corners) {
  Vec3 sum{0, 0, 0};
  for (std::size_t i = 0; i < corners.size(); ++i)
    sum += glm::cross(corners[i], corners[(i + 1) % corners.size()]);
  return sum;
}

/// Checks that the triangles are a cut of the polygon: they have its sides, and all others twice.
/// They turn as it does, and have its area together. The polygon is cut at `size` times its size.
void check_cut(const std::vector<Vec3>& corners, double size = 1) {
  std::vector<Vec3> scaled;
  for (const Vec3& corner : corners) scaled.push_back(size * corner);
  core::PolygonCutter cutter;
  const auto triangles = cutter.cut(scaled);
  REQUIRE(triangles.size() == corners.size() - 2);
  const Vec3 whole = area_vector(corners);
  double area = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const TriangleIndices& triangle : triangles) {
    const auto [a, b, c] = triangle;
    const double part = glm::dot(area_vector({corners[a], corners[b], corners[c]}), whole);
    CHECK(part > 0);
    area += part / glm::length(whole);
    for (std::size_t i = 0; i < 3; ++i) {
      ++sides[{triangle[i], triangle[(i + 1) % 3]}];
      --sides[{triangle[(i + 1) % 3], triangle[i]}];
    }
  }
  CHECK(area == doctest::Approx(glm::length(whole)));
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    const auto next = static_cast<std::uint32_t>((i + 1) % corners.size());
    CHECK(sides[{i, next}] == 1);
    sides[{i, next}] = sides[{next, i}] = 0;
  }
  for (const auto& [side, count] : sides) CHECK(count == 0);
}

/// Returns a polygon that goes once around the middle, with a radius of its own for each corner.
std::vector<Vec3> star(int count, std::mt19937& random, const Vec3& x, const Vec3& y) {
  std::uniform_real_distribution<double> radius(0.2, 1);
  std::vector<Vec3> corners;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    corners.push_back(radius(random) * (std::cos(angle) * x + std::sin(angle) * y));
  }
  return corners;
}

}  // namespace

TEST_CASE("polygons that are not convex are cut along their inside") {
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    const int count = 4 + i % 60;
    check_cut(star(count, random, {1, 0, 0}, {0, 1, 0}));
    check_cut(star(count, random, {0, -1, 1}, {0.3, 1, 0}), 1e-300);
    check_cut(star(count, random, {1, 0.1, 0}, {0, 0, -1}), 1e99);
  }
  check_cut({{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}});
  check_cut({{1, 1, 0}, {0, 4, 0}, {0, 0, 0}, {4, 0, 0}});
}

TEST_CASE("corners on straight sides make no triangle without an area") {
  check_cut({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
  check_cut({{1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 0}});
  check_cut({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 2, 0}});
  check_cut(
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}});
}

TEST_CASE("a hole that is joined to the border stays a hole") {
  check_cut({{0, 0, 0},
             {9, 0, 0},
             {9, 9, 0},
             {0, 9, 0},
             {0, 0, 0},
             {3, 3, 0},
             {3, 6, 0},
             {6, 6, 0},
             {6, 3, 0},
             {3, 3, 0}});
}

TEST_CASE("any other polygon is cut along its sides, too") {
  core::PolygonCutter cutter;
  const std::vector<Vec3> crossed = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  CHECK(cutter.cut(crossed).size() == 2);
  const std::vector<Vec3> twice_around = {
      {0, 2, 0}, {-1, -1, 0}, {2, 1, 0}, {-2, 1, 0}, {1, -1, 0}};
  CHECK(cutter.cut(twice_around).size() == 3);
  const std::vector<Vec3> straight = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}};
  CHECK(cutter.cut(straight).size() == 3);
}

TEST_CASE("a polygon of very many corners is an error and no hang") {
  // Each tooth of this saw hides behind the next one.
  std::string text = "OFF\n200001 1 0\n";
  std::string face = "200001";
  for (int i = 0; i < 200000; ++i) {
    text += std::to_string(i / 2 + (i % 2) * 100000) + " " + std::to_string(i % 2) + " 0\n";
    face += " " + std::to_string(i);
  }
  const std::string error = decode_error(text + "0 -1 0\n" + face + " 200000\n");
  CHECK(error.find("cutting its faces into triangles takes too long") != std::string::npos);
}
