// These functions make cylinders, cones and capsules of extreme proportions, and rays along the
// straight lines of their sides (rulings).
#pragma once

#include "oracle/ray_maker.hpp"

namespace crt::test {

/// Sets the solid's place and proportions. Its height and radius differ by a factor of
/// up to 10^6, a cone's two radii by up to 10^6 or by next to nothing. The axis is slanted, along a
/// coordinate axis or nearly so.
void make_extreme(Counted& random, const Vec3& at, double size, Cylinder& c);
void make_extreme(Counted& random, const Vec3& at, double size, Cone& c);
void make_extreme(Counted& random, const Vec3& at, double size, Capsule& c);

/// A Ruling is a straight line of the side of a cone (or of a cylinder: with two radii that are
/// equal).
struct Ruling {
  Vec3 from;       ///< where it is at the end `from`
  Vec3 way;        ///< from there to the end `to`
  Vec3 direction;  ///< `way` with length 1
  Vec3 normal;     ///< normal of the side, outwards

  Ruling(Counted& random, const Cone& cone);
  Vec3 at(double share) const { return from + share * way; }
};

/// Makes a ray that is 10^-16 to 0.1 off a ruling: turned by such an angle, shifted by so many
/// sizes, both or neither, in any direction. It passes the ruling within the solid or beyond either
/// end, and starts there or up to 10^12 sizes away.
TestRay make_ruling_ray(Counted& random, const Cylinder& cylinder);
TestRay make_ruling_ray(Counted& random, const Cone& cone);
TestRay make_ruling_ray(Counted& random, const Capsule& capsule);

}  // namespace crt::test
