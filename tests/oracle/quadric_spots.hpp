// These functions make quadrics, and places on them that rays are aimed at. They are those of
// spots.cpp for all other primitives.
#pragma once

#include "oracle/spots.hpp"

namespace crt::test {

/// Makes a quadric of a kind, as its frame and its place say.
void make(Counted& random, const Vec3& at, double size, Quadric& q);

/// Returns a spot where a random line meets it, with a direction along a straight line on it, if
/// there is one.
Spot spot(Counted& random, const Quadric& q);

/// Returns the apex of a cone, or the middle.
Vec3 edge(Counted& random, const Quadric& q);

}  // namespace crt::test
