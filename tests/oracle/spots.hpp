// Every primitive of the oracle's rays is made here, with places on it that rays are aimed at.
#pragma once

#include "oracle/ray_maker.hpp"

namespace crt::test {

/// A Spot is a point on the surface with its normal, and a direction that a ray may be nearly
/// parallel to.
struct Spot {
  Vec3 point;
  Vec3 normal;
  Vec3 parallel;
};

/// A Frame has two unit vectors across a direction and each other.
struct Frame {
  Vec3 a;
  Vec3 b;
};
Frame across(const Vec3& v);
Vec3 around(const Frame& frame, double angle);
double angle(Counted& random);

/// Gives a primitive a size at a place.
void make(Counted& random, const Vec3& at, double size, Primitive& primitive);

/// Returns a random spot on the surface.
Spot spot(Counted& random, const Primitive& primitive);

/// Returns a random point of an edge, a rim or a seam.
Vec3 edge(Counted& random, const Primitive& primitive);

}  // namespace crt::test
