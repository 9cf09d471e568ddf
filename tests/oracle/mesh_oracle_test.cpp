// The oracle of meshes against closed forms, and meshes in both tiers against the oracle.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "oracle/mesh_measure.hpp"
#include "oracle/mesh_oracle.hpp"

using namespace crt;
using namespace crt::test;

namespace {

// This takes some 12 s of one core in all. A build that is slow by intent gets a twentieth.
#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
constexpr std::uint64_t rays = 4000;
constexpr std::size_t max_triangles = 10'000;
#else
constexpr std::uint64_t rays = 200;
constexpr std::size_t max_triangles = 1000;
#endif

/// Returns a cube of twelve triangles, from 0 to 1 along each axis.
TriangleList unit_cube() {
  TriangleList list;
  const auto at = [](int x, int y, int z) { return Vec3(x, y, z); };
  list.add_quad(at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0));
  list.add_quad(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));
  list.add_quad(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
  list.add_quad(at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0));
  list.add_quad(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));
  list.add_quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
  return list;
}

/// Returns whether the flips of a line are at these two fractions, or nowhere if they are equal.
bool is_span(const TrueMeshLine& line, const mpq_class& from, const mpq_class& to) {
  const auto flips = line.flips();
  if (from == to) return flips.empty();
  return flips.size() == 2 && flips[0]->t == from && flips[1]->t == to && flips[0]->inside_after;
}

void check(const MeshRecord& record) {
  std::string failures;
  for (const std::string& failure : record.failures) failures += failure + "\n";
  INFO(failures);
  CHECK(record.failures.empty());
  CHECK(record.standard.wrong == 0);
  CHECK(record.exact.wrong == 0);
  CHECK(record.standard.largest_ratio <= 1);
  CHECK(record.exact.largest_ratio <= 1);
  CHECK(record.standard.close_calls < record.rays / 20);
  CHECK(record.touching > record.rays / 10);
  CHECK(record.crossings > record.rays / 4);
}

}  // namespace

TEST_CASE("the oracle of meshes finds where lines meet a cube, by fractions") {
  const MeshOracle cube(unit_cube());
  CHECK(is_span(cube.along({-3, 0.25, 0.5}, {3, 0, 0}), 1, mpq_class(4, 3)));
  CHECK(is_span(cube.along({-1, -1, -1}, {3, 3, 3}), mpq_class(1, 3), mpq_class(2, 3)));
  CHECK(is_span(cube.along({-1, -1, 0.5}, {3, 7, 0}), 0, 0));
  CHECK(is_span(cube.along({0.5, 0.25, -1e9}, {0, 0, 1}), 1000000000, 1000000001));
  SUBCASE("a line that touches an edge or a corner alone is never inside") {
    CHECK(is_span(cube.along({-1, 1, 0.5}, {1, 1, 0}), 0, 0));
    CHECK(cube.along({-1, 2, 0.5}, {1, -1, 0}).touches_edges);
    CHECK(is_span(cube.along({-1, 1, 0.5}, {1, -1, 0}), 0, 0));
    CHECK(is_span(cube.along({1, 1, 1}, {1, -1, 0.25}), 0, 0));
  }
  SUBCASE("a line in a face is where it is if moved along the axes") {
    CHECK(is_span(cube.along({0, 0.5, -2}, {0, 0, 1}), 2, 3));
    CHECK(is_span(cube.along({1, 0.5, -2}, {0, 0, 1}), 0, 0));
    CHECK(is_span(cube.along({0, 0, -2}, {0, 0, 1}), 2, 3));
    CHECK(is_span(cube.along({0, 1, -2}, {0, 0, 1}), 0, 0));
    CHECK(is_span(cube.along({-2, 0, 0}, {1, 0, 0}), 2, 3));
    CHECK(is_span(cube.along({-2, 0, 1}, {1, 0, 0}), 0, 0));
  }
  SUBCASE("differences of cubes have no walls") {
    TriangleList moved = unit_cube();
    for (Vec3& position : moved.positions) position.x += 0.5;
    const auto left = [&](const Vec3& origin, const Vec3& direction) {
      return difference_of(cube.along(origin, direction),
                           MeshOracle(moved).along(origin, direction));
    };
    CHECK(is_span(left({-1, 0.25, 0.5}, {1, 0, 0}), 1, mpq_class(3, 2)));
    CHECK(is_span(left({0.75, 0.25, -1}, {0, 0, 1}), 0, 0));
    CHECK(is_span(left({0.25, 0, -1}, {0, 0, 1}), 1, 2));
  }
}

TEST_CASE("the oracle of meshes finds the voxels that lines go through") {
  Random random(1);
  std::size_t met = 0;
  for (int round = 0; round < 40; ++round) {
    const int size = 1 + round % 5;
    const Voxels voxels(random, size);
    const MeshOracle oracle(voxels.mesh());
    for (int i = 0; i < 100; ++i) {
      // Whole numbers, so that lines go through edges and corners. Lines within planes of the grid
      // are moved along x, y and z, which is what rounding downwards does.
      const auto whole = [&](int most) {
        return static_cast<int>(random.bits() % static_cast<unsigned>(2 * most + 1)) - most;
      };
      const std::array<int, 3> from = {whole(size), whole(size), whole(size)};
      const std::array<int, 3> along = {whole(3), whole(3), whole(3)};
      if (along == std::array<int, 3>{}) continue;
      std::vector<mpq_class> cuts;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (int k = 0; k <= size && along[axis] != 0; ++k) {
          cuts.emplace_back(k - from[axis], along[axis]);
          cuts.back().canonicalize();
        }
      }
      std::sort(cuts.begin(), cuts.end());
      cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
      std::vector<mpq_class> expected;
      bool inside = false;
      for (std::size_t k = 0; k < cuts.size(); ++k) {
        bool after = false;
        if (k + 1 < cuts.size()) {
          const mpq_class middle = (cuts[k] + cuts[k + 1]) / 2;
          std::array<int, 3> cell{};
          for (std::size_t axis = 0; axis < 3; ++axis) {
            const mpq_class place = from[axis] + middle * along[axis];
            mpz_class floor;
            mpz_fdiv_q(floor.get_mpz_t(), place.get_num_mpz_t(), place.get_den_mpz_t());
            cell[axis] = static_cast<int>(floor.get_si());
          }
          after = voxels.at(cell[0], cell[1], cell[2]);
        }
        if (after != inside) expected.push_back(cuts[k]);
        inside = after;
      }
      const TrueMeshLine line =
          oracle.along(Vec3(from[0], from[1], from[2]), Vec3(along[0], along[1], along[2]));
      const auto flips = line.flips();
      REQUIRE(flips.size() == expected.size());
      for (std::size_t k = 0; k < flips.size(); ++k) REQUIRE((flips[k]->t == expected[k]));
      met += flips.size();
    }
  }
  CHECK(met > 1000);
}

TEST_CASE("meshes of all kinds are met where fractions say, in both tiers") {
  for (std::size_t kind = 0; kind < mesh_kinds; ++kind) {
    CAPTURE(kind);
    check(measure_meshes(static_cast<MeshKind>(kind), max_triangles, rays));
  }
}

TEST_CASE("what is left of a mesh without another that coincides is what fractions say") {
  const MeshRecord record = measure_mesh_differences(1000, rays);
  check(record);
  CHECK(2 * record.coincident_faces >= record.faces);
}

TEST_CASE(
    "two meshes that overlap and coincide in one are by the nonzero rule what fractions say") {
  const MeshRecord record = measure_mesh_unions(1000, rays);
  check(record);
  CHECK(2 * record.coincident_faces >= record.faces);
}
