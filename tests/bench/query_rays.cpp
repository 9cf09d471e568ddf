#include "query_rays.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "measuring.hpp"

namespace crt::bench {

namespace {

constexpr double box_low[3] = {-4, -3, -4};
constexpr double box_high[3] = {4, 3, 4};
constexpr int block = 4;

struct Axes {
  double right[3];
  double up[3];
  double forward[3];
};

double length(const double (&v)[3]) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/// Returns the axes of a camera that looks at (0, 0, 0).
Axes camera_axes() {
  const double(&p)[3] = camera_position;
  const double distance = length(p);
  const double level = std::hypot(p[0], p[2]);
  return {.right = {-p[2] / level, 0, p[0] / level},
          .up = {-p[0] * p[1] / (level * distance), level / distance,
                 -p[2] * p[1] / (level * distance)},
          .forward = {-p[0] / distance, -p[1] / distance, -p[2] / distance}};
}

}  // namespace

std::vector<Ball> balls_in_a_box(int count) {
  Stream stream(1);
  const double radius = 1.4 / std::cbrt(count);
  std::vector<Ball> balls(static_cast<std::size_t>(count));
  for (Ball& ball : balls) {
    for (int axis = 0; axis < 3; ++axis)
      ball.center[axis] = stream.between(box_low[axis], box_high[axis]);
    ball.radius = radius;
  }
  return balls;
}

std::vector<crt_ray> camera_rays(int side) {
  const Axes axes = camera_axes();
  const double half = std::tan(camera_fov / 2);
  std::vector<crt_ray> rays;
  rays.reserve(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  for (int i = 0; i < side * side; ++i) {
    const int in_block = i % (block * block);
    const int blocks = i / (block * block);
    const int x = blocks % (side / block) * block + in_block % block;
    const int y = blocks / (side / block) * block + in_block / block;
    const double nx = (2 * (x + 0.5) / side - 1) * half;
    const double ny = (1 - 2 * (y + 0.5) / side) * half;
    crt_ray ray = {};
    ray.t_max = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin[axis] = camera_position[axis];
      ray.direction[axis] = axes.forward[axis] + nx * axes.right[axis] + ny * axes.up[axis];
    }
    rays.push_back(ray);
  }
  return rays;
}

std::vector<crt_ray> scattered_rays(int count) {
  Stream stream(2);
  std::vector<crt_ray> rays(static_cast<std::size_t>(count));
  for (crt_ray& ray : rays) {
    for (int axis = 0; axis < 3; ++axis)
      ray.origin[axis] = stream.between(box_low[axis], box_high[axis]);
    const double z = stream.between(-1, 1);
    const double angle = stream.between(0, 2 * std::numbers::pi);
    const double level = std::sqrt(1 - z * z);
    ray.direction[0] = level * std::cos(angle);
    ray.direction[1] = level * std::sin(angle);
    ray.direction[2] = z;
    ray.t_min = 0;
    ray.t_max = std::numeric_limits<double>::infinity();
  }
  return rays;
}

}  // namespace crt::bench
