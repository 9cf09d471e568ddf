// Trees of solids whose faces coincide, against membership by exact roots.
#include <doctest/doctest.h>

#include "oracle/csg_measure.hpp"

using namespace crt::test;

TEST_CASE("trees of solids on a grid are what exact roots say along every ray, in both tiers") {
  constexpr std::uint64_t trees = 300;
  constexpr std::uint64_t rays_per_tree = 100;
  const CsgRecord record = measure_csg(0, trees, rays_per_tree);
  for (const std::string& failure : record.failures) {
    FAIL_CHECK(failure);
  }
  CHECK(record.standard.wrong == 0);
  CHECK(record.exact.wrong == 0);
  CHECK(2 * record.coincident_faces >= record.faces);
  CHECK(record.crossings > record.rays / 3);
  CHECK(record.standard.close_calls < record.rays / 100);
}
