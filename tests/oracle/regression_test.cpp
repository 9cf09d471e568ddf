// Rays that the oracle found to be answered wrong, by name.
#include <doctest/doctest.h>

#include "oracle/measure.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Whether the ray's answer is right, and within its bound.
bool holds(const Primitive& primitive, const Vec3& origin, const Vec3& direction) {
  Record record;
  return measure(truth_of({.primitive = primitive, .origin = origin, .direction = direction}),
                 standard_tier(), 0, record);
}

}  // namespace

TEST_CASE("a plane seen from afar at a grazing angle is met where it is") {
  const Plane plane{.normal = {0x1.4bb8389b04732p-1, 0x1.84ed32eaf6d2ep+0, 0x1.8e92be912bbc9p-1},
                    .position = {0x1.1fdac6d7c3d49p+8, -0x1.376fdaa9e5289p+10, -0x1.38655ebc3fbbcp+9}};
  CHECK(holds(plane, {-0x1.603a5289347bdp+38, 0x1.bfc77a65ee94ap+38, -0x1.225e21a165416p+39},
              {0x1.603a528db440dp+38, -0x1.bfc77a7965b22p+38, 0x1.225e219c83a59p+39}));
}

TEST_CASE("a line that is parallel to a cylinder's caps to rounding passes beyond them or between them") {
  const Cylinder beyond{.from = {-0x1.6caa3f4779539p-3, -0x1.59fa5946585c7p-3, 0x1.ad93919a2882ep-6},
                        .to = {0x1.beccf05c88723p+11, -0x1.5941c4da1e7cp+12, -0x1.9e2c484555c55p+10},
                        .radius = 0x1.9c442d0ba4135p+12};
  CHECK(holds(beyond, {0x1.33a64ee273487p+45, 0x1.38f5f350233c8p+45, -0x1.7bb382d8e338bp+45},
              {-0x1.33a64ee277bd7p+45, -0x1.38f5f34ff3bccp+45, 0x1.7bb382d849fd3p+45}));
  const Cylinder between{.from = {0x1.8c8f71f3563d3p+7, -0x1.0b5529a925bd9p+8, 0x1.19b71bf6decdp+6},
                         .to = {0x1.4fc762129fcbcp+17, -0x1.d73fdac1dcac1p+17, 0x1.7af67850778b1p+17},
                         .radius = 0x1.d838442abbd62p+17};
  CHECK(holds(between, {0x1.7ce05c90532d5p+31, 0x1.1366c6e4efab6p+32, 0x1.5b389886402fp+31},
              {-0x1.7ce11c9de4d9cp+31, -0x1.1365d58e5e382p+32, -0x1.5b350250019e4p+31}));
}

TEST_CASE("a cone is left where it is by a line nearly along its axis") {
  const TestRay ray = make_ray(5, 765);
  CHECK(holds(ray.primitive, ray.origin, ray.direction));
}

TEST_CASE("a cone's apex is met from afar no worse than the rest of it") {
  const TestRay ray = make_ray(5, 11460);
  CHECK(holds(ray.primitive, ray.origin, ray.direction));
}

TEST_CASE("a triangle is not hit by lines in its plane but for rounding that pass it") {
  const TestRay ray = make_ray(8, 64516);
  CHECK(holds(ray.primitive, ray.origin, ray.direction));
}
