// Facets of a mesh that are nearer to each other than doubles are keep their order in the exact
// tier.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/geometry/mesh/triangles.hpp"
#include "crt/query.hpp"
#include "geometry/cuboids.hpp"
#include "support/scene_of.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Returns what is left of places by the even-odd rule: those that are there an odd number of
/// times, in order.
std::vector<double> odd_places(std::vector<double> places) {
  std::sort(places.begin(), places.end());
  std::vector<double> odd;
  for (const double place : places) {
    if (!odd.empty() && odd.back() == place) {
      odd.pop_back();
    } else {
      odd.push_back(place);
    }
  }
  return odd;
}

}  // namespace

TEST_CASE("a mesh of the exact tier has gaps and pieces whose ends round to one double") {
  Random random(1);
  int merged = 0;
  for (int i = 0; i < 200; ++i) {
    TriangleList mesh;
    std::vector<double> places;
    const auto add = [&](double from, double to) {
      add_box(mesh, {from, -1, -1}, {to, 1, 1});
      places.insert(places.end(), {from, to});
    };
    if (random.one_in(2)) add(0.5, 1.5);
    // Plates of some roundings, next to each other, in one another and overlapping.
    const auto near_one = [&] { return 1 + 0x1p-52 * static_cast<double>(random.bits() % 16); };
    for (std::uint64_t plates = 1 + random.bits() % 4; plates > 0; --plates) {
      const double from = near_one();
      add(from, from + 0x1p-52 * static_cast<double>(1 + random.bits() % 8));
    }
    const double origin = -std::ldexp(1.0, static_cast<int>(random.bits() % 40));
    const std::vector<Hit> hits = crossings(
        scene_of(mesh.entity(), Precision::exact),
        {.origin = {origin, random.uniform(-1, 1), random.uniform(-1, 1)}, .direction = {1, 0, 0}});
    const std::vector<double> expected = odd_places(places);
    CAPTURE(i);
    REQUIRE(hits.size() == expected.size());
    for (std::size_t k = 0; k < hits.size(); ++k) {
      REQUIRE(hits[k].entering == (k % 2 == 0));
      REQUIRE(hits[k].t == expected[k] - origin);
      if (k > 0 && hits[k].t == hits[k - 1].t) ++merged;
    }
  }
  CHECK(merged > 100);
}
