// These functions make random solids of all primitives, and places for them.
#pragma once

#include <cstdint>

#include "geometry/random.hpp"
#include "oracle/solid_tree.hpp"

namespace crt::truth {

using test::Random;
using test::SolidTree;

/// A Leaves says which primitives a tree may have.
enum class Leaves : std::uint8_t {
  with_oracle,  ///< those with equations in tests/oracle
  all,          ///< implicit solids, too
};

/// Returns a finite tree of at most six levels of operations. Those of even numbers have small
/// dyadic numbers, and quarter turns, mirrors and powers of two as transforms: there most faces
/// coincide with others. Those of odd numbers have any. Of those the parts' `to_world` is not set.
SolidTree random_solid(std::uint64_t number, Leaves leaves);

/// Returns a map that turns, mirrors now and then, scales by one factor (10^-3 to 10^3) and moves.
Transform random_even_map(Random& random, double& factor);

/// Returns a map that also scales by three factors, which differ by up to 4.
Transform random_map(Random& random);

double determinant_of(const Transform& map);
Vec3 moved(const Transform& map, const Vec3& point);

}  // namespace crt::truth
