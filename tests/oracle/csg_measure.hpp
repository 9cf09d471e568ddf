// These functions compare what both tiers report of trees of solids with exact roots.
//
// The standard tier must never call a point inside (or outside) that is not, whatever the leaves
// are at which the point is within the bound of measure.hpp. Only such points are *close calls*.
// The exact tier must find the very crossings that there are, each within an ulp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace crt::test {

struct CsgRecord {
  std::uint64_t trees = 0;
  std::uint64_t rays = 0;
  std::uint64_t faces = 0;
  std::uint64_t coincident_faces = 0;
  std::uint64_t crossings = 0;
  struct Tier {
    std::uint64_t close_calls = 0;
    std::uint64_t wrong = 0;
    std::uint64_t escalations = 0;
  };
  Tier standard;
  Tier exact;
  std::vector<std::string> failures;  ///< the first ones

  void add(const CsgRecord& other);
};

/// Measures trees first to last (not included) with so many rays each, on all cores.
CsgRecord measure_csg(std::uint64_t first, std::uint64_t last, std::uint64_t rays_per_tree);

}  // namespace crt::test
