// These functions make the spheres and rays that both our queries and bare Embree get.
#pragma once

#include <crt/crt.h>

#include <cstdint>
#include <vector>

namespace crt::bench {

struct Ball {
  double center[3];
  double radius;
};

/// Makes spheres all over a box of 8 x 6 x 8, which take the same share of it however many they
/// are. They are those of the scenes `spheres-...` in tests/bench/povray.
std::vector<Ball> balls_in_a_box(int count);

/// Makes side x side rays from a camera that sees all of the box, in blocks of 4 x 4, which become
/// packets.
std::vector<crt_ray> camera_rays(int side);

/// Makes rays from anywhere in the box in any direction.
std::vector<crt_ray> scattered_rays(int count);

/// This is the position of the camera of camera_rays().
constexpr double camera_position[3] = {3, 6, -11};
constexpr double camera_fov = 0.7853981633974483;  // 45 degrees

}  // namespace crt::bench
