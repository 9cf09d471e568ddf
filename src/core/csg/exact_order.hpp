// The order in which a line crosses surfaces of the exact tier is found here, however near to each
// other they are.
//
// 100 bits of t separate nearly all crossings. What their bounds leave open is resolved by the
// roots as they are (math/real_root.hpp). Two are one place if the polynomials of their surfaces
// along the line have that root in common. The tests are in tests/csg/exact_order_test.cpp.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/csg/program.hpp"

namespace crt::core {

struct WorldRay;

/// A NearCrossing is a crossing among others of one ray.
struct NearCrossing {
  double t = 0;
  double error = 0;
  double t_low = 0;
  std::uint32_t face = 0;
  std::uint32_t surface = 0;
  std::uint8_t root = 0;
  std::uint32_t item = 0;  ///< the caller's
  std::uint32_t rank = 0;  ///< see sort_exactly()
};

/// Returns what a crossing of an object, or of a leaf of a CSG object, is among others.
template <class Crossing>
NearCrossing near_crossing(const Crossing& of, std::uint32_t item) {
  return {.t = of.t,
          .error = of.error,
          .t_low = of.t_low,
          .face = of.face,
          .surface = of.surface,
          .root = of.root,
          .item = item};
}

/// Returns the distance up to which it takes more than a look at t to order crossings. It is about
/// the rounding of t, and more than twice the largest error that the exact tier leaves.
inline double looking_distance(double t) {
  constexpr double roundings = 0x1p-50;
  return roundings * std::abs(t);
}

/// A LeafOnRay is a leaf that a ray crosses, and where the ray starts on it.
struct LeafOnRay {
  PlacedLeaf leaf;
  FaceStart start;
};
/// A FindLeaf returns the leaf of a crossing. It need only be valid until it is asked again.
using FindLeaf = std::function<LeafOnRay(const NearCrossing& crossing)>;

/// Sorts crossings of one ray with leaves of the exact tier by where they are. Each gets its rank,
/// from 1 on. Those of one place have equal ranks and stay in order. What (t, t_low) puts before
/// something of a lower rank is moved, by as little as doubles can be, and the distance is added to
/// its error. Returns false if the place of some depends on the rounding of the ray's start alone.
/// They are then in no order that means anything. Takes memory only where 100 bits of t leave the
/// order open.
bool sort_exactly(std::vector<NearCrossing>& crossings, const FindLeaf& find_leaf,
                  const WorldRay& ray, std::uint64_t& escalations);

}  // namespace crt::core
