// Spheres, and rays to ask for: what ours and bare Embree both get.
#pragma once

#include <crt/crt.h>

#include <cstdint>
#include <vector>

namespace crt::bench {

struct Ball {
  double center[3];
  double radius;
};

/// Spheres all over a box of 8 x 6 x 8, which take the same share of it however many they are:
/// those of the scenes `spheres-...` in tests/bench/povray.
std::vector<Ball> balls_in_a_box(int count);

/// side x side rays from a camera that sees all of the box, in blocks of 4 x 4, which are packets
/// then.
std::vector<crt_ray> camera_rays(int side);

/// Rays from anywhere in the box in any direction.
std::vector<crt_ray> scattered_rays(int count);

/// The camera of camera_rays().
constexpr double camera_position[3] = {3, 6, -11};
constexpr double camera_fov = 0.7853981633974483;  // 45 degrees

}  // namespace crt::bench
