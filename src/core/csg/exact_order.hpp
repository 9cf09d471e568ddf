// In which order a line crosses surfaces of the exact tier, however near to each other they are.
//
// 100 bits of t tell nearly all crossings apart. What their bounds leave open is told by the roots
// as they are (math/real_root.hpp): two are one place if the polynomials of their surfaces along
// the line have that root in common. Tests: tests/csg/exact_order_test.cpp
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/csg/program.hpp"

namespace crt::core {

struct WorldRay;

/// A crossing among others of one ray.
struct NearCrossing {
  double t = 0;
  double error = 0;
  double t_low = 0;
  std::uint32_t leaf = 0;  ///< within the scene
  std::uint32_t face = 0;
  std::uint32_t surface = 0;
  std::uint8_t root = 0;
  std::uint32_t item = 0;  ///< the caller's
  std::uint32_t rank = 0;  ///< see sort_exactly()
};

/// What a crossing of an object, or of a leaf of a CSG object, is among others.
template <class Crossing>
NearCrossing near_crossing(const Crossing& of, std::uint32_t leaf_of_scene, std::uint32_t item) {
  return {.t = of.t,
          .error = of.error,
          .t_low = of.t_low,
          .leaf = leaf_of_scene,
          .face = of.face,
          .surface = of.surface,
          .root = of.root,
          .item = item};
}

/// Where crossings have no more than that between them it takes more than a look at t: about the
/// rounding of t, and more than twice the largest error that the exact tier leaves.
inline double looking_distance(double t) {
  constexpr double roundings = 0x1p-50;
  return roundings * std::abs(t);
}

/// Sorts crossings of one ray with leaves of the exact tier by where they are. Each gets its rank,
/// from 1 on; those of one place have the same and stay in order. What (t, t_low) says to be before
/// something of a lower rank is moved, by as little as doubles can be, with the way added to its
/// error. False if there are some of which only the rounding of the ray's start tells the place:
/// then they are in no order that means anything. Takes memory only where 100 bits of t leave the
/// order open.
bool sort_exactly(std::vector<NearCrossing>& crossings, std::span<const Leaf> leaves,
                  std::span<const FaceSurface> face_surfaces, const WorldRay& ray,
                  std::uint64_t& escalations);

}  // namespace crt::core
