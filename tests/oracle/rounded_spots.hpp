// Rounded boxes of the oracle, and places on them that rays are aimed at.
#pragma once

#include "oracle/spots.hpp"

namespace crt::test {

// These do what the functions of spots.hpp do.
void make(Counted& random, const Vec3& at, double size, RoundedBox& b);
Spot spot(Counted& random, const RoundedBox& b);
Vec3 edge(Counted& random, const RoundedBox& b);

}  // namespace crt::test
